// What the steps share: the words that the lanes' own format makes, products that are exact, and where overflow goes.
#pragma once

#include "bulk/plan.hpp"

namespace bitshade::bulk_kernels {

/// How numbers beyond the largest finite one come out.
enum class ends : std::uint8_t {
  natural,  ///< infinities, reached or not as IEEE's direction says: scaling to the lane's own largest exponent does it
  nan,      ///< the same where NaN stands for infinity
  any       ///< as the plan says
};

/// e k + b, where e k is exact.
template <class V>
[[gnu::always_inline]] inline typename V::f scaled_sum(typename V::f e, typename V::f k, typename V::f b) {
  if constexpr (V::has_fma) return V::fma(e, k, b);
  else return V::add(V::mul(e, k), b);
}
/// b - e k.
template <class V>
[[gnu::always_inline]] inline typename V::f scaled_difference(typename V::f e, typename V::f k, typename V::f b) {
  if constexpr (V::has_fma) return V::fnma(e, k, b);
  else return V::sub(b, V::mul(e, k));
}
/// e k - b.
template <class V>
[[gnu::always_inline]] inline typename V::f reduced_product(typename V::f e, typename V::f k, typename V::f b) {
  if constexpr (V::has_fma) return V::fms(e, k, b);
  else return V::sub(V::mul(e, k), b);
}

/// The format of the lanes themselves, in words.
template <class V>
struct lane_shape {
  using f = typename V::f;
  using i = typename V::i;
  using m = typename V::m;
  using word = typename V::word;
  static constexpr int fraction = V::fraction_bits;
  static constexpr int lane_bits = static_cast<int>(sizeof(word)) * 8;
  static constexpr int lane_bias = (1 << (V::exponent_bits - 1)) - 1;
  static constexpr word ones = ~word{0};
  static constexpr word unit_word = word{1} << fraction;  ///< one step of the exponent; the smallest normal number
  static constexpr word infinity_word = ((word{1} << V::exponent_bits) - 1) << fraction;
  static constexpr word quiet_word = infinity_word | unit_word >> 1;

  [[gnu::always_inline]] static i all(std::uint64_t w) { return V::all_bits(static_cast<word>(w)); }
  /// 2^e in every lane.
  [[gnu::always_inline]] static f power(int e) { return V::value(all(static_cast<word>(e + lane_bias) << fraction)); }
};

}  // namespace bitshade::bulk_kernels
