// Exponential variance shadow maps with two and four components without rounding.
#include "bitshade/shadow/evsm.hpp"

#include <algorithm>

#include "run/filtered_exact.hpp"

namespace bitshade {

namespace {

struct evsm_map {
  evsm_constants constants;
  bool four = false;
  double min_variance = 0;
  bool slope_term = false;

  std::size_t channels() const { return four ? 4 : 2; }
  template <class T>
  void texel(const T& x, std::span<T> out) const {
    out[0] = positive_warp(x, constants);
    out[1] = out[0] * out[0];
    if (!four) return;
    out[2] = negative_warp(x, constants);
    out[3] = out[2] * out[2];
  }
  template <class T>
  T light(std::span<const T> m, const T& t) const {
    const T positive = evsm_positive_bound(m[0], m[1], t, constants, min_variance);
    if (!four) return positive;
    return evsm_bound(positive, evsm_negative_bound(m[2], m[3], t, constants, min_variance));
  }
  template <class T>
  void add_slope(const T& slope, std::span<T> out) const {
    add_warped_slope(slope, constants.positive, out[0], out[1]);
    if (four) add_warped_slope(slope, constants.negative, out[2], out[3]);
  }
  /// Without a floor a single depth leaves no variance: a step.
  std::optional<double> flat_light(double x, double t) const {
    if (min_variance != 0) return std::nullopt;
    return t <= x ? 1.0 : 0.0;
  }
};

evsm_map map_of(const configuration& how) {
  evsm_map map;
  map.four = how.method == technique::evsm4;
  map.min_variance = how.min_variance;
  map.slope_term = how.slope_term;
  map.constants = {how.exponent, map.four ? how.negative_exponent : how.exponent, 0};
  return map;
}

}  // namespace

void run_evsm_exact(run_context& run) {
  const evsm_map map = map_of(run.how);
  require_exact_exponent(std::max(map.constants.positive, map.constants.negative));
  run_filtered_exact(run, map);
}

}  // namespace bitshade
