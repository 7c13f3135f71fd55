#include "report/shader_parts.hpp"

#include <array>
#include <charconv>

#include "bitshade/formats/decode.hpp"
#include "bitshade/shadow/layers.hpp"
#include "bitshade/shadow/msm.hpp"
#include "io/text.hpp"

namespace bitshade::shader_parts {

std::string literal(double value) {
  std::array<char, 64> digits{};
  const auto end =
      std::to_chars(digits.data(), digits.data() + digits.size(), static_cast<float>(value)).ptr;
  std::string text(digits.data(), end);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

std::string constant(const std::string& name, double value, const std::string& words) {
  return "const float " + name + " = " + literal(value) + ";" +
         (words.empty() ? "" : "  // " + words) + "\n";
}

std::string array(const std::string& name, const std::vector<double>& values) {
  const std::string size = "[" + std::to_string(values.size()) + "]";
  std::string out, line = "const float " + name + size + " = float" + size + "(";
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string word = literal(values[i]) + (i + 1 < values.size() ? "," : ");");
    const bool first = line.back() == '(';
    if (line.size() + word.size() + 1 > 80) {
      out += line + "\n";
      line = "    " + word;
    } else {
      line += (first ? "" : " ") + word;
    }
  }
  return out + line + "\n";
}

std::string comment(const std::string& words) {
  std::string out;
  for (const std::string& line : wrap(words, 77)) out += "// " + line + "\n";
  return out;
}

double largest_code(const encoding& e) { return 1 / decode(e, 1); }

std::string chebyshev() {
  return "float chebyshev(float mean, float variance, float t, float least) {\n"
         "  if (t <= mean) return 1.0;\n"
         "  float v = max(variance, least), d = t - mean;\n"
         "  return v / (v + d * d);\n}\n\n";
}

std::string finish(const configuration& how) {
  std::string out = "float finished(float p) {\n";
  if (how.bleeding_reduction != 0) {
    const std::string alpha = literal(on_split_grid(how.bleeding_reduction));
    out += "  p = max((p - " + alpha + ") / (1.0 - " + alpha + "), 0.0);\n";
  }
  if (how.powered())
    out += "  p = min(pow(p, " + literal(how.bleeding_power) + ") + " + literal(how.bleeding_lift) +
           ", 1.0);\n";
  return out + "  return p;\n}\n\n";
}

std::string of_moments(const configuration& how) {
  const msm_transform& basis = how.optimised_basis ? msm_optimised_transform : msm_dense_transform;
  const auto vector = [](const std::array<double, 4>& v) {
    std::string text = "vec4(";
    for (std::size_t i = 0; i < 4; ++i) text += (i ? ", " : "") + literal(v[i]);
    return text + ")";
  };
  const auto rows = [&](const std::string& name, const std::array<std::array<double, 4>, 4>& m) {
    std::string text = "const vec4 " + name + "[4] = vec4[4](\n";
    for (std::size_t i = 0; i < 4; ++i) text += "    " + vector(m[i]) + (i < 3 ? ",\n" : ");\n");
    return text;
  };
  return constant("MOMENT_BIAS", how.moment_bias, "") +
         comment("The affine image of the moments that a texel holds, row by row, and its inverse.") +
         rows("BASIS", basis.matrix) + "const vec4 OFFSET = " + vector(basis.offset) + ";\n" +
         rows("INVERSE", basis.inverse) + R"glsl(
vec4 times(vec4 rows[4], vec4 v) {
  return vec4(dot(rows[0], v), dot(rows[1], v), dot(rows[2], v), dot(rows[3], v));
}

vec4 shadow_texel(float depth) {
  float y = 2.0 * clamp(depth, 0.0, 1.0) - 1.0;
  return OFFSET + times(BASIS, vec4(y, y * y, y * y * y, y * y * y * y));
}

)glsl" + chebyshev() +
         finish(how) + R"glsl(// The mass that a distribution with moments b can have at depth y at most.
float mass(vec4 b, float l21, float d2, float d3, float y) {
  float u1 = y - b.x, u2 = y * y - b.y - l21 * u1;
  return 1.0 / (1.0 + u1 * u1 / d2 + u2 * u2 / d3);
}

float shadow_light(sampler2D map, vec2 uv, float depth) {
  vec4 b = times(INVERSE, texture(map, uv) - OFFSET);
  b = mix(b, vec4(0.0, )glsl" +
         literal(msm_bias_even_moment) + ", 0.0, " + literal(msm_bias_even_moment) +
         R"glsl(), MOMENT_BIAS);
  float y = 2.0 * clamp(depth, 0.0, 1.0) - 1.0;
  // B = L D L^T of the Hankel matrix of (1, b).
  float d2 = b.y - b.x * b.x, e = b.z - b.x * b.y;
  float minor = (b.w - b.y * b.y) * d2 - e * e;
  if (d2 <= 0.0 || minor <= 0.0) return finished(chebyshev(b.x, d2, y, 0.0));
  float l21 = e / d2, d3 = minor / d2;
  // The depths beside y are the roots of c1 + c2 x + c3 x^2.
  float u1 = y - b.x, u2 = y * y - b.y - l21 * u1;
  float c3 = u2 / d3, c2 = u1 / d2 - l21 * c3, c1 = 1.0 - b.x * c2 - b.y * c3;
  float root = sqrt(max(c2 * c2 - 4.0 * c1 * c3, 0.0));
  float q = c2 < 0.0 ? (root - c2) / 2.0 : -(c2 + root) / 2.0;
  float near = q == 0.0 ? 0.0 : c1 / q;  // the other is q / c3
  float here = mass(b, l21, d2, d3, y), beside = mass(b, l21, d2, d3, near);
  float p = here;
  if (near > y) p += beside;
  if ((q - y * c3) * c3 > 0.0) p += 1.0 - here - beside;
  return finished(clamp(p, 0.0, 1.0));
}
)glsl";
}

}  // namespace bitshade::shader_parts
