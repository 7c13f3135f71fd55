// One axis: what becomes of a value beyond the largest finite one of a binary format. It is judged on the
// value rounded as if the exponent had no limit. Norms and fixed point clamp, whatever is said here.
#pragma once

#include <cstdint>

namespace bitshade {

enum class overflow : std::uint8_t {
  infinity,  ///< always infinity (NaN where the format has none)
  saturate,  ///< the largest finite number, for infinite inputs too
  ieee       ///< what the direction says; to odd: largest finite; stochastic: as to nearest
};

}  // namespace bitshade
