// A configuration as a shader needs it: constants, what a texel holds, how light comes of it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "bitshade/shadow/layers.hpp"
#include "bitshade/study/configuration.hpp"
#include "bitshade/study/frame.hpp"

namespace bitshade {

/// What a configuration's run used and its options do not say.
struct shader_constants {
  std::vector<double> splits;         ///< the interior ones in use
  std::vector<interval> layers;       ///< with their overlap
  std::vector<float> floors;          ///< of a variance, one a layer, in the layer's own units
  std::array<float, 2> noise{};       ///< least floors of both warps of an EVSM
  std::string storage;                ///< "GL_RG16"; a format that OpenGL lacks by its own name
};

/// Shapes   splits: s_0 .. s_N of the run, 0 and 1 included.
shader_constants constants_of(const frame& scene, const configuration& how,
                              const std::vector<double>& splits);

/// Whether glsl_of knows a technique: all but SAVSM, CSM and deep maps.
bool has_shader(technique method);

/// GLSL (3.30 and later, ES 3.0 and later) to paste: constants, shadow_texel() for the pass that
/// makes the map, and shadow_light() for shading. What it leaves out is said in a comment.
std::string glsl_of(const configuration& how, const shader_constants& constants);

}  // namespace bitshade
