// Spans of bilinear lookups at memory speed. Compiled: link bitshade::bulk.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitshade/texture/bulk.hpp"
#include "bitshade/texture/certified.hpp"
#include "bitshade/texture/sampler.hpp"

namespace bitshade::bulk {

/// sample_level of every channel at every (u, v), without mips or anisotropy.
///
/// Shapes   u.size() == v.size(); out: channels values a sample.
/// Policy   the model's, in binary32; models with an `intermediate` rounding are evaluated in binary64
///          and narrowed at the end, as device_sampler does it. Codes are loaded by their nearest
///          number, as texel_rule::nearest does. Models without a kernel run the template.
/// Failure  std::invalid_argument for spans that do not fit, or an instruction set that this
///          processor lacks.
void sample(const filter_model& model, const image<float>& level, const sampler_state& state,
            std::span<const float> u, std::span<const float> v, std::span<float> out,
            instruction_set set = instruction_set::best);
void sample(const filter_model& model, const texel_code& code, const image<std::uint16_t>& level,
            const sampler_state& state, std::span<const float> u, std::span<const float> v,
            std::span<float> out, instruction_set set = instruction_set::best);

/// The values of `out` that an error bound in binary64 decides are the exact ones rounded once;
/// returns the places of the others.
std::vector<std::uint32_t> sample_decided(const exact_source& in, address mode,
                                          std::span<const float> u, std::span<const float> v,
                                          std::span<float> out,
                                          instruction_set set = instruction_set::best);

/// bilinear_certified<float, T> of every channel at every (u, v).
///
/// Shapes   as sample(); T: exact<Q>, needed only where 128-bit integers are too narrow.
/// Error    none beyond the one rounding.
/// Failure  as sample().
template <class T>
void sample_certified(const exact_source& in, address mode, std::span<const float> u,
                      std::span<const float> v, std::span<float> out,
                      instruction_set set = instruction_set::best) {
  const auto channels = static_cast<std::uint32_t>(in.texels->channels);
  for (const std::uint32_t at : sample_decided(in, mode, u, v, out, set)) {
    out[at] = bilinear_certified<float, T>(in, u[at / channels], v[at / channels], mode,
                                           static_cast<int>(at % channels));
  }
}

}  // namespace bitshade::bulk
