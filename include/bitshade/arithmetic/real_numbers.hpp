// std::numbers of real: each constant rounded once by the format's rules.
#pragma once

#include <numbers>

#include "bitshade/arithmetic/real.hpp"

namespace bitshade::detail {

/// 128 leading bits, the first of them set, of a number that goes on: high 2^(exponent + 64) + low 2^exponent.
template <class F, rules R, class C>
constexpr real<F, R, C> constant(std::uint64_t high, std::uint64_t low, int exponent) {
  const auto one =
      real<F, R>::from_exact({exact_result::kind::finite, false, uint128{high} << 64 | low, exponent, true});
  if constexpr (std::is_same_v<C, default_carrier<F>>) return one;
  else return real<F, R, C>::from_bits(one.bits());
}

}  // namespace bitshade::detail

// tests/unit/arithmetic/drop_in.cpp holds them against the library's of float and double.
#define BITSHADE_CONSTANT(name, high, low, exponent)      \
  template <class F, bitshade::rules R, class C>          \
  inline constexpr bitshade::real<F, R, C> std::numbers::name<bitshade::real<F, R, C>> = \
      bitshade::detail::constant<F, R, C>(high, low, exponent);
BITSHADE_CONSTANT(e_v, 0xadf85458a2bb4a9a, 0xafdc5620273d3cf1, -126)
BITSHADE_CONSTANT(log2e_v, 0xb8aa3b295c17f0bb, 0xbe87fed0691d3e88, -127)
BITSHADE_CONSTANT(log10e_v, 0xde5bd8a937287195, 0x355baaafad33dc32, -129)
BITSHADE_CONSTANT(pi_v, 0xc90fdaa22168c234, 0xc4c6628b80dc1cd1, -126)
BITSHADE_CONSTANT(inv_pi_v, 0xa2f9836e4e441529, 0xfc2757d1f534ddc0, -129)
BITSHADE_CONSTANT(inv_sqrtpi_v, 0x906eba8214db688d, 0x71d48a7f6bfec344, -128)
BITSHADE_CONSTANT(ln2_v, 0xb17217f7d1cf79ab, 0xc9e3b39803f2f6af, -128)
BITSHADE_CONSTANT(ln10_v, 0x935d8dddaaa8ac16, 0xea56d62b82d30a28, -126)
BITSHADE_CONSTANT(sqrt2_v, 0xb504f333f9de6484, 0x597d89b3754abe9f, -127)
BITSHADE_CONSTANT(sqrt3_v, 0xddb3d742c265539d, 0x92ba16b83c5c1dc4, -127)
BITSHADE_CONSTANT(inv_sqrt3_v, 0x93cd3a2c8198e269, 0x0c7c0f257d92be83, -128)
BITSHADE_CONSTANT(egamma_v, 0x93c467e37db0c7a4, 0xd1be3f810152cb56, -128)
BITSHADE_CONSTANT(phi_v, 0xcf1bbcdcbfa53e0a, 0xf9ce60302e76e41a, -127)
#undef BITSHADE_CONSTANT
