#include "report/shader.hpp"

#include "bitshade/shadow/evsm.hpp"
#include "bitshade/shadow/msm_basis.hpp"
#include "report/shader_parts.hpp"
#include "run/lookup.hpp"
#include "run/storage.hpp"
#include "run/variance.hpp"

namespace bitshade {

using namespace shader_parts;

namespace {

/// The name of a texture's format in OpenGL.
std::string storage_name(const configuration& how) {
  const int channels = how.channels();
  const std::string letters = channels == 1 ? "R" : channels == 2 ? "RG" : "RGBA";
  if (how.format == "unorm8") return "GL_" + letters + "8";
  if (how.format == "unorm16") return "GL_" + letters + "16";
  if (how.format == "half" || how.format == "binary16") return "GL_" + letters + "16F";
  if (how.format == "binary32") return "GL_" + letters + "32F";
  return std::to_string(channels) + " x " + how.format;
}

/// What the run did and the code does not.
std::string left_out(const configuration& how) {
  std::string text;
  const auto add = [&](bool is, const char* what) {
    if (is) text += (text.empty() ? "" : ", ") + std::string(what);
  };
  add(how.slope_term && uses_floor(how.method), "the slope term");
  add(how.warping == layer_warp::unclamped && how.method == technique::lvsm,
      "depths of a layer without the clamp");
  add(how.transition && how.method == technique::lvsm, "the blend of two layers");
  add(how.lookup != layer_lookup::own && how.method == technique::lvsm,
      "lookups of other layers than the receiver's own");
  add(how.filtered.lookups > 1 && averages_lookups(how.method), "the mean of several lookups");
  add(how.filtered.msaa > 1 && takes_samples(how.method), "the resolve of samples");
  add(how.method == technique::msm && how.bound == moment_bound::hausdorff,
      "the sharper bound for depths in [0, 1]");
  return text.empty() ? "" : comment("Not in this code: " + text + ".");
}

std::string of_depths(const configuration& how) {
  const double bias = on_split_grid(how.depth_bias);
  const std::string depth =
      "clamp(depth, 0.0, 1.0)" + (bias == 0 ? std::string() : " - " + literal(bias));
  if (how.method == technique::hard)
    return "// A comparing sampler, GL_LEQUAL, filter GL_NEAREST, clamped to the edge.\n"
           "float shadow_light(sampler2DShadow map, vec2 uv, float depth) {\n"
           "  return texture(map, vec3(uv, " +
           depth + "));\n}\n";
  return "// A comparing sampler, GL_LEQUAL, filter GL_LINEAR, clamped to the edge.\n"
         "float shadow_light(sampler2DShadow map, vec2 uv, float depth) {\n"
         "  vec2 texel = 1.0 / vec2(textureSize(map, 0));\n"
         "  float light = 0.0;\n"
         "  for (int y = -BLUR_RADIUS; y <= BLUR_RADIUS; ++y)\n"
         "    for (int x = -BLUR_RADIUS; x <= BLUR_RADIUS; ++x)\n"
         "      light += BLUR[y + BLUR_RADIUS] * BLUR[x + BLUR_RADIUS] *\n"
         "               texture(map, vec3(uv + vec2(x, y) * texel, " +
         depth +
         "));\n"
         "  return min(light, 1.0);\n}\n";
}

std::string second_moment_of(const configuration& how) {
  if (how.second == second_moment::centred) return "4.0 * (x - 0.5) * (x - 0.5)";
  if (how.second == second_moment::square) return "x * x";
  const storage_format storage = storage_named(how.format);
  if (storage.format.kind != family::binary) {
    const std::string steps = literal(largest_code(storage.format));
    return "pow(floor(x * " + steps + " + 0.5) / " + steps + ", 2.0)";
  }
  if (how.format == "half") return "pow(unpackHalf2x16(packHalf2x16(vec2(x, 0.0))).x, 2.0)";
  return "x * x";
}

std::string of_variance(const configuration& how, const shader_constants& c) {
  const bool layered = how.method == technique::lvsm;
  const std::string at = layered ? "[layer]" : "";
  std::string out;
  if (layered) {
    std::vector<double> near, far, floors(c.floors.begin(), c.floors.end());
    for (const interval& l : c.layers) near.push_back(l.near), far.push_back(l.far);
    out += "const int LAYERS = " + std::to_string(c.layers.size()) + ";\n" +
           "// A layer's depths, overlap included, and where the next one begins.\n" +
           array("NEAR", near) + array("FAR", far);
    if (!c.splits.empty()) out += array("SPLIT", c.splits);
    out += "// Least variance, in a layer's own units.\n" + array("FLOOR", floors);
    out += "\nfloat in_layer(float depth, int layer) {\n"
           "  return clamp((depth - NEAR[layer]) / (FAR[layer] - NEAR[layer]), 0.0, 1.0);\n}\n";
  } else {
    out += constant("FLOOR", static_cast<double>(c.floors.front()), "least variance");
  }
  const std::string x = layered ? "in_layer(depth, layer)" : "clamp(depth, 0.0, 1.0)";
  const std::string variance = how.second == second_moment::centred
                                   ? "m.y / 4.0 - (m.x - 0.5) * (m.x - 0.5)"
                                   : "m.y - m.x * m.x";
  out += "\nvec2 shadow_texel(float depth" + std::string(layered ? ", int layer" : "") +
         ") {\n  float x = " + x + ";\n  return vec2(x, " + second_moment_of(how) + ");\n}\n\n" +
         chebyshev() + finish(how) + "float shadow_light(sampler2D" + (layered ? "Array" : "") +
         " map, vec2 uv, float depth) {\n";
  if (layered) {
    out += "  int layer = 0;\n";
    if (!c.splits.empty())
      out += "  while (layer < LAYERS - 1 && SPLIT[layer] < depth) ++layer;\n";
  }
  out += "  vec2 m = texture(map, " + std::string(layered ? "vec3(uv, float(layer))" : "uv") +
         ").xy;\n  float x = " + x + ", variance = " + variance + ";\n" +
         "  return finished(chebyshev(m.x, variance, x, FLOOR" + at + "));\n}\n";
  return out;
}

std::string of_exponentials(const configuration& how, const shader_constants& c) {
  const bool four = how.method == technique::evsm4, esm = how.method == technique::esm;
  const bool shifted = ends_at_one(storage_named(how.format).format);
  std::string out = constant("EXPONENT", how.exponent, "");
  if (four) out += constant("NEGATIVE_EXPONENT", how.negative_exponent, "");
  if (!esm) {
    out += constant("MIN_VARIANCE", how.min_variance, "of a depth");
    out += "// Floors that the format's noise needs, in a warped depth's units.\n";
    out += constant("NOISE", static_cast<double>(c.noise[0]), "");
    if (four) out += constant("NEGATIVE_NOISE", static_cast<double>(c.noise[1]), "");
  }
  out += "\nfloat warped(float depth) {\n  return exp(EXPONENT * (clamp(depth, 0.0, 1.0)" +
         std::string(shifted ? " - 1.0" : "") + "));\n}\n";
  if (four)
    out += "float negative_warped(float depth) {  // its magnitude: a unorm has no sign\n"
           "  return exp(-NEGATIVE_EXPONENT * clamp(depth, 0.0, 1.0));\n}\n";
  if (esm)
    return out + "\nfloat shadow_texel(float depth) { return warped(depth); }\n\n" + finish(how) +
           "float shadow_light(sampler2D map, vec2 uv, float depth) {\n"
           "  return finished(min(texture(map, uv).x / warped(depth), 1.0));\n}\n";
  out += std::string("\nvec") + (four ? "4" : "2") +
         " shadow_texel(float depth) {\n  float w = warped(depth);\n";
  out += four ? "  float n = negative_warped(depth);\n  return vec4(w, w * w, n, n * n);\n}\n\n"
              : "  return vec2(w, w * w);\n}\n\n";
  out += chebyshev() + finish(how) +
         "float floor_of(float w, float exponent, float noise) {\n"
         "  return max(min(MIN_VARIANCE * exponent * exponent, 1.0) * w * w, noise);\n}\n\n"
         "float shadow_light(sampler2D map, vec2 uv, float depth) {\n"
         "  vec4 m = texture(map, uv);\n  float w = warped(depth);\n"
         "  float light = chebyshev(m.x, m.y - m.x * m.x, w, floor_of(w, EXPONENT, NOISE));\n";
  if (four)
    out += "  float n = negative_warped(depth);\n"
           "  light = min(light, chebyshev(-m.z, m.w - m.z * m.z, -n,\n"
           "                               floor_of(n, NEGATIVE_EXPONENT, NEGATIVE_NOISE)));\n";
  return out + "  return finished(light);\n}\n";
}

}  // namespace

shader_constants constants_of(const frame& scene, const configuration& how,
                              const std::vector<double>& splits) {
  shader_constants c;
  c.storage = storage_name(how);
  if (splits.size() > 2) c.splits.assign(splits.begin() + 1, splits.end() - 1);
  c.layers = layer_intervals(splits, how.overlap);
  const storage_format storage = storage_named(how.format);
  if (stores_variance(how.method)) {
    const auto least = static_cast<float>(noise_floor(how, storage, scene.depth));
    for (const interval& layer : c.layers)
      c.floors.push_back(std::max(layer_floor<float>(how.min_variance, layer), least));
  } else if (how.method == technique::evsm2 || how.method == technique::evsm4) {
    const double negative = how.method == technique::evsm4 ? how.negative_exponent : how.exponent;
    const auto noise = warped_noise_floors(
        how, storage, scene.depth,
        evsm_constants_for(how.exponent, negative, storage.format, how.format));
    c.noise = {static_cast<float>(noise[0]), static_cast<float>(noise[1])};
  }
  return c;
}

bool has_shader(technique method) {
  return method != technique::savsm && method != technique::csm && method != technique::deep;
}

std::string glsl_of(const configuration& how, const shader_constants& c) {
  if (!has_shader(how.method))
    return comment("There is no code for " + std::string(name_of(how.method)) + " here.");
  std::string out = comment(how.key()) +
                    comment("Texture: " + c.storage +
                            (how.method == technique::lvsm ? ", an array layer for each layer" : "") +
                            (compares_depths(how.method)
                                 ? ", or a depth texture."
                                 : "; GL_LINEAR, clamped to the edge, cleared with "
                                   "shadow_texel of depth 1."));
  if (how.blurred() && how.method != technique::hard) {
    const kernel blur = blur_of(how);
    out += comment(how.method == technique::pcf
                       ? "Weights of the answers, along each axis."
                       : "Weights of the map's blur, along each axis, stored in between.") +
           "const int BLUR_RADIUS = " + std::to_string(blur.radius()) + ";\n" +
           array("BLUR", blur.weights);
  } else if (how.method == technique::pcf) {
    out += "const int BLUR_RADIUS = 0;\n" + array("BLUR", {1.0});
  }
  out += left_out(how) + "\n";
  switch (how.method) {
    case technique::hard:
    case technique::pcf:
      return out + of_depths(how);
    case technique::msm:
      return out + of_moments(how);
    case technique::esm:
    case technique::evsm2:
    case technique::evsm4:
      return out + of_exponentials(how, c);
    default:
      return out + of_variance(how, c);
  }
}

}  // namespace bitshade
