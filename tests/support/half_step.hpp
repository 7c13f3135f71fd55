// The formats that hard cases concern, and how far a rounding to one of them can move a number.
#pragma once

#include <array>
#include <cmath>
#include <string_view>

#include "bitshade/formats/decode.hpp"
#include "bitshade/formats/name.hpp"

namespace bitshade::test {

/// Storage formats of depths in [0,1]; exact arithmetic is its own subject.
inline constexpr std::array<std::string_view, 7> hard_formats{
    "unorm8", "unorm16", "unorm24", "snorm16", "half", "bfloat16", "binary32"};

inline encoding format_named(std::string_view name) { return *parse_encoding(name); }

/// Half a step of the format at numbers up to `most`, a power of two: no rounding to nearest moves
/// one of them farther.
inline double half_step(const encoding& e, double most = 1) {
  if (e.kind == family::unorm) return 0.5 / static_cast<double>(low_bits(e.width));
  if (e.kind == family::snorm) return 0.5 / static_cast<double>(low_bits(e.width - 1));
  return std::ldexp(most, -e.fraction_bits - 2);
}

}  // namespace bitshade::test
