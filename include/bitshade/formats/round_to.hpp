// The nearest thing that a format can say.
#pragma once

#include "bitshade/formats/decode.hpp"

namespace bitshade {

/// decode(encode(x)): x as the format would hand it back.
///
/// Error    one rounding by r; norms whose value is no binary64 are then the nearest binary64.
constexpr double round_to(const encoding& e, double x, const rules& r = {}, std::uint64_t random = 0) {
  return decode(e, encode(e, x, r, random), r);
}

}  // namespace bitshade
