// Verdicts are computed: a technique that is changed for the worse loses them.
#include <algorithm>
#include <map>

#include "bitshade/formats/round_to.hpp"
#include "bitshade/shadow/moments.hpp"
#include "claims/laboratory.hpp"
#include "support/catch.hpp"

using namespace bitshade;
using namespace bitshade::claims;

namespace {

verdict verdict_of(const std::string& id, const method& m) {
  laboratory lab(m, {1, 0.04, 0.04, 1});  // few cases, small pictures
  return claims_named({id}).front().measure(lab).result();
}

number mean_of(std::span<const number> values) {
  number sum;
  for (const number& v : values) sum += v;
  return sum / number(values.size());
}

// Each of these is one mistake of an implementation. None of them loops.
number unclamped(const number& x, const interval& layer) {
  return (x - number(layer.near)) / number(layer.far - layer.near);
}
number unscaled_floor(double variance, const interval&) { return number(variance); }
number without_floor(const mean_variance<number>& at, const number& t, const number&) {
  return chebyshev<number>(at, t, 0);
}
number two_tailed(const mean_variance<number>& at, const number& t, const number& floor) {
  const number d = t - at.mean, v = std::max(at.variance, floor);
  return v + d * d == number(0) ? number(1) : v / (v + d * d);
}
int farther_on_ties(const number& t, std::span<const double> splits) {
  int i = 0;
  while (i < static_cast<int>(splits.size()) - 2 &&
         number(splits[static_cast<std::size_t>(i) + 1]) <= t)
    ++i;
  return i;
}
std::vector<interval> never_overlapping(std::span<const double> splits, double) {
  return layer_intervals(splits, 0);
}
/// Layers that end a quarter of their width too early.
std::vector<interval> ending_early(std::span<const double> splits, double overlap) {
  auto layers = layer_intervals(splits, overlap);
  for (interval& layer : layers) layer.far -= (layer.far - layer.near) / 4;
  return layers;
}
std::vector<double> crowded_splits(int layers) {
  std::vector<double> splits = uniform_splits(layers);
  for (double& s : splits) s = on_split_grid(s * s);
  return splits;
}
number least_of(std::span<const number> values) {
  return *std::min_element(values.begin(), values.end());
}
number weights_squared(std::span<const number> values) {
  return mean_of(values) / number(values.size());
}
mean_variance<number> second_moment_cut(const number& m1, const number& m2) {
  const number steps = 65535;
  return {m1, (m2 * steps).floor() / steps - m1 * m1};
}
number near_left_out(const number& z, const number& near, const number& far) {
  return z / (far - near);
}
lloyd_sample in_front_of_mean(double m1, double m2, const weight_limits& limits) {
  lloyd_sample s = lloyd_sample_of(m1, m2, limits);
  s.value = 2 * m1 - s.value;
  return s;
}

struct sabotage {
  const char* what;
  void (*apply)(method&);
  std::vector<const char*> turned;
};

const std::vector<sabotage> all_sabotage{
    {"no clamp in the warp", [](method& m) { m.warp = unclamped; }, {"C4", "C7"}},
    {"floor not scaled", [](method& m) { m.floor = unscaled_floor; }, {"C9", "C27"}},
    {"Chebyshev before the mean, too", [](method& m) { m.chebyshev = two_tailed; }, {"C3"}},
    {"ties go to the farther layer", [](method& m) { m.layer_of = farther_on_ties; }, {"C6", "C8"}},
    {"no overlap", [](method& m) { m.intervals = never_overlapping; }, {"C10"}},
    {"layers end early", [](method& m) { m.intervals = ending_early; }, {"C5"}},
    {"splits crowd", [](method& m) { m.uniform_splits = crowded_splits; }, {"C20"}},
    {"least in place of mean", [](method& m) { m.filter = least_of; }, {"C1", "C2", "C3"}},
    {"weights squared", [](method& m) { m.filter = weights_squared; }, {"C1", "C3"}},
    {"second moment rounded down", [](method& m) { m.variance = second_moment_cut; }, {"C1", "C2"}},
    {"metric without near", [](method& m) { m.metric = near_left_out; }, {"C26"}},
    {"mu - sigma", [](method& m) { m.second_occluder = in_front_of_mean; }, {"C16"}}};

}  // namespace

TEST_CASE("a technique changed for the worse turns verdicts") {
  std::map<std::string, verdict> sound;
  for (const sabotage& s : all_sabotage) {
    method worse = library_method();
    s.apply(worse);
    for (const char* id : s.turned) {
      if (!sound.contains(id)) sound[id] = verdict_of(id, library_method());
      const verdict broken = verdict_of(id, worse);
      INFO(s.what << ", " << id << ": " << name_of(sound[id]) << ", then " << name_of(broken));
      CHECK((sound[id] == verdict::holds || sound[id] == verdict::holds_if));
      CHECK(broken == verdict::fails);
    }
  }
}

TEST_CASE("a technique without its floor leaves C7's residue out") {
  // The claim itself gains by that mistake: what is left of it under the condition does not hold.
  method worse = library_method();
  worse.chebyshev = without_floor;
  const auto residue = [](const method& m) {
    laboratory lab(m, {1, 0.04, 0.04, 1});
    return claims_named({"C7"}).front().measure(lab).conditional.back();
  };
  CHECK(residue(library_method()).held);
  CHECK_FALSE(residue(worse).held);
}

TEST_CASE("a reduction of bleeding that adds light refutes C25") {
  // The claim's verdict takes times; its statement is enough.
  const trial& removal = *claims_named({"C25"}).front().trials.back();
  method worse = library_method();
  worse.reduce = [](const number& p, const number&) { return std::min(number(1), p + p); };
  CHECK_FALSE(hunt(removal, library_method(), {7, 0}, 200).found);
  CHECK(hunt(removal, worse, {7, 0}, 200).found);
}
