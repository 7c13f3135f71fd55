// C16 and C19: where the second occluder lies, and what a split in front of it is good for.
#include <algorithm>
#include <cmath>

#include "claims/footprint.hpp"
#include "claims/laboratory.hpp"
#include "claims/table.hpp"

namespace bitshade::claims {
namespace {

std::vector<number> occluders(const sample& s) {
  const int nearer = static_cast<int>(s.real("nearer"));
  return two_depths(s["a"], s["b"], nearer, nearer + static_cast<int>(s.real("farther")));
}

/// mu + sigma of a footprint, as the method computes it from its moments.
double recovered(const method& m, const std::vector<number>& x) {
  std::vector<number> squares;
  for (const number& depth : x) squares.push_back(depth * depth);
  return m
      .second_occluder(static_cast<double>(m.filter(x)), static_cast<double>(m.filter(squares)),
                       {0, 1})
      .value;
}

// C16 ---------------------------------------------------------------------------------------------

evaluation recovers(const method& m, const sample& s) {
  if (!(s["a"] < s["b"])) return {false};
  const number value(recovered(m, occluders(s)));
  const number off = abs(value - s["b"]);
  return {true,
          off > number(tolerated_error),
          off,
          {{"mu + sigma", value}, {"second occluder", s["b"]}}};
}

const trial second_is_found{
    "mu + sigma is the farther occluder, to 1/255",
    {{"a"}, {"b"}, {"nearer", quantity::whole}, {"farther", quantity::whole}},
    recovers};

void half_and_half(sample& s) { s.list("farther") = s.list("nearer"); }

outcome measure_recovered(laboratory& lab) {
  outcome out;
  const method& m = lab.under_test();
  out.claim("within 1/255 for any coverage",
            out.none_in(lab.search(second_is_found, 1601, 3000), "any coverage"));
  out.condition = "both occluders cover the same share of the footprint";
  out.provided("within 1/255", out.none_in(lab.search(second_is_found, 1602, 3000, half_and_half),
                                           "half and half"));
  for (const int nearer : {1, 4, 8, 12, 15})
    out.add("nearer occluder covers " + std::to_string(nearer) + "/16: error over a - b",
            recovered(m, two_depths(0, number(1, 2), nearer, 16)) * 2 - 1);
  // At most (sqrt 2 - 1)/2 of the distance, at a coverage of (1 - 1/sqrt 2)/2 by the nearer one.
  double overshoot = 0;
  for (int nearer = 1; nearer < 256; ++nearer)
    overshoot = std::max(overshoot, recovered(m, two_depths(0, number(1, 2), nearer, 256)) * 2 - 1);
  out.limit("overshoot past the second occluder, over their distance", overshoot, 0.2072);

  long cases = 0, past_one = 0, better = 0, inside = 0;
  for_cases({{"x", quantity::share, 3, 6}}, lab.stream(1603), lab.tries(3000), nullptr,
            [&](const sample& s) {
              const auto& x = s.list("x");
              const auto [least, most] = std::minmax_element(x.begin(), x.end());
              const double value = recovered(m, x);
              if (*least == *most || value <= 0 || value >= 1)
                return past_one += value >= 1, void();
              ++cases;
              inside += number(value) <= *most ? 1 : 0;
              // What a split there does to a receiver at the far end.
              const auto made = layers_from(m, {value}, 0);
              const auto own = static_cast<std::size_t>(m.layer_of(number(1), made.splits));
              better += light(m, x, 1, made.layers[own], 0) <= light(m, x, 1, whole_range, 0);
            });
  const auto share = [&](long n) {
    return 100.0 * static_cast<double>(n) / static_cast<double>(cases);
  };
  out.add("3 to 6 random depths: mu + sigma not past the last one", share(inside), "%");
  out.add("3 to 6 random depths: a split there darkens a receiver at 1", share(better), "%");
  out.add("3 to 6 random depths: mu + sigma clamped to 1", static_cast<double>(past_one), "cases");
  out.provided("sensible for other distributions: a split there never lights a receiver at 1",
               better == cases);
  return out;
}

// C19 ---------------------------------------------------------------------------------------------

evaluation reduces(const method& m, const sample& s) {
  const auto made = layers_from(m, s.reals("split"), 0);
  const bool between = s["a"] < s["split"] && s["split"] < s["b"] && s["b"] < s["t"];
  if (!between || made.layers.size() < 2) return {false};
  const auto own = static_cast<std::size_t>(m.layer_of(s["t"], made.splits));
  const auto x = occluders(s);
  const double floor = s.real("floor");
  const number layered = light(m, x, s["t"], made.layers[own], floor);
  const number plain = light(m, x, s["t"], whole_range, floor);
  return {true,
          layered >= plain,
          layered - plain,
          {{"bleeding with the split", layered}, {"bleeding of a VSM", plain}}};
}

const trial split_between{"a split between the occluders lowers the bleeding",
                          {{"a"},
                           {"b"},
                           {"t"},
                           {"split", quantity::grid},
                           {"nearer", quantity::whole},
                           {"farther", quantity::whole},
                           {"floor", quantity::grid}},
                          reduces};

void in_order(sample& s) {
  std::vector<number> depths{s["a"], s["b"], s["t"]};
  std::sort(depths.begin(), depths.end());
  s.list("a").front() = depths[0], s.list("b").front() = depths[1], s.list("t").front() = depths[2];
}
void in_order_no_floor(sample& s) {
  in_order(s);
  s.list("floor").front() = 0;
}

outcome measure_split(laboratory& lab) {
  outcome out;
  const method& m = lab.under_test();
  out.claim("less bleeding, whatever the floor",
            out.none_in(lab.search(split_between, 1901, 6000, in_order), "any floor"));
  out.condition = "no floor acts";
  out.provided("strictly less bleeding",
               out.none_in(lab.search(split_between, 1902, 12000, in_order_no_floor), "no floor"));
  for (const int where : {1, 2, 3}) {
    const double split = 0.2 + 0.1 * where;
    const auto made = layers_from(m, {split}, 0);
    const auto x = two_depths(number(1, 5), number(3, 5), 1, 2);
    const number t(4, 5);
    const auto own = static_cast<std::size_t>(m.layer_of(t, made.splits));
    out.add(
        "a = 0.2, b = 0.6, receiver 0.8, split " + std::to_string(where) +
            "/4 of the way: bleeding over the VSM's",
        static_cast<double>(light(m, x, t, made.layers[own], 0) / light(m, x, t, whole_range, 0)));
  }
  return out;
}

}  // namespace

claim second_occluder_claim() {
  return {
      "C16",
      "Mean plus standard deviation recovers the second occluder's depth, and is sensible for "
      "other distributions.",
      "[LauritzenMcCool08] section 5",
      "mu + sigma of random pairs of occluders with random coverage against the farther one; of "
      "3 to 6 random depths, and what a split there does.",
      measure_recovered,
      {&second_is_found}};
}

claim split_between_claim() {
  return {"C19",
          "A split anywhere between the first and the second occluder still reduces bleeding.",
          "[LauritzenMcCool08] section 5",
          "Random pairs of occluders, receivers behind both, splits between them: the chosen "
          "layer's bleeding against the VSM's, exactly.",
          measure_split,
          {&split_between}};
}

}  // namespace bitshade::claims
