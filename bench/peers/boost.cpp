#include <boost/multiprecision/cpp_bin_float.hpp>

#include "peers/peers.hpp"

namespace peers {

void boost_round(const float* in, float* out, std::size_t n) {
  namespace mp = boost::multiprecision;
  using half = mp::number<mp::cpp_bin_float<11, mp::digit_base_2, void, std::int16_t, -126, 127>, mp::et_off>;
  for (std::size_t j = 0; j < n; ++j) out[j] = static_cast<float>(half(in[j]));
}

}  // namespace peers
