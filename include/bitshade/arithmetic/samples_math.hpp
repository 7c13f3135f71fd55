// <cmath> for samples: a function of each sample, rounded stochastically as the operators' results are.
#pragma once

#include <string_view>
#include <type_traits>

#include "bitshade/arithmetic/real_math.hpp"
#include "bitshade/arithmetic/samples.hpp"

namespace bitshade {

namespace detail {

/// Tells functions apart in the histories of samples: their names' letters.
constexpr std::uint64_t function_number(std::string_view name) {
  std::uint64_t number = 0;
  for (const char c : name) number = number << 8 | static_cast<unsigned char>(c);
  return number;
}

}  // namespace detail

// Error    one rounding of the exact value at binary64's nearest to a sample, which is the sample in formats of at most
//          53 bits.
#define BITSHADE_SAMPLES template <class F, std::size_t N> constexpr samples<F, N>
#define BITSHADE_FUNCTION(name) \
  BITSHADE_SAMPLES name(const samples<F, N>& x) { \
    return each(detail::function_number(#name), [](double v) { return elementary::name(v); }, x); \
  }
BITSHADE_ELEMENTARY(BITSHADE_FUNCTION)
#undef BITSHADE_FUNCTION

BITSHADE_SAMPLES pow(const samples<F, N>& x, const std::type_identity_t<samples<F, N>>& y) {
  return each(detail::function_number("pow"), [](double v, double w) { return elementary::pow(v, w); }, x, y);
}
BITSHADE_SAMPLES atan2(const samples<F, N>& y, const std::type_identity_t<samples<F, N>>& x) {
  return each(detail::function_number("atan2"), [](double v, double w) { return elementary::atan2(v, w); }, y, x);
}

// Whole numbers, exact but where a norm or fixed point clamps them.
#define BITSHADE_FUNCTION(name, direction) \
  BITSHADE_SAMPLES name(const samples<F, N>& x) { \
    constexpr auto whole = [](double v) { return unpack(detail::integral(v, rounding::direction)); }; \
    return each(detail::function_number(#name), whole, x); \
  }
BITSHADE_FUNCTION(floor, down)
BITSHADE_FUNCTION(ceil, up)
BITSHADE_FUNCTION(trunc, toward_zero)
BITSHADE_FUNCTION(round, nearest_away)
#undef BITSHADE_FUNCTION
#undef BITSHADE_SAMPLES

}  // namespace bitshade
