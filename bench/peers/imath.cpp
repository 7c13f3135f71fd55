#include <Imath/half.h>

#include "peers/peers.hpp"

namespace peers {

void imath_round(const float* in, float* out, std::size_t n) {
  for (std::size_t j = 0; j < n; ++j) out[j] = static_cast<float>(half(in[j]));
}

}  // namespace peers
