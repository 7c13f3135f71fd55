// C9 and C27: the floor of each layer, and what happens within one.
#include <algorithm>
#include <cmath>

#include "bitshade/study/bounds_visibility.hpp"
#include "claims/footprint.hpp"
#include "claims/laboratory.hpp"
#include "claims/table.hpp"
#include "io/text.hpp"

namespace bitshade::claims {
namespace {

interval layer_of(const sample& s) { return {s.real("near"), s.real("far")}; }
number width_of(const sample& s) { return s["far"] - s["near"]; }

void ordered(sample& s) {
  if (s["far"] < s["near"]) std::swap(s.list("near").front(), s.list("far").front());
}
/// Lowers sigma_min until the layer is no narrower than it.
void wide_enough(sample& s) {
  ordered(s);
  number& floor = s.list("floor").front();
  while (floor > width_of(s) * width_of(s) && floor > number(split_grid)) floor /= number(2);
  if (floor > width_of(s) * width_of(s) || !(floor / number(split_grid)).whole()) floor = 0;
}

// C9 ----------------------------------------------------------------------------------------------

evaluation same_in_world(const method& m, const sample& s) {
  if (!(s["near"] < s["far"])) return {false};
  const number world = m.floor(s.real("floor"), layer_of(s)) * width_of(s) * width_of(s);
  return {true,
          world != s["floor"],
          abs(world - s["floor"]),
          {{"floor in the layer", m.floor(s.real("floor"), layer_of(s))},
           {"the same in the world", world}}};
}

const trial consistent{
    "the floor of a layer is sigma_min^2 in the world",
    {{"near", quantity::grid}, {"far", quantity::grid}, {"floor", quantity::grid}},
    same_in_world};

/// The light that is left at the far end of a layer behind one occluder in front of it.
double left_at_far_end(const method& m, const interval& layer, double floor) {
  const std::vector<number> x{number(layer.near)};
  return static_cast<double>(light(m, x, number(layer.far), layer, floor));
}

outcome measure_floor(laboratory& lab) {
  outcome out;
  const method& m = lab.under_test();
  out.claim("in world units every layer's floor is sigma_min^2",
            out.none_in(lab.search(consistent, 901, 3000, ordered), "any layer"));
  out.condition = "the layer is no narrower than sigma_min, where the floor reaches its cap of 1";
  out.provided("in world units every layer's floor is sigma_min^2",
               out.none_in(lab.search(consistent, 902, 5000, wide_enough), "w >= sigma_min"));

  const double deviation = 0x1p-7, floor = deviation * deviation;  // sigma_min = 0.0078
  for (const int layers : {1, 4, 16, 64}) {
    const interval layer{0, 1.0 / layers};
    const auto in_layer = static_cast<double>(m.floor(floor, layer));
    for (const auto& [name, format] : storage_formats()) {
      const double noise = variance_error(moment_error(largest_step(format), 1), 1.0).width();
      out.add("sigma_min = 1/128, w = " + (layers == 1 ? "1" : "1/" + std::to_string(layers)) +
                  ", " + name + ": floor over noise D",
              in_layer / noise);
    }
    out.add("sigma_min = 1/128, w = " + (layers == 1 ? "1" : "1/" + std::to_string(layers)) +
                ": light left at the far end",
            left_at_far_end(m, layer, floor));
  }
  // The narrowest layer whose floor leaves at most 1/255, in steps of 2^-12.
  int steps = 1;
  while (steps < 4096 && left_at_far_end(m, {0, steps * 0x1p-12}, floor) > tolerated_error) ++steps;
  const double narrowest = steps * 0x1p-12;
  out.add("narrowest layer that leaves at most 1/255", narrowest / deviation, "sigma_min");
  out.limit("distance of that from sigma_min sqrt(1/eps - 1), in steps of 2^-12",
            std::fabs(narrowest - narrowest_layer(deviation, tolerated_error)) * 0x1p12, 1);
  out.remarks.push_back(
      "A consistent floor grows in the layer's own units as the layer narrows: it stays clear of "
      "the format's noise, and lights the layer's shadows instead.");
  return out;
}

// C27 ---------------------------------------------------------------------------------------------

evaluation as_a_vsm(const method& m, const sample& s) {
  const auto& x = s.list("x");
  const auto inside = [&](const number& v) { return s["near"] <= v && v <= s["far"]; };
  if (!(s["near"] < s["far"]) || !std::all_of(x.begin(), x.end(), inside) || !inside(s["t"]))
    return {false};
  const number layered = light(m, x, s["t"], layer_of(s), s.real("floor"));
  const number plain = light(m, x, s["t"], whole_range, s.real("floor"));
  return {true,
          layered != plain,
          abs(layered - plain),
          {{"layer's visibility", layered}, {"VSM's visibility", plain}}};
}

const trial within{"within a layer the light is that of a VSM",
                   {{"x", quantity::share, 1, 6},
                    {"t"},
                    {"near", quantity::grid},
                    {"far", quantity::grid},
                    {"floor", quantity::grid}},
                   as_a_vsm};

void inside(sample& s) {
  ordered(s);
  for (number& x : s.list("x")) x = std::clamp(x, s["near"], s["far"]);
  s.list("t").front() = std::clamp(s["t"], s["near"], s["far"]);
}
void inside_wide(sample& s) { wide_enough(s), inside(s); }

outcome measure_within(laboratory& lab) {
  outcome out;
  const method& m = lab.under_test();
  out.claim("the same light as a VSM, whatever the floor",
            out.none_in(lab.search(within, 2701, 3000, inside), "any layer"));
  out.condition = "the layer is no narrower than sigma_min, where the floor reaches its cap of 1";
  out.provided("the same light as a VSM, to the last bit",
               out.none_in(lab.search(within, 2702, 6000, inside_wide), "w >= sigma_min"));
  const double floor = 0x1p-12;
  for (const auto& [name, format] : storage_formats()) {
    double worst = 0, over = 0;
    const double e = moment_error(largest_step(format), 1), d = variance_error(e, 1.0).width();
    for_cases(within.names, lab.stream(2703), lab.tries(1500), inside, [&](const sample& s) {
      const double w = static_cast<double>(width_of(s));
      if (!as_a_vsm(m, s).admissible || w < 0x1p-6) return;
      const auto stored = [&](const interval& layer) {
        return stored_light(m, format, s.list("x"), s["t"], layer, floor);
      };
      const auto apart = static_cast<double>(abs(stored(layer_of(s)) - stored(whole_range)));
      worst = std::max(worst, apart);
      over = std::max(over, apart / (visibility_error(d, e, floor) +
                                     visibility_error(d, e, std::min(1.0, floor / (w * w)))));
    });
    out.add(std::string(name) + ", sigma_min = 1/64: layer and VSM apart by", worst);
    out.limit(std::string(name) + ": the same over both bounds of section 6", over, 1);
  }
  return out;
}

}  // namespace

claim layer_floor_claim() {
  return {"C9",
          "Dividing the minimum variance by the square of a layer's width gives every layer a "
          "consistent floor.",
          "[LauritzenMcCool08] eq. 7",
          "The floors of random layers carried back to world units, exactly; then against each "
          "format's quantisation noise, and the light that they leave in thin layers.",
          measure_floor,
          {&consistent}};
}

claim within_layer_claim() {
  return {"C27",
          "Occlusion within one layer is resolved as by a standard VSM.",
          "[LauritzenMcCool08] section 4",
          "All occluders and the receiver inside one random layer: its visibility against the "
          "VSM's, exactly, floors (7) included; then both in each format.",
          measure_within,
          {&within}};
}

}  // namespace bitshade::claims
