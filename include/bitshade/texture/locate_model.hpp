// One axis of a lookup as a model does it: two texels and a weight.
#pragma once

#include <algorithm>
#include <cmath>

#include "bitshade/texture/address.hpp"
#include "bitshade/texture/elementary.hpp"
#include "bitshade/texture/filter_model.hpp"

namespace bitshade {

/// The two texels of one axis, and the weight of the second; an index of -1 is the border.
template <class T>
struct axis_taps {
  int i0 = 0, i1 = 0;
  T weight{};
};

namespace locate_detail {

/// Whole texels apart, so that no coordinate is too large for its grid.
template <class T>
T on_grid(const T& x, int bits, snap how) {
  if (how == snap::none || bits == 0) return x;
  const int whole = texel_floor(x);
  if (beyond_indices(whole)) return x;
  const T grid = static_cast<T>(1 << bits);
  const T scaled = (x - static_cast<T>(whole)) * grid;
  const int below = texel_floor(scaled);
  const T rest = scaled - static_cast<T>(below), half = static_cast<T>(0.5);
  const bool up = how == snap::nearest && (half < rest || (rest == half && (below & 1) != 0));
  return static_cast<T>(whole) + static_cast<T>(below + (up ? 1 : 0)) / grid;
}

template <class T>
T smaller(const T& a, const T& b) {
  return b < a ? b : a;
}
template <class T>
T larger(const T& a, const T& b) {
  return a < b ? b : a;
}

/// u in units of the image, folded into [0, 1]: 0 .. 1, 1 .. 0, ..
template <class T>
T fold(const T& u) {
  const int whole = texel_floor(u);
  const T rest = u - static_cast<T>(whole);
  return (whole & 1) == 0 ? rest : static_cast<T>(1) - rest;
}

}  // namespace locate_detail

/// Where u falls along an axis of `size` texels.
///
///   x = u*size - 1/2, limited, wrapped and snapped where the model says; weight = x - floor x,
///   then the weight grid
///
/// Policy   every operation is T's.
/// Failure  none: indices lie in the image or are -1 for every u; NaN counts as 0.
template <class T>
axis_taps<T> locate_axis(const filter_model& model, T u, int size, address mode) {
  using namespace locate_detail;
  const T zero = static_cast<T>(0), half = static_cast<T>(0.5), length = static_cast<T>(size);
  if (!(u == u)) u = zero;
  if (mode == address::mirror) u = fold(u);
  const bool limited = mode == address::clamp || mode == address::mirror;
  const bool fraction =
      mode == address::repeat &&
      (model.repeat == repeat_rule::fraction ||
       (model.repeat == repeat_rule::fraction_unless_power_of_two && (size & (size - 1)) != 0));
  if (fraction) u = u - static_cast<T>(texel_floor(u));
  if (limited && model.clamp == clamp_rule::unit)
    u = smaller(larger(u, zero), static_cast<T>(0x1.fffffep-1));

  T x = u * length;
  if (limited && model.clamp == clamp_rule::scaled) x = smaller(larger(x, zero), length);
  if (limited && model.clamp == clamp_rule::centred) x = smaller(x, length);
  if (model.snap_before_centring) x = on_grid(x, model.grid_bits, model.grid_snap);
  x = x - half;
  if (limited && model.clamp == clamp_rule::centred) x = larger(x, zero);
  if (!model.snap_before_centring) x = on_grid(x, model.grid_bits, model.grid_snap);

  const int below = texel_floor(x);
  T weight = beyond_indices(below) ? zero : x - static_cast<T>(below);
  if (model.weight_bits > 0) weight = on_grid(weight, model.weight_bits, model.weight_snap);
  if (limited && model.clamp == clamp_rule::integers && (below < 0 || below >= size - 1)) {
    const int edge = below < 0 ? 0 : size - 1;
    return {edge, edge, zero};
  }
  return {wrap(below, size, limited ? address::clamp : mode),
          wrap(below + 1, size, limited ? address::clamp : mode), weight};
}

/// The nearest texel along one axis.
///
///   floor(u*size), limited and wrapped in the model's order
template <class T>
int nearest_axis(const filter_model& model, T u, int size, address mode) {
  using namespace locate_detail;
  if (!(u == u)) u = static_cast<T>(0);
  if (mode == address::mirror) u = fold(u);
  const bool fraction =
      mode == address::repeat &&
      (model.repeat == repeat_rule::fraction ||
       (model.repeat == repeat_rule::fraction_unless_power_of_two && (size & (size - 1)) != 0));
  if (fraction) u = u - static_cast<T>(texel_floor(u));
  const int index = texel_floor(u * static_cast<T>(size));
  return wrap(index, size, mode == address::mirror ? address::clamp : mode);
}

}  // namespace bitshade
