// C5 and C6: what the receiver's own layer says beside a plain VSM and beside the other layers.
#include <algorithm>

#include "claims/footprint.hpp"
#include "claims/laboratory.hpp"
#include "claims/table.hpp"

namespace bitshade::claims {
namespace {

void no_floor(sample& s) { s.list("floor").front() = 0; }
void no_overlap(sample& s) { s.list("overlap").front() = 0; }
void nothing_behind(sample& s) {
  for (number& x : s.list("x")) x = std::min(x, s["t"]);
}

// C5 ----------------------------------------------------------------------------------------------

evaluation as_good_as_vsm(const method& m, const sample& s) {
  const auto made = layers_from(m, s.reals("splits"), 0);
  const auto own = static_cast<std::size_t>(m.layer_of(s["t"], made.splits));
  const double floor = s.real("floor");
  const auto& x = s.list("x");
  const number layered = light(m, x, s["t"], made.layers[own], floor);
  const number plain = light(m, x, s["t"], whole_range, floor);
  number least = plain;
  for (std::size_t i = 0; i <= own; ++i)
    least = std::min(least, light(m, x, s["t"], made.layers[i], floor));
  return {true,
          layered > plain,
          layered - plain,
          {{"chosen layer's visibility", layered},
           {"VSM's visibility", plain},
           {"least of VSM and layers 1 to j", least},
           {"share lit", share_lit(x, s["t"])}}};
}

const trial beside_vsm{"the chosen layer gives no more light than a VSM",
                       {{"x", quantity::share, 1, 6},
                        {"t"},
                        {"splits", quantity::grid, 1, 3},
                        {"floor", quantity::grid}},
                       as_good_as_vsm};

void nothing_behind_no_floor(sample& s) { nothing_behind(s), no_floor(s); }

outcome measure_chosen(laboratory& lab) {
  outcome out;
  out.claim("no floor: never more light than a VSM",
            out.none_in(lab.search(beside_vsm, 501, 6000, no_floor), "no floor"));
  out.claim("floor (7), nothing behind the receiver: never more light than a VSM",
            out.none_in(lab.search(beside_vsm, 502, 3000, nothing_behind), "floor, x <= t"));
  out.condition = "no filtered depth lies behind the receiver and no floor acts";
  out.provided(
      "never more light than a VSM",
      out.none_in(lab.search(beside_vsm, 503, 8000, nothing_behind_no_floor), "no floor, x <= t"));
  double vsm = 0, layered = 0, cured = 0;
  for_cases(beside_vsm.names, lab.stream(504), lab.tries(1500), no_floor, [&](const sample& s) {
    const auto e = as_good_as_vsm(lab.under_test(), s);
    const auto excess = [&](std::size_t i) {
      return static_cast<double>(e.numbers[i].value - e.numbers[3].value);
    };
    layered += excess(0), vsm += excess(1), cured += excess(2);
  });
  const auto cases = static_cast<double>(lab.tries(1500));
  out.add("mean excess of light, VSM", vsm / cases);
  out.add("mean excess of light, chosen layer", layered / cases);
  out.add("mean excess of light, least of VSM and layers 1 to j", cured / cases);
  out.remarks.push_back(
      "A texel behind the receiver is worth more in its layer than in the whole range. The least "
      "of "
      "the VSM and the layers 1 to j is never worse than a VSM and still an upper bound.");
  return out;
}

// C6 ----------------------------------------------------------------------------------------------

evaluation one_suffices(const method& m, const sample& s) {
  const auto made = layers_from(m, s.reals("splits"), s.real("overlap"));
  const auto own = static_cast<std::size_t>(m.layer_of(s["t"], made.splits));
  const double floor = s.real("floor");
  number nearest = 1, farther = 1;  // the least light of either side
  const number here = light(m, s.list("x"), s["t"], made.layers[own], floor);
  for (std::size_t i = 0; i < made.layers.size(); ++i) {
    if (i == own) continue;
    number& least = i < own ? nearest : farther;
    least = std::min(least, light(m, s.list("x"), s["t"], made.layers[i], floor));
  }
  const number short_of = std::max(number(0), here - nearest) + (number(1) - farther);
  return {true,
          short_of > number(0),
          short_of,
          {{"own layer's visibility", here},
           {"least of the nearer layers", nearest},
           {"least of the farther layers", farther}}};
}

const trial beside_others{"the own layer is the darkest, and farther ones give full light",
                          {{"x", quantity::share, 1, 6},
                           {"t"},
                           {"splits", quantity::grid, 1, 3},
                           {"overlap", quantity::grid},
                           {"floor", quantity::grid}},
                          one_suffices};

void bare(sample& s) { no_overlap(s), no_floor(s); }
void bare_nothing_behind(sample& s) { bare(s), nothing_behind(s); }
void overlapping(sample& s) { nothing_behind(s), no_floor(s); }
void at_a_split(sample& s) {
  s.list("t").front() = s.list("splits").front();
  bare_nothing_behind(s);
}

outcome measure_one_sample(laboratory& lab) {
  outcome out;
  out.claim("any footprint: the own layer is the darkest, farther ones give 1",
            out.none_in(lab.search(beside_others, 601, 5000, bare), "any footprint"));
  out.claim("with overlaps, nothing behind the receiver: the same",
            out.none_in(lab.search(beside_others, 602, 3000, overlapping), "overlap, x <= t"));
  out.condition =
      "no filtered depth lies behind the receiver, layers do not overlap and no floor acts";
  out.provided("the own layer is the darkest, farther ones give 1",
               out.none_in(lab.search(beside_others, 603, 5000, bare_nothing_behind), "x <= t"));
  out.provided("the same for receivers on a split, which belong to the nearer layer",
               out.none_in(lab.search(beside_others, 604, 2000, at_a_split), "x <= t = split"));
  out.remarks.push_back(
      "One sample is enough for a picture that is no worse than the claim's own, but it is not "
      "always the least of all layers.");
  return out;
}

}  // namespace

claim chosen_layer_claim() {
  return {"C5",
          "The layer that a receiver chooses is at least as good as a standard VSM.",
          "[LauritzenMcCool08] section 4",
          "Random footprints, receivers and splits: visibility in the chosen layer against the "
          "VSM's, exactly, each with its floor.",
          measure_chosen,
          {&beside_vsm}};
}

claim one_sample_claim() {
  return {"C6",
          "Nearer layers give at least as much light as the receiver's own and farther ones give "
          "full light, so that one sample suffices.",
          "[LauritzenMcCool08] section 4",
          "All layers evaluated for random footprints, with and without overlaps, receivers on "
          "splits included.",
          measure_one_sample,
          {&beside_others}};
}

}  // namespace bitshade::claims
