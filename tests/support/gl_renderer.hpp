// Mesa's software renderers through headless EGL: what a real implementation makes of a lookup.
#pragma once

#include <string>
#include <vector>

#include "bitshade/texture/sampler.hpp"
#include "bitshade/texture/storage.hpp"

namespace bitshade::test {

enum class lookup_kind { lod, gradient, quad };  ///< quad: implicit derivatives of a 2x2 quad

/// One texture, one sampler, many lookups.
struct render_job {
  texel_format format;
  std::vector<coded_image> levels;
  sampler_state state;
  lookup_kind kind = lookup_kind::lod;
  std::vector<float> u, v, lod;        ///< lod for lookup_kind::lod
  std::vector<gradients> derivatives;  ///< for the others
};

/// Four channels a lookup, for each job. The renderer runs in a child process, so that its driver
/// ("llvmpipe" or "softpipe") is its own. Throws std::runtime_error with what went wrong.
std::vector<std::vector<float>> render(const std::string& driver,
                                       const std::vector<render_job>& jobs);

struct format_image {
  texel_format format;
  image<float> values;
};
/// What the renderer stores for values written by a shader: raw codes, for each image.
std::vector<coded_image> render_stores(const std::string& driver,
                                       const std::vector<format_image>& images);

struct format_codes {
  texel_format format;
  coded_image base;
};
/// The chain that glGenerateMipmap makes of each image.
std::vector<std::vector<coded_image>> render_mips(const std::string& driver,
                                                  const std::vector<format_codes>& images);

}  // namespace bitshade::test
