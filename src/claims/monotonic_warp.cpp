// C3: a monotonic warp of the depths leaves an upper bound.
#include <algorithm>

#include "bitshade/study/bounds_visibility.hpp"
#include "claims/footprint.hpp"
#include "claims/laboratory.hpp"
#include "claims/table.hpp"

namespace bitshade::claims {
namespace {

evaluation bounds_the_truth(const number& p, const number& truth) {
  return {true, p < truth, truth - p, {{"visibility", p}, {"share lit", truth}}};
}

/// The line through (0, w0), (1/4, w1) .. (1, w4).
number through(const std::vector<number>& knots, const number& x) {
  std::size_t k = 0;
  while (k + 2 < knots.size() && x > number(static_cast<int>(k) + 1, 4)) ++k;
  const number share = x * number(4) - number(static_cast<int>(k));
  return knots[k] + share * (knots[k + 1] - knots[k]);
}

evaluation any_warp(const method& m, const sample& s) {
  const auto& knots = s.list("warp");
  if (!std::is_sorted(knots.begin(), knots.end())) return {false};
  std::vector<number> first, second;
  for (const number& x : s.list("x")) {
    first.push_back(through(knots, x));
    second.push_back(first.back() * first.back());
  }
  const number p =
      m.chebyshev(m.variance(m.filter(first), m.filter(second)), through(knots, s["t"]), 0);
  return bounds_the_truth(p, share_lit(s.list("x"), s["t"]));
}

const trial with_any_warp{"under a rising warp there is at least as much light as is lit",
                          {{"x", quantity::share, 1, 6}, {"t"}, {"warp", quantity::share, 5, 5}},
                          any_warp};
void rising(sample& s) { std::sort(s.list("warp").begin(), s.list("warp").end()); }

evaluation layer_warp(const method& m, const sample& s) {
  const interval layer{s.real("near"), s.real("far")};
  if (!(layer.near < layer.far)) return {false};
  const number p = light(m, s.list("x"), s["t"], layer, 0);
  return bounds_the_truth(p, share_lit(s.list("x"), s["t"]));
}

const trial with_a_layer{
    "in a layer there is at least as much light as is lit",
    {{"x", quantity::share, 1, 6}, {"t"}, {"near", quantity::grid}, {"far", quantity::grid}},
    layer_warp};

/// Violations of a format over random footprints, with a floor in variance or without.
struct violations {
  long cases = 0, count = 0;
  double largest = 0;
};
violations violations_of(const laboratory& lab, const encoding& format, double floor) {
  violations v;
  for_cases(with_any_warp.names, lab.stream(303), lab.tries(2000), nullptr, [&](const sample& s) {
    const auto& x = s.list("x");
    const number short_of = share_lit(x, s["t"]) -
                            stored_light(lab.under_test(), format, x, s["t"], whole_range, floor);
    ++v.cases;
    if (!(short_of > number(0))) return;
    ++v.count;
    v.largest = std::max(v.largest, static_cast<double>(short_of));
  });
  return v;
}

outcome measure(laboratory& lab) {
  outcome out;
  out.claim("no violation under any rising piecewise linear warp",
            out.none_in(lab.search(with_any_warp, 301, 6000, rising), "any warp"));
  out.claim("no violation under the warp of any layer",
            out.none_in(lab.search(with_a_layer, 302, 6000), "layer's warp"));
  for (const auto& [name, format] : storage_formats()) {
    const std::string label = name;
    const violations bare = violations_of(lab, format, 0);
    out.add(label + ", no floor: violations",
            100.0 * static_cast<double>(bare.count) / static_cast<double>(bare.cases), "%");
    out.add(label + ", no floor: largest violation", bare.largest);
    const double e = moment_error(largest_step(format), 1), noise = variance_error(e, 1.0).width();
    const double floor = floor_for(noise, tolerated_error);
    out.limit(label + ", floor of " + std::to_string(static_cast<int>(floor / noise + 0.5)) +
                  " D: largest violation",
              violations_of(lab, format, floor).largest, visibility_error(noise, e, floor));
  }
  out.remarks.push_back(
      "Rounded moments do violate the bound; a floor that the format's noise D calls for keeps the "
      "violation below what is tolerated.");
  return out;
}

}  // namespace

claim monotonic_warp_claim() {
  return {"C3",
          "Under any monotonic warp of the depths, Chebyshev's inequality still gives an upper "
          "bound of the light.",
          "[LauritzenMcCool08]",
          "Random distributions under random rising warps, flat pieces included, and under the "
          "warps of random layers: visibility against the share lit, exactly; then in formats.",
          measure,
          {&with_a_layer, &with_any_warp}};
}

}  // namespace bitshade::claims
