// C10: what overlaps do at the splits, and what they cost.
#include <algorithm>
#include <cmath>

#include "bitshade/study/bounds_visibility.hpp"
#include "claims/footprint.hpp"
#include "claims/laboratory.hpp"
#include "claims/table.hpp"
#include "io/text.hpp"

namespace bitshade::claims {
namespace {

configuration layered(int layers, double overlap) {
  configuration how;
  how.method = technique::lvsm;
  how.format = "exact";
  how.layers = layers;
  how.overlap = overlap;
  return how;
}

/// A lit, slanted receiver under a box filter that reaches `radius` texels to either side.
evaluation stays_lit(const method& m, const sample& s) {
  const int radius = static_cast<int>(s.real("radius"));
  const number reach = s["slope"] * number(radius);
  if (s["t"] < reach || s["t"] + reach > number(1)) return {false};
  std::vector<number> plane;
  for (int k = -radius; k <= radius; ++k) plane.push_back(s["t"] + s["slope"] * number(k));
  const auto made = layers_from(m, s.reals("splits"), s.real("overlap"));
  const auto own = static_cast<std::size_t>(m.layer_of(s["t"], made.splits));
  const number p = light(m, plane, s["t"], made.layers[own], 0);
  return {true, p != number(1), number(1) - p, {{"visibility of a lit plane", p}}};
}

const trial lit_plane{"a lit plane under the filter stays lit",
                      {{"t"},
                       {"slope"},
                       {"radius", quantity::whole},
                       {"splits", quantity::grid, 1, 2},
                       {"overlap", quantity::grid}},
                      stays_lit};

void gentle(sample& s) {
  if (s["slope"] > number(1, 32)) s.list("slope").front() = s["slope"] / number(32);
}
void within_overlap(sample& s) {
  gentle(s);
  s.list("slope").front() = std::min(s["slope"], s["overlap"] / s["radius"]);
}

/// A shadowed receiver just past the split: the light that the floor leaves.
evaluation stays_dark(const method& m, const sample& s) {
  const auto made = layers_from(m, s.reals("split"), s.real("overlap"));
  if (made.layers.size() < 2) return {false};
  const number t(made.splits[1] + split_grid);
  const auto own = static_cast<std::size_t>(m.layer_of(t, made.splits));
  if (!(s["x"] <= number(made.layers[own].near))) return {false};
  const number p = light(m, s.list("x"), t, made.layers[own], s.real("floor"));
  return {true, p > number(tolerated_error), p, {{"light past the split", p}}};
}

const trial dark_past_split{
    "past a split a shadow has at most 1/255 of light",
    {{"x"}, {"split", quantity::grid}, {"overlap", quantity::grid}, {"floor", quantity::grid}},
    stays_dark};

void far_in_front(sample& s) {
  s.list("overlap").front() = std::min(s["overlap"], s["split"]);  // as far as there is depth
  s.list("x").front() = std::min(s["x"], s["split"] - s["overlap"]);
}
void faded(sample& s) {
  far_in_front(s);
  number& floor = s.list("floor").front();  // sigma_min^2 <= delta^2 eps / (1 - eps)
  while (floor * number(254) > s["overlap"] * s["overlap"] && floor > number(split_grid))
    floor /= number(2);
  if (floor * number(254) > s["overlap"] * s["overlap"] || !(floor / number(split_grid)).whole())
    floor = 0;
}

/// What is dark behind a split, and what an overlap makes of it: occluders within delta in front of
/// the split count again.
evaluation stays_without_bleeding(const method& m, const sample& s) {
  const auto apart = layers_from(m, s.reals("split"), 0);
  const auto wide = layers_from(m, s.reals("split"), s.real("overlap"));
  if (apart.layers.size() < 2 || !(s["t"] > number(apart.splits[1]))) return {false};
  const number before = light(m, s.list("x"), s["t"], apart.layers.back(), 0);
  if (before != number(0)) return {false};
  const number p = light(m, s.list("x"), s["t"], wide.layers.back(), 0);
  return {true,
          p > number(tolerated_error),
          p,
          {{"visibility without overlap", before}, {"visibility with it", p}}};
}

const trial no_bleeding{
    "what is dark without an overlap has at most 1/255 of light with it",
    {{"x", quantity::share, 1, 4}, {"t"}, {"split", quantity::grid}, {"overlap", quantity::grid}},
    stays_without_bleeding};

void behind_the_split(sample& s) {
  for (number& x : s.list("x")) x = std::min(x, s["split"]);
  if (s["t"] <= s["split"]) s.list("t").front() = 1;
}
void nothing_in_the_overlap(sample& s) {
  behind_the_split(s);
  for (number& x : s.list("x"))
    if (x + s["overlap"] > s["split"]) x = 0;
  if (s["overlap"] > s["split"]) s.list("overlap").front() = s["split"];
}

/// The scene slope: acne and jumps against the share of the overlap that the condition asks for.
void add_slope(laboratory& lab, outcome& out) {
  const frame& slope = lab.scene("slope");
  const double radius = 5;  // a blur of 9 taps and half a bilinear texel, rounded up
  double steepest = 0;
  for (const receiver& r : slope.receivers)
    if (r.surface != 0)
      steepest = std::max({steepest, std::fabs(static_cast<double>(r.dt_du)),
                           std::fabs(static_cast<double>(r.dt_dv))});
  const double deviation = std::sqrt(configuration{}.min_variance);
  const double delta = std::min(
      0.4, least_overlap(radius, steepest / slope.depth.width, deviation, tolerated_error));
  out.add("slope: the overlap that the condition asks for", delta);
  for (const double share : {0.0, 0.25, 0.5, 1.0}) {
    const auto picture = lab.picture(slope, layered(4, share * delta));
    const std::string head = "slope, N = 4, " + brief(share, 2) + " of it: ";
    out.add(head + "acne", 100 * picture.figures.acne_area, "% of receivers");
    out.add(head + "largest jump at a split", picture.figures.jump);
  }
}

/// A plane, a slab 0.02 in front of it and a half-plane over both; one split between slab and
/// plane.
void add_bleeding(laboratory& lab, outcome& out) {
  const frame& planes = lab.scene("planes", {{"dy", "0.02"}});
  for (const double overlap : {0.0, 0.005, 0.02}) {
    configuration how = layered(2, overlap);
    how.splits = split_rule::manual;
    how.manual_splits = {0.94};  // the receiver lies at 0.95
    how.min_variance = 1e-7;
    out.add("planes, dy = 0.02, split 0.94, overlap " + brief(overlap, 1) + ": bleeding",
            100 * lab.picture(planes, how).figures.bleed_area, "% of receivers");
  }
}

outcome measure_overlaps(laboratory& lab) {
  outcome out;
  out.claim("any overlap keeps a lit, slanted receiver lit",
            out.none_in(lab.search(lit_plane, 1001, 5000, gentle), "lit plane"));
  out.claim("any overlap leaves at most 1/255 of light past a split",
            out.none_in(lab.search(dark_past_split, 1002, 4000, far_in_front), "shadow"));
  out.claim("and costs nothing: what is dark without an overlap is dark with it",
            out.none_in(lab.search(no_bleeding, 1005, 4000, behind_the_split), "bleeding"));
  out.condition =
      "delta is at least the filter's radius times the receiver's slope, and at least sigma_min "
      "sqrt(1/eps - 1), and no occluder lies within delta in front of a split";
  out.provided("a lit receiver stays lit, exactly",
               out.none_in(lab.search(lit_plane, 1003, 5000, within_overlap), "lit plane, wide"));
  out.provided("at most eps = 1/255 of light is left past a split",
               out.none_in(lab.search(dark_past_split, 1004, 4000, faded), "shadow, wide"));
  out.provided("what is dark without an overlap is dark with it",
               out.none_in(lab.search(no_bleeding, 1006, 4000, nothing_in_the_overlap),
                           "bleeding, overlap empty"));
  add_slope(lab, out);
  add_bleeding(lab, out);
  out.remarks.push_back(
      "An overlap lets bleeding back in: occluders between s - delta and s count again.");
  return out;
}

}  // namespace

claim overlap_claim() {
  return {"C10",
          "Overlapping layers completely eliminate the artefacts at the layers' edges.",
          "[LauritzenMcCool08] section 4.3",
          "A lit slanted receiver under a filter, and a shadowed one just past a split, in random "
          "overlapping layers, and what bleeds with an overlap alone, exactly; then jumps and acne "
          "on the "
          "scene slope, and the bleeding that an overlap lets back under a slab.",
          measure_overlaps,
          {&lit_plane, &dark_past_split, &no_bleeding}};
}

}  // namespace bitshade::claims
