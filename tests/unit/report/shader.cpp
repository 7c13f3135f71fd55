// The GLSL of every technique: constants as the run used them, and a compiler that takes it.
#include "report/shader.hpp"

#include "run/pipeline.hpp"
#include "support/catch.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"
#include "unit/run/frames.hpp"

using namespace bitshade;

namespace {

std::string shader_of(const frame& scene, const configuration& how) {
  const cell done = run_pipeline(scene, how, make_plan(scene, how));
  return glsl_of(how, constants_of(scene, how, done.splits));
}

bool holds(const std::string& text, const std::string& part) {
  CAPTURE(text, part);
  const bool found = text.find(part) != std::string::npos;
  CHECK(found);
  return found;
}

}  // namespace

TEST_CASE("a shader's constants are those of the run", "[report]") {
  const frame scene = test::small_frame(32, 16, 100, 3);
  configuration how;
  how.method = technique::lvsm;
  how.layers = 2;
  how.overlap = 0.125;
  how.min_variance = 0.0001220703125;  // 2^-13
  how.bleeding_reduction = 0.25;
  how.blur_taps = 3;
  const std::string text = shader_of(scene, how);
  holds(text, "GL_RG16");
  holds(text, "const float NEAR[2] = float[2](0.0, 0.375);");
  holds(text, "const float FAR[2] = float[2](0.625, 1.0);");
  holds(text, "const float SPLIT[1] = float[1](0.5);");
  // (7): 2^-13 / 0.625^2 = 2^-13 / 0.390625 = 3.125e-4.
  holds(text, "const float FLOOR[2] = float[2](0.0003125, 0.0003125);");
  holds(text, "(p - 0.25) / (1.0 - 0.25)");
  how.method = technique::evsm4;
  how.format = "half";
  how.exponent = 5.5;
  how.negative_exponent = 3;
  const std::string warped = shader_of(scene, how);
  holds(warped, "GL_RGBA16F");
  holds(warped, "const float EXPONENT = 5.5;");
  holds(warped, "const float NEGATIVE_EXPONENT = 3.0;");
  how.format = "unorm16";
  holds(shader_of(scene, how), "- 1.0)");  // shifted into (0,1]
}

TEST_CASE("a compiler takes every technique's shader", "[report]") {
  if (test::run_program({"sh", "-c", "command -v glslangValidator"}).status != 0) {
    WARN("skipped: no glslangValidator here; 'apt-get install glslang-tools' brings it");
    return;
  }
  const frame scene = test::small_frame(32, 16, 100, 3);
  const temporary_folder folder;
  std::vector<std::string> command{"glslangValidator"};
  int number = 0;
  for (const technique method : {technique::hard, technique::pcf, technique::vsm, technique::lvsm,
                                 technique::evsm2, technique::evsm4, technique::esm, technique::msm})
    for (const second_moment second :
         {second_moment::square, second_moment::square_of_stored, second_moment::centred}) {
      if (second != second_moment::square && method != technique::lvsm) continue;
      configuration how;
      how.method = method;
      how.layers = method == technique::lvsm ? 3 : 1;
      how.second = second;
      how.noise_floor = true;
      how.bleeding_power = 1.5;
      const bool array = method == technique::lvsm;
      const bool compares = method == technique::hard || method == technique::pcf;
      const std::string sampler =
          array ? "sampler2DArray" : compares ? "sampler2DShadow" : "sampler2D";
      const std::string file = (folder / (std::to_string(number++) + ".frag")).string();
      test::write(file, "#version 330 core\n" + shader_of(scene, how) + "uniform " + sampler +
                            " map;\nin vec3 at;\nout vec4 colour;\n"
                            "void main() { colour = vec4(shadow_light(map, at.xy, at.z)); }\n");
      command.push_back(file);
    }
  const test::outcome compiled = test::run_program(command);
  INFO(compiled.out << compiled.err);
  CHECK(compiled.status == 0);
  CHECK(number == 10);
}
