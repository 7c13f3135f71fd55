// Four-moment shadow maps: the sharp bound that four moments allow.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "bitshade/formats/decode.hpp"
#include "bitshade/shadow/chebyshev.hpp"
#include "bitshade/shadow/moments.hpp"
#include "bitshade/shadow/msm_basis.hpp"

namespace bitshade {

/// E[y], E[y^2], E[y^3], E[y^4] of y = 2x - 1 in [-1,1].
template <class T>
struct four_moments {
  T b1, b2, b3, b4;
};

/// A depth in [0,1] in the moments' own interval. Every operation is T's.
template <class T>
constexpr T centred_depth(const T& x) {
  return x + x - static_cast<T>(1);
}

/// The moments of a single depth.
template <class T>
constexpr four_moments<T> moments_of(const T& x) {
  const T y = centred_depth(x);
  const T square = y * y;
  return {y, square, square * y, square * square};
}

/// What a texel stores of its moments: offset + matrix b, every operation T's, zeros left out.
template <class T>
constexpr std::array<T, 4> to_basis(const four_moments<T>& m, const msm_transform& basis) {
  const std::array<T, 4> b{m.b1, m.b2, m.b3, m.b4};
  std::array<T, 4> stored;
  for (std::size_t i = 0; i < 4; ++i) {
    T sum = static_cast<T>(basis.offset[i]);
    for (std::size_t j = 0; j < 4; ++j) {
      if (basis.matrix[i][j] != 0) sum = sum + static_cast<T>(basis.matrix[i][j]) * b[j];
    }
    stored[i] = sum;
  }
  return stored;
}

/// The way back from filtered texels: filters are affine, so that they commute with the basis.
template <class T>
constexpr four_moments<T> from_basis(const std::array<T, 4>& stored, const msm_transform& basis) {
  std::array<T, 4> b{};
  for (std::size_t i = 0; i < 4; ++i) {
    T sum = static_cast<T>(0);
    for (std::size_t j = 0; j < 4; ++j) {
      if (basis.inverse[i][j] == 0) continue;
      sum =
          sum + static_cast<T>(basis.inverse[i][j]) * (stored[j] - static_cast<T>(basis.offset[j]));
    }
    b[i] = sum;
  }
  return {b[0], b[1], b[2], b[3]};
}

/// A row of texels.
template <class T>
void msm_row(std::span<const float> depth, const msm_transform& basis, std::span<T> out) {
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const auto stored = to_basis(moments_of(clamp_depth(static_cast<T>(depth[i]))), basis);
    for (std::size_t k = 0; k < 4; ++k) out[4 * i + k] = stored[k];
  }
}

/// The moments that biasing moves towards: (0, 2/5, 0, 2/5), depths -1, 0, 1 with masses 1:3:1.
///
/// Of all moments on [-1,1] these keep the Hankel matrix furthest from singular: its smallest
/// eigenvalue is 1/5. ([Peters17] uses (0, 3/8, 0, 3/8), whose smallest is 0.1994.)
inline constexpr double msm_bias_even_moment = 0.4;
inline constexpr double msm_bias_eigenvalue = 0.2;

/// (1 - alpha) b + alpha (0, 2/5, 0, 2/5). Every operation is T's.
template <class T>
four_moments<T> biased(const four_moments<T>& b, double alpha) {
  const T share = static_cast<T>(alpha), rest = static_cast<T>(1) - share;
  const T added = share * static_cast<T>(msm_bias_even_moment);
  return {rest * b.b1, rest * b.b2 + added, rest * b.b3, rest * b.b4 + added};
}

/// The bias that keeps the Hankel matrix positive definite whatever `roundings` roundings do to the
/// stored values.
///
///   e_i = sum_j |inverse_ij| step/2 roundings;  n = |perturbation of the Hankel matrix|_inf
///   alpha = n / (1/5 + n)
///
/// Shapes   step: the largest distance of two neighbouring stored numbers in [0,1].
/// Error    sufficient, not necessary: Weyl's inequality with the matrix's row-sum norm.
constexpr double msm_sufficient_bias(double step, const msm_transform& basis, int roundings = 1) {
  std::array<double, 4> e{};
  for (std::size_t i = 0; i < 4; ++i) {
    for (const double m : basis.inverse[i]) e[i] += (m < 0 ? -m : m) * step / 2 * roundings;
  }
  const std::array<double, 3> rows{e[0] + e[1], e[0] + e[1] + e[2], e[1] + e[2] + e[3]};
  double norm = 0;
  for (const double row : rows) norm = row > norm ? row : norm;
  return norm / (msm_bias_eigenvalue + norm);
}

/// Whether a number is below zero as far as can be told; an enclosure type brings its own guess.
template <class T>
constexpr bool leans_negative(const T& x) {
  return x < static_cast<T>(0);
}
constexpr bool either(bool a, bool b) { return a || b; }
template <class T>
constexpr auto not_a_number(const T& x) {
  return x != x;
}

