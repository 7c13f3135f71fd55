// C11: the step that a picture takes at a split where no transition is blended.
#include <algorithm>
#include <cmath>

#include "claims/footprint.hpp"
#include "claims/laboratory.hpp"
#include "claims/table.hpp"
#include "io/text.hpp"

namespace bitshade::claims {
namespace {

/// A receiver on a split, and its neighbour just behind it: the same footprint in two layers.
evaluation steps_little(const method& m, const sample& s) {
  const auto made = layers_from(m, s.reals("split"), s.real("overlap"));
  if (made.layers.size() < 2) return {false};
  const number t(made.splits[1]);
  const double floor = s.real("floor");
  const number nearer = light(m, s.list("x"), t, made.layers[0], floor);
  const number farther = light(m, s.list("x"), t, made.layers[1], floor);
  const number step = abs(nearer - farther);
  return {true,
          step > number(tolerated_error),
          step,
          {{"light in the nearer layer", nearer},
           {"light in the farther layer", farther},
           {"share lit", share_lit(s.list("x"), t)}}};
}

const trial split_step{"two layers give a receiver on their split the same light, to 1/255",
                       {{"x", quantity::share, 1, 6},
                        {"split", quantity::grid},
                        {"overlap", quantity::grid},
                        {"floor", quantity::grid}},
                       steps_little};

evaluation steps_not_at_all(const method& m, const sample& s) {
  evaluation e = steps_little(m, s);
  e.refutes = e.excess != number(0);
  return e;
}

const trial no_step{"two layers give a receiver on their split the same light, exactly",
                    split_step.names, steps_not_at_all};

void overlapping(sample& s) {
  if (s["overlap"] == number(0)) s.list("overlap").front() = number(1, 64);
}
/// Every depth where both layers resolve it, and both layers wider than sigma_min.
void within_the_overlap(sample& s) {
  overlapping(s);
  const number near = std::max(number(0), s["split"] - s["overlap"]),
               far = std::min(number(1), s["split"] + s["overlap"]);
  for (number& x : s.list("x")) x = std::clamp(x, near, far);
  const number narrower = std::min(far, number(1) - near);
  if (s["floor"] > narrower * narrower) s.list("floor").front() = 0;
}

/// Steps of visibility between neighbours of two layers on one surface, beyond the truth's own.
void add_jumps(const frame& scene, const cell& got, const std::vector<double>& truth,
               std::vector<double>& jumps) {
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
}

/// Where to put a split so that surfaces cross it: the receivers' own depths, at even ranks.
std::vector<double> depths_of_receivers(const frame& scene, int count) {
  std::vector<double> depths;
  for (const receiver& r : scene.receivers)
    if (r.surface != 0) depths.push_back(static_cast<double>(r.t));
  std::sort(depths.begin(), depths.end());
  std::vector<double> chosen;
  for (int i = 1; i <= count && !depths.empty(); ++i)
    chosen.push_back(
        depths[depths.size() * static_cast<std::size_t>(i) / static_cast<std::size_t>(count + 1)]);
  return chosen;
}

/// What leaving the transition out does to a scene, whatever split was tried.
struct loss {
  double rmse = -1;         ///< the most that the error grows
  double most[2], high[2];  ///< largest jump and 99.9th percentile: without, with
  std::size_t pairs = 0;    ///< of neighbours in two layers
};

loss loss_on(laboratory& lab, const frame& scene) {
  configuration how;
  how.method = technique::lvsm;
  how.format = "exact";
  how.layers = 2;
  how.overlap = 0.02;
  how.splits = split_rule::manual;
  loss found{};
  std::vector<double> jumps[2];
  const auto truth = truth_geometric(scene, how, lab.threads());
  for (const double split : depths_of_receivers(scene, 5)) {
    how.manual_splits = {split};
    double rmse[2];
    for (const bool blended : {false, true}) {
      how.transition = blended;
      const cell got = lab.under_test().render(scene, how, lab.threads());
      add_jumps(scene, got, truth, jumps[blended]);
      rmse[blended] = compare(got.visibility, truth).rmse;
    }
    found.rmse = std::max(found.rmse, rmse[0] - rmse[1]);
  }
  found.pairs = jumps[0].size();
  for (const int k : {0, 1}) {
    std::sort(jumps[k].begin(), jumps[k].end());
    found.most[k] = jumps[k].empty() ? 0 : jumps[k].back();
    found.high[k] = jumps[k].empty() ? 0 : jumps[k][(jumps[k].size() - 1) * 999 / 1000];
  }
  return found;
}

outcome measure(laboratory& lab) {
  outcome out;
  out.claim("any footprint: a step of at most 1/255 at a split",
            out.none_in(lab.search(split_step, 1101, 4000, overlapping), "any footprint"));
  bool close = true, smooth = true;
  for (const char* name : {"slope", "rts", "city"}) {
    const loss found = loss_on(lab, lab.scene(name));
    const std::string head = std::string(name) + ", 5 splits: ";
    out.add(head + "neighbours in two layers", static_cast<double>(found.pairs), "pairs");
    out.add(head + "RMSE, without less with transition", found.rmse);
    out.add(head + "largest jump, without", found.most[0]);
    out.add(head + "largest jump, with", found.most[1]);
    out.add(head + "99.9th percentile of jumps, without", found.high[0]);
    out.add(head + "99.9th percentile of jumps, with", found.high[1]);
    close = close && found.rmse <= tolerated_error;
    smooth = smooth && found.high[0] <= found.high[1] + tolerated_error;
  }
  out.claim("no scene's RMSE grows by more than 1/255", close);
  out.claim("nor the 99.9th percentile of its jumps at splits", smooth);
  out.condition =
      "the filtered depths lie within the overlap, where both layers give the same light, or the "
      "error over the whole picture counts and not the edge that a split draws";
  out.provided("depths within the overlap: no step at all",
               out.none_in(lab.search(no_step, 1102, 6000, within_the_overlap),
                           "depths within the overlap"));
  out.provided("no scene's RMSE grows by more than 1/255", close);
  return out;
}

}  // namespace

claim transition_claim() {
  return {"C11",
          "The transition between overlapping layers can be skipped with minimal loss.",
          "[LauritzenMcCool08] section 4.3",
          "Random footprints seen from a split by both its layers, exactly; then three scenes "
          "with a split at five of their receivers' own depths and an overlap of 0.02, with and "
          "without the transition: errors, and jumps at splits beyond the truth's own.",
          measure,
          {&split_step, &no_step}};
}

}  // namespace bitshade::claims
