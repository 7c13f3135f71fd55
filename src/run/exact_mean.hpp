// Exact lights, num / den, and the mean of several rounded once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "bitshade/arithmetic/ball.hpp"
#include "bitshade/arithmetic/wide.hpp"
#include "bitshade/interop/rational.hpp"
#include "bitshade/texture/certified.hpp"

namespace bitshade {

/// An exact light: num / den.
template <std::size_t Limbs>
struct fraction {
  wide<Limbs> num, den;
};

namespace mean_detail {

/// The mean in enclosures of Precision limbs, if they decide the rounding.
template <std::size_t Precision, std::size_t Limbs>
std::optional<double> enclosed(std::span<const fraction<Limbs>> all) {
  using number = ball<Precision>;
  number sum;
  for (const auto& p : all) {
    sum += number::normalised(false, p.num, 0, 0.0) / number::normalised(false, p.den, 0, 0.0);
  }
  return decided(sum / number(static_cast<int>(all.size())));
}

template <std::size_t Limbs>
exact_rational rational(const wide<Limbs>& x) {
  exact_rational result(0);
  for (std::size_t i = Limbs; i-- > 0;) {
    for (const int shift : {32, 0}) {
      const auto half = static_cast<double>(x.limb[i] >> shift & 0xffffffff);
      result = result * exact_rational(0x1p32) + exact_rational(half);
    }
  }
  return result;
}

}  // namespace mean_detail

/// The mean of fractions, rounded once: by enclosures, and by rationals where these cannot tell.
template <std::size_t Limbs>
double mean_of(std::span<const fraction<Limbs>> all) {
  if (const auto p = mean_detail::enclosed<3>(all)) return *p;
  if (const auto p = mean_detail::enclosed<16>(all)) return *p;
  exact_rational sum(0);
  for (const auto& p : all) {
    sum = sum + mean_detail::rational(p.num) / mean_detail::rational(p.den);
  }
  return certified_detail::nearest_of<double, exact_rational>(
      sum / exact_rational(static_cast<int>(all.size())));
}

}  // namespace bitshade