namespace detail {

/// B = L D L^T of the Hankel matrix (1, b1, b2; b1, b2, b3; b2, b3, b4).
template <class T, class Mask>
struct hankel_factors {
  T l21, d2, d3;
  Mask singular;  ///< not positive definite: fewer than three depths, or rounding's doing
};

template <class T>
auto factorised(const four_moments<T>& b) {
  const T zero = static_cast<T>(0), one = static_cast<T>(1);
  const T d2 = b.b2 - b.b1 * b.b1;
  const T e = b.b3 - b.b1 * b.b2;
  const T minor = (b.b4 - b.b2 * b.b2) * d2 - e * e;  // d2 d3: its sign needs no division
  const auto singular = either(d2 <= zero, minor <= zero);
  const T safe = select(singular, one, d2);
  return hankel_factors<T, decltype(singular)>{select(singular, zero, e / safe), safe,
                                               select(singular, one, minor / safe), singular};
}

/// The largest mass that any distribution with these moments has at y: 1 / (v^T B^-1 v).
template <class T, class Mask>
T largest_mass(const four_moments<T>& b, const hankel_factors<T, Mask>& f, const T& y) {
  const T u1 = y - b.b1;
  const T u2 = y * y - b.b2 - f.l21 * u1;
  const T one = static_cast<T>(1);
  return one / (one + u1 * u1 / f.d2 + u2 * u2 / f.d3);
}

/// The two depths that share the mass beside y, as a fraction num/den (den may be 0: infinitely
/// far, without mass) and a number.
template <class T>
struct other_depths {
  T num, den, near;
};

template <class T, class Mask>
other_depths<T> beside(const four_moments<T>& b, const hankel_factors<T, Mask>& f, const T& y) {
  using std::sqrt;
  const T zero = static_cast<T>(0), one = static_cast<T>(1), two = static_cast<T>(2);
  // c = B^-1 (1, y, y^2): the other depths are the roots of c1 + c2 x + c3 x^2.
  const T u1 = y - b.b1;
  const T u2 = y * y - b.b2 - f.l21 * u1;
  const T c3 = u2 / f.d3;
  const T c2 = u1 / f.d2 - f.l21 * c3;
  const T c1 = one - b.b1 * c2 - b.b2 * c3;
  const T discriminant = c2 * c2 - two * two * c1 * c3;
  const T root = sqrt(select(discriminant < zero, zero, discriminant));
  // Either sign gives the roots q/c3 and c1/q; this one does not cancel.
  const T q = leans_negative(c2) ? (root - c2) / two : -(c2 + root) / two;
  const auto nothing = q == zero;
  return {q, c3, select(nothing, zero, c1 / select(nothing, one, q))};
}

template <class T>
T saturated(const T& p) {
  const T zero = static_cast<T>(0), one = static_cast<T>(1);
  return select(p < zero, zero, select(p > one, one, p));
}

}  // namespace detail

/// The largest share of depths >= y that moments allow, over all distributions on the real line.
///
///   the distribution with these moments on y and two more depths; p is its mass from y on
///
/// Shapes   four moments (b0 = 1) and one receiver in, one visibility out.
/// Units    y and moments in [-1,1]; p in [0,1].
/// Policy   every operation is T's; masses by Christoffel's function, whose terms are all positive.
/// Failure  none: where the Hankel matrix is not positive definite (one or two depths, or noise
/// that
///          a larger bias would absorb), Chebyshev's bound of the first two moments takes its
///          place.
/// Source   [PetersKlein15] algorithm 2 solves the same problem; [KarlinStudden66] chapter 2.
template <class T>
T hamburger_bound(const four_moments<T>& b, const T& y) {
  const T zero = static_cast<T>(0);
  const auto f = detail::factorised(b);
  const auto others = detail::beside(b, f, y);
  const T here = detail::largest_mass(b, f, y);
  const T near = detail::largest_mass(b, f, others.near);
  const T far = static_cast<T>(1) - here - near;  // what is left for num/den
  const T past = (others.num - y * others.den) * others.den;
  const T p = here + select(others.near > y, near, zero) + select(past > zero, far, zero);
  const T two_moments = chebyshev(mean_and_variance(b.b1, b.b2), y, zero);
  // Factors close to the smallest numbers of T can still overflow: then, too, Chebyshev's bound.
  return select(either(f.singular, not_a_number(p)), two_moments, detail::saturated(p));
}

/// The same over distributions on [-1,1]: sharper where hamburger_bound leaves the interval.
///
///   if a depth beside y lies outside, the depths are -1, y, z and 1 instead, with
///   z = (c2 - y c1) / (c1 - y c0),  c_i = b_i - b_(i+2): the moments weighted by 1 - x^2
///
/// Failure  as hamburger_bound, to which it falls back where rounding leaves no such z.
/// Source   [PetersKlein15] algorithm 3; [KarlinStudden66] chapter 3.
template <class T>
T hausdorff_bound(const four_moments<T>& b, const T& y) {
  const T zero = static_cast<T>(0), one = static_cast<T>(1), two = static_cast<T>(2);
  const T wide = hamburger_bound(b, y);
  const auto f = detail::factorised(b);
  const auto others = detail::beside(b, f, y);
  const auto beyond = [&](const T& x) { return either(x<-one, x> one); };
  const T den = others.den, size = select(den < zero, -den, den);
  const auto outside = either(beyond(others.near), either(others.num<-size, others.num> size));

  const T c0 = one - b.b2, c1 = b.b1 - b.b3, c2 = b.b2 - b.b4;
  const T slope = c1 - y * c0;
  const T room = one - y * y;
  const auto flat = either(slope == zero, room <= zero);
  const T z = (c2 - y * c1) / select(flat, one, slope);
  const T z_room = one - z * z;
  const T distance = z - y;
  const auto broken = either(either(flat, f.singular), either(z_room <= zero, distance == zero));
  const T z_weight = slope / select(broken, one, distance);
  const T z_mass = z_weight / select(broken, one, z_room);
  const T y_mass = (c0 - z_weight) / select(broken, one, room);
  const T end_mass = (one + b.b1 - (one + y) * y_mass - (one + z) * z_mass) / two;
  const T p = detail::saturated(y_mass + end_mass + select(z > y, z_mass, zero));
  const T sharp = select(p < wide, p, wide);
  return select(either(broken, not_a_number(p)), wide, select(outside, sharp, wide));
}

}  // namespace bitshade
