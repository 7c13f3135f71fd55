// C10 and C11: what overlaps and transitions do at the splits.
#include <algorithm>
#include <cmath>

#include "bitshade/study/bounds_visibility.hpp"
#include "claims/footprint.hpp"
#include "claims/laboratory.hpp"
#include "claims/table.hpp"
#include "io/text.hpp"

namespace bitshade::claims {
namespace {

configuration layered(int layers, double overlap, const char* format = "exact") {
  configuration how;
  how.method = technique::lvsm;
  how.format = format;
  how.layers = layers;
  how.overlap = overlap;
  return how;
}

// C10 ---------------------------------------------------------------------------------------------

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

const trial lit_plane{{{"t"},
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

outcome measure_overlaps(laboratory& lab) {
  outcome out;
  out.claim("any overlap keeps a lit, slanted receiver lit",
            out.none_in(lab.search(lit_plane, 1001, 5000, gentle), "lit plane"));
  out.claim("any overlap leaves at most 1/255 of light past a split",
            out.none_in(lab.search(dark_past_split, 1002, 4000, far_in_front), "shadow"));
  out.condition =
      "delta is at least the filter's radius times the receiver's slope, and at least sigma_min "
      "sqrt(1/eps - 1)";
  out.provided("a lit receiver stays lit, exactly",
               out.none_in(lab.search(lit_plane, 1003, 5000, within_overlap), "lit plane, wide"));
  out.provided("at most eps = 1/255 of light is left past a split",
               out.none_in(lab.search(dark_past_split, 1004, 4000, faded), "shadow, wide"));

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
  const frame& garden = lab.scene("garden");
  for (const double overlap : {0.0, 0.005, 0.02}) {
    configuration how = layered(2, overlap);
    how.splits = split_rule::manual;
    how.manual_splits = {0.94};
    how.min_variance = 1e-7;
    out.add("garden, split at 0.94, overlap " + brief(overlap, 1) + ": bleeding",
            100 * lab.picture(garden, how).figures.bleed_area, "% of receivers");
  }
  out.remarks.push_back(
      "The overlap lets bleeding back in: occluders between s - delta and s count again. The "
      "garden's "
      "bench lies 0.01 in front of this split.");
  return out;
}

// C11 ---------------------------------------------------------------------------------------------

/// Steps of visibility between neighbours of two layers on one surface, beyond the truth's own.
std::vector<double> jumps_of(const frame& scene, const cell& got,
                             const std::vector<double>& truth) {
  std::vector<double> jumps;
  const auto width = static_cast<std::size_t>(scene.view_width);
  const auto pair = [&](std::size_t i, std::size_t j) {
    if (scene.receivers[i].surface == 0 ||
        scene.receivers[i].surface != scene.receivers[j].surface || got.layer[i] == got.layer[j])
      return;
    const auto step = [&](const std::vector<double>& v) { return std::fabs(v[i] - v[j]); };
    jumps.push_back(std::max(0.0, step(got.visibility) - step(truth)));
  };
  for (std::size_t i = 0; i < got.visibility.size(); ++i) {
    if (i % width + 1 < width) pair(i, i + 1);
    if (i + width < got.visibility.size()) pair(i, i + width);
  }
  std::sort(jumps.begin(), jumps.end());
  return jumps;
}

outcome measure_transition(laboratory& lab) {
  outcome out;
  bool close = true, smooth = true;
  for (const char* name : {"slope", "garden", "beams", "rts"}) {
    const frame& scene = lab.scene(name);
    configuration how = layered(4, 0.02);
    const auto truth = truth_geometric(scene, how, lab.threads());
    double rmse[2], high[2], most[2];
    for (const bool blended : {false, true}) {
      how.transition = blended;
      const auto picture = lab.picture(scene, how);
      const auto jumps = jumps_of(scene, picture.got, truth);
      const std::size_t last = jumps.empty() ? 0 : jumps.size() - 1;
      rmse[blended] = picture.figures.method.rmse;
      most[blended] = jumps.empty() ? 0 : jumps[last];
      high[blended] = jumps.empty() ? 0 : jumps[last * 999 / 1000];
    }
    const std::string head = std::string(name) + ": ";
    out.add(head + "RMSE, without less with transition", rmse[0] - rmse[1]);
    out.add(head + "largest jump at a split, without", most[0]);
    out.add(head + "largest jump at a split, with", most[1]);
    out.add(head + "99.9th percentile of jumps, without", high[0]);
    out.add(head + "99.9th percentile of jumps, with", high[1]);
    close = close && rmse[0] - rmse[1] <= tolerated_error;
    smooth = smooth && high[0] <= high[1] + tolerated_error;
  }
  out.claim("no scene's RMSE grows by more than 1/255", close);
  out.claim("nor the 99.9th percentile of its jumps at splits", smooth);
  out.condition = "the error over the whole picture counts, not the edge that a split draws";
  out.provided("no scene's RMSE grows by more than 1/255", close);
  return out;
}

}  // namespace

claim overlap_claim() {
  return {"C10",
          "Overlapping layers completely eliminate the artefacts at the layers' edges.",
          "[LauritzenMcCool08] section 4.3",
          "A lit slanted receiver under a filter, and a shadowed one just past a split, in random "
          "overlapping layers, exactly; then jumps and acne on the scene slope, and the bleeding "
          "that overlaps let back into the garden.",
          measure_overlaps,
          &lit_plane};
}

claim transition_claim() {
  return {
      "C11",
      "The transition between overlapping layers can be skipped with minimal loss.",
      "[LauritzenMcCool08] section 4.3",
      "Four scenes with four layers that overlap by 0.02, in exact arithmetic, with and without "
      "the transition: errors and the jumps at splits beyond the truth's own.",
      measure_transition,
      nullptr};
}

}  // namespace bitshade::claims
