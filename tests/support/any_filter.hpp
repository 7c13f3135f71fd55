// Filter models and sampler states at random: every axis by itself, not only the presets' bundles.
#pragma once

#include <rapidcheck.h>

#include <algorithm>

#include "bitshade/interop/rational.hpp"
#include "bitshade/texture/sampler.hpp"

namespace bitshade::test {

template <class Enum>
Enum any_of(int count) {
  return static_cast<Enum>(*rc::gen::inRange(0, count));
}

inline int any_bits() {
  static constexpr int bits[] = {0, 4, 6, 8};
  return bits[*rc::gen::inRange(0, 4)];
}

/// Grids of 4, 6, 8 bits or none, every snap, every clamp and wrap, and the three orders of
/// numbers.
inline filter_model any_knobs() {
  filter_model m;
  m.clamp = any_of<clamp_rule>(5);
  m.repeat = any_of<repeat_rule>(3);
  m.grid_bits = any_bits();
  m.grid_snap = any_of<snap>(3);
  m.snap_before_centring = *rc::gen::arbitrary<bool>();
  m.weight_bits = any_bits();
  m.weight_snap = any_of<snap>(3);
  m.order = any_of<accumulation>(3);
  m.mip_bits = any_bits();
  return m;
}

inline sampler_state any_state() {
  sampler_state state;
  state.u = any_of<address>(4);
  state.v = any_of<address>(4);
  state.linear = *rc::gen::inRange(0, 4) != 0;
  state.border = {0.25, 0.25, 0.25, 0.25};
  return state;
}

inline image<exact_rational> exactly(const image<double>& in) {
  image<exact_rational> out(in.width, in.height);
  std::transform(in.texels.begin(), in.texels.end(), out.texels.begin(),
                 [](double x) { return exact_rational(x); });
  return out;
}

}  // namespace bitshade::test
