// One axis: which NaN comes out where a NaN goes in.
#pragma once

#include <cstdint>

namespace bitshade {

enum class nan_payload : std::uint8_t {
  keep,      ///< sign and leading payload bits kept, quieted: what F16C does
  canonical  ///< one positive quiet NaN with an empty payload
};

}  // namespace bitshade
