#include "run/shading_arithmetic.hpp"

#include <array>
#include <utility>

#include "bitshade/arithmetic/real.hpp"
#include "bitshade/shadow/chebyshev.hpp"
#include "bitshade/shadow/moments.hpp"

namespace bitshade {

namespace {

template <class T>
double shade(const shading_input& in) {
  const T m1 = static_cast<T>(in.first), m2 = static_cast<T>(in.second);
  const auto at = in.centred ? mean_and_centred_variance(m1, m2) : mean_and_variance(m1, m2);
  const T t = warp(clamp_depth(static_cast<T>(in.t)), in.layer);
  return static_cast<double>(chebyshev(at, t, layer_floor<T>(in.min_variance, in.layer)));
}

template <std::size_t... M>
constexpr std::array<shading_function, sizeof...(M)> widths(std::index_sequence<M...>) {
  return {&shade<real<binary<8, static_cast<int>(M) + 1>>>...};
}

/// e8m1 to e8m22; binary32 is the processor's own.
constexpr auto by_fraction_bits = widths(std::make_index_sequence<22>{});

}  // namespace

shading_function shading_in(const encoding& e) {
  if (e == binary16::value) return &shade<real<binary16>>;
  if (e == binary32::value) return &shade<float>;
  if (e == binary64::value) return &shade<double>;
  if (e.kind == family::binary && e.exponent_bits == 8 && e.has_sign &&
      e.special == specials::ieee && e.fraction_bits >= 1 && e.fraction_bits <= 22) {
    return by_fraction_bits[static_cast<std::size_t>(e.fraction_bits - 1)];
  }
  return nullptr;
}

}  // namespace bitshade
