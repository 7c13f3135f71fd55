// Four texels to one value, in a model's order and with its roundings.
#pragma once

#include "bitshade/formats/round_to.hpp"
#include "bitshade/texture/elementary.hpp"
#include "bitshade/texture/filter_model.hpp"
#include "bitshade/texture/fused.hpp"

namespace bitshade {

namespace accumulate_detail {

/// 8-bit codes: the weight in 256ths, rounded to the nearest code, ties up, modulo 256.
template <class T>
T lerp_codes(const T& a, const T& b, const T& f) {
  const int from = texel_floor(a), to = texel_floor(b);
  const int weight = texel_floor(f * static_cast<T>(256));
  return static_cast<T>((from + ((weight * (to - from) + 128) >> 8)) & 0xff);
}

template <class T>
T rounded(const filter_model& model, const T& x) {
  return static_cast<T>(round_to(model.rounded_to, static_cast<double>(x)));
}

}  // namespace accumulate_detail

/// From a to b by f, as the model interpolates along one axis or between levels.
///
/// Policy   operations are T's; with a rounding, T must hold the unrounded value: binary64 for
///          operands of at most 24 bits and weights of at most 8 loses nothing.
template <class T>
T interpolate(const filter_model& model, const T& a, const T& b, const T& f) {
  using namespace accumulate_detail;
  if (model.order == accumulation::lerp_codes) return lerp_codes(a, b, f);
  if (model.rounding == intermediate::per_product) {
    if (model.order == accumulation::four_products) {
      const T rest = static_cast<T>(1) - f;
      return rounded<T>(model, rounded<T>(model, rest * a) + rounded<T>(model, f * b));
    }
    return rounded<T>(model, a + rounded<T>(model, f * (b - a)));
  }
  T value;
  if (model.order == accumulation::lerp_fma)
    value = fused<T>(f, b - a, a);
  else if (model.order == accumulation::four_products)
    value = (static_cast<T>(1) - f) * a + f * b;
  else
    value = a + f * (b - a);
  return model.rounding == intermediate::per_lerp ? rounded<T>(model, value) : value;
}

/// Four texels, two weights: t00 at (0, 0), t10 at (1, 0), t01 at (0, 1).
template <class T>
T filter_four(const filter_model& model, const T& t00, const T& t10, const T& t01, const T& t11,
              const T& fx, const T& fy) {
  using namespace accumulate_detail;
  if (model.order != accumulation::four_products)
    return interpolate(model, interpolate(model, t00, t10, fx), interpolate(model, t01, t11, fx),
                       fy);
  const T gx = static_cast<T>(1) - fx, gy = static_cast<T>(1) - fy;
  if (model.rounding != intermediate::per_product)
    return ((gx * gy * t00 + fx * gy * t10) + gx * fy * t01) + fx * fy * t11;
  const auto product = [&](const T& w, const T& t) { return rounded<T>(model, w * t); };
  T sum = rounded<T>(model, product(gx * gy, t00) + product(fx * gy, t10));
  sum = rounded<T>(model, sum + product(gx * fy, t01));
  return rounded<T>(model, sum + product(fx * fy, t11));
}

}  // namespace bitshade
