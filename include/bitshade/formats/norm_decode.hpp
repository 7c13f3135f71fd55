// One axis: how a device turns the code of a norm into a float.
#pragma once

#include <cstdint>

namespace bitshade {

enum class norm_decode : std::uint8_t {
  exact,      ///< the number nearest to c / max
  reciprocal  ///< fl32(c * fl32(1 / max)): one multiplication in binary32, two roundings
};

}  // namespace bitshade
