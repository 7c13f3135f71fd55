// How far rounded moments carry the variance away: derived in docs/theory.md, sections 1 to 3.
#pragma once

namespace bitshade {

/// Largest error of a moment after `roundings` roundings to nearest on a grid of `step`.
///
///   E = K q / 2
///
/// Between two roundings stand averages with non-negative weights of sum at most 1, which do not
/// enlarge an error; so the roundings add up and nothing else does.
///
/// Shapes   works in any T with + - * /, rationals included: the bounds are then exact.
/// Source   docs/theory.md section 1.
template <class T>
constexpr T moment_error(const T& step, int roundings) {
  return T(roundings) * step / T(2);
}

/// How far a computed variance can lie from the true one: computed - true in [-down, up].
template <class T>
struct variance_range {
  T down;
  T up;
  /// The larger side, for bounds that do not ask which.
  constexpr T width() const { return up < down ? down : up; }
};

/// Variance from moments m1, m2 that are each within `e` of E[x], E[x^2].
///
///   m2 - m1^2 - var = e2 - 2 mu e1 - e1^2
///   down = (1 + 2 mu) e + e^2,  up = e + (mu <= e ? mu^2 : 2 mu e - e^2)
///
/// Both ends are attained by some e1, e2. The square only ever lowers the variance, which the
/// symmetric form D = (1 + 2 mu) e + e^2 hides: it is `down`, and `up` is 2 e^2 smaller.
///
/// Units    mu in [0,1], the true mean in the layer's own units; the stored mean stays >= 0.
/// Error    none for exact T; a few of T's roundings else.
/// Source   docs/theory.md section 1.
template <class T>
constexpr variance_range<T> variance_error(const T& e, const T& mu) {
  const T down = (T(1) + T(2) * mu) * e + e * e;
  const T up = mu < e ? e + mu * mu : (T(1) + T(2) * mu) * e - e * e;
  return {down, up};
}

/// The same where every rounding truncates: both errors lie in (-K q, 0].
///
///   down = K q,  up = (f <= mu ? 2 mu f - f^2 : mu^2), f = K q
///
/// The first moment's truncation raises the variance, the second's lowers it: they partly cancel.
///
/// Source   docs/theory.md section 1.
template <class T>
constexpr variance_range<T> variance_error_truncated(const T& step, int roundings, const T& mu) {
  const T f = T(roundings) * step;
  return {f, mu < f ? mu * mu : T(2) * mu * f - f * f};
}

/// The same for centred storage: x and 4 (x - 1/2)^2 are stored, each within `e`.
///
///   |computed - var| <= (1/4 + |2 mu - 1|) e + e^2
///
/// At mu = 0 or 1 this is 5/4 e against 3 e at mu = 1 uncentred: 2.4 times smaller.
///
/// Source   docs/theory.md section 2.
template <class T>
constexpr T variance_error_centred(const T& e, const T& mu) {
  const T off = T(2) * mu < T(1) ? T(1) - T(2) * mu : T(2) * mu - T(1);
  return (T(1) / T(4) + off) * e + e * e;
}

/// The same where each texel stores M2 = round(round(x)^2) and then is averaged exactly.
///
///   |computed - var| <= q/2 + sigma q + q^2/4
///
/// The stored texels are a distribution of their own, every depth moved by at most q/2, so its
/// standard deviation moves by at most q/2; what is left is the one rounding of the square.
/// A texel of a single depth (sigma = 0) is thus off by q/2 instead of 3/2 q.
///
/// Units    sigma: the true standard deviation, or an upper bound of it.
/// Source   docs/theory.md section 2.
template <class T>
constexpr T variance_error_square_of_stored(const T& step, const T& sigma) {
  return step / T(2) + sigma * step + (sigma == T(0) ? T(0) : step * step / T(4));
}

/// Relative condition of M2 - M1^2 in (M1, M2): how often a relative error is enlarged.
/// Source   docs/theory.md section 3.
template <class T>
constexpr T variance_condition(const T& mu, const T& variance) {
  return T(1) + T(3) * mu * mu / variance;
}

/// Relative condition of the subtraction alone, in (M2, M1^2).
template <class T>
constexpr T subtraction_condition(const T& mu, const T& variance) {
  return T(1) + T(2) * mu * mu / variance;
}

/// What filter weights that sum to 1 + o add to the variance; exact, no bound.
///
///   (1 + o) M2 - (1 + o)^2 M1^2 - var = o var - o (1 + o) mu^2
///
/// Source   docs/theory.md section 3.
template <class T>
constexpr T unnormalised_shift(const T& o, const T& mu, const T& variance) {
  return o * variance - o * (T(1) + o) * mu * mu;
}

/// Variance of warped depths in floating point: both moments relatively within `u`.
///
///   |computed - var| <= u M2 + (2 u + u^2) mu^2 <= (3 u + u^2) w^2
///
/// Units    w: the largest warped value of the footprint; u: unit roundoff times roundings.
/// Source   docs/theory.md section 4.
template <class T>
constexpr T variance_error_floating(const T& u, const T& w) {
  return (T(3) * u + u * u) * w * w;
}

/// The noise of an exponential warp e^(c x), in depth^2: equal at every depth.
///
///   a depth step s moves the warped value by c w s, so noise 3 u w^2 is worth 3 u / c^2
///
/// Source   docs/theory.md section 4.
template <class T>
constexpr T exponential_warp_noise(const T& u, const T& c) {
  return (T(3) * u + u * u) / (c * c);
}

/// Bits that a summed-area table needs above its texels', for sums that lose nothing.
/// Source   docs/theory.md section 5.
constexpr int summed_area_extra_bits(int width, int height) {
  const auto ceil_log2 = [](int n) {
    int bits = 0;
    while (bits < 31 && (1LL << bits) < n) ++bits;
    return bits;
  };
  return ceil_log2(width) + ceil_log2(height);
}

}  // namespace bitshade
