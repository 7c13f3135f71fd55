// C7 and C8: where a layer is exact: behind occluders in front of it, and at its boundaries.
#include <algorithm>

#include "bitshade/study/bounds_visibility.hpp"
#include "claims/footprint.hpp"
#include "claims/laboratory.hpp"
#include "claims/table.hpp"

namespace bitshade::claims {
namespace {

void no_floor(sample& s) { s.list("floor").front() = 0; }

// C7 ----------------------------------------------------------------------------------------------

evaluation dark_behind(const method& m, const sample& s) {
  const interval layer{s.real("near"), s.real("far")};
  const auto& x = s.list("x");
  const bool in_front = *std::max_element(x.begin(), x.end()) <= number(layer.near);
  const bool inside = s["t"] > number(layer.near) && s["t"] <= number(layer.far);
  if (!in_front || !inside) return {false};
  const number p = light(m, x, s["t"], layer, s.real("floor"));
  const number d = m.warp(s["t"], layer), f = layer_floor<number>(s.real("floor"), layer);
  return {
      true, p != number(0), p, {{"visibility", p}, {"residue f/(f + d^2)", floor_residue(f, d)}}};
}

const trial behind_all{"behind occluders in front of its layer a receiver is dark",
                       {{"x", quantity::share, 1, 5},
                        {"t"},
                        {"near", quantity::grid},
                        {"far", quantity::grid},
                        {"floor", quantity::grid}},
                       dark_behind};

void in_front(sample& s) {
  const number near = std::min(s["near"], s["far"]), far = std::max(s["near"], s["far"]);
  s.list("near").front() = near, s.list("far").front() = far;
  for (number& x : s.list("x")) x = std::min(x, near);
  s.list("t").front() = std::min(s["t"], far);
}
void in_front_no_floor(sample& s) { in_front(s), no_floor(s); }

outcome measure_above(laboratory& lab) {
  outcome out;
  const method& m = lab.under_test();
  out.claim("with the layer's floor: no light",
            out.none_in(lab.search(behind_all, 701, 3000, in_front), "floored"));
  out.condition = "no floor acts; with one, exactly f/(f + d^2) is left of the light";
  out.provided("no light",
               out.none_in(lab.search(behind_all, 702, 6000, in_front_no_floor), "no floor"));
  number off = 0;
  for_cases(behind_all.names, lab.stream(703), lab.tries(3000), in_front, [&](const sample& s) {
    const evaluation e = dark_behind(m, s);
    if (e.admissible) off = std::max(off, abs(e.numbers[0].value - e.numbers[1].value));
  });
  out.provided("the floor's light is its residue, to the last bit", off == number(0));
  out.limit("largest distance of the light from the residue", static_cast<double>(off), 0);
  for (const auto& [name, format] : storage_formats()) {
    double worst = 0;
    for_cases(behind_all.names, lab.stream(704), lab.tries(800), in_front_no_floor,
              [&](const sample& s) {
                if (!dark_behind(m, s).admissible) return;
                worst = std::max(
                    worst, static_cast<double>(stored_light(m, format, s.list("x"), s["t"],
                                                            {s.real("near"), s.real("far")}, 0)));
              });
    out.add(std::string(name) + ", no floor: most light", worst);
  }
  return out;
}

// C8 ----------------------------------------------------------------------------------------------

/// The receiver lies on the first split, in the layer that the method says.
evaluation exact_on_split(const method& m, const sample& s) {
  const auto made = layers_from(m, s.reals("splits"), 0);
  if (made.splits.size() < 3) return {false};
  const number t(made.splits[1]);
  const auto own = static_cast<std::size_t>(m.layer_of(t, made.splits));
  const number p = light(m, s.list("x"), t, made.layers[own], s.real("floor"));
  const number truth = share_lit(s.list("x"), t);
  return {true, p != truth, abs(p - truth), {{"visibility", p}, {"share lit", truth}}};
}

const trial on_split{
    "on a split the light is the share lit",
    {{"x", quantity::share, 1, 5}, {"splits", quantity::grid, 1, 2}, {"floor", quantity::grid}},
    exact_on_split};

/// The limit from behind: one step of the grid beyond the first split, in the farther layer.
evaluation exact_past_split(const method& m, const sample& s) {
  const auto made = layers_from(m, s.reals("splits"), 0);
  if (made.splits.size() < 3) return {false};
  const number t(made.splits[1] + split_grid);
  const auto own = static_cast<std::size_t>(m.layer_of(t, made.splits));
  const number p = light(m, s.list("x"), t, made.layers[own], 0);
  const number truth = share_lit(s.list("x"), t);
  return {true, p != truth, abs(p - truth), {{"visibility", p}, {"share lit", truth}}};
}

const trial past_split{"2^-24 past a split the light is the share lit, without a floor",
                       on_split.names, exact_past_split};

/// Moves what lies strictly inside the nearer layer (0, s_1) to its near end.
void none_inside(sample& s) {
  no_floor(s);
  const auto& splits = s.list("splits");
  const number first = *std::min_element(splits.begin(), splits.end());
  for (number& x : s.list("x"))
    if (x < first) x = 0;
}

outcome measure_boundary(laboratory& lab) {
  outcome out;
  out.claim("exact on a split, whatever lies inside the layer",
            out.none_in(lab.search(on_split, 801, 3000, no_floor), "on a split"));
  out.claim("exact just past a split, nothing inside the nearer layer",
            out.none_in(lab.search(past_split, 802, 3000, none_inside), "just past a split"));
  out.condition =
      "the boundary is the far end of the receiver's own layer, no occluder lies strictly inside "
      "that layer and no floor acts";
  out.provided("exact on a split", out.none_in(lab.search(on_split, 803, 5000, none_inside),
                                               "on a split, none inside"));
  out.remarks.push_back(
      "At its near end a layer knows only whether anything lies behind it: one texel there lights "
      "the whole footprint.");
  return out;
}

}  // namespace

claim above_layer_claim() {
  return {"C7",
          "Where every occluder lies in front of a layer, receivers inside it are exactly dark.",
          "[LauritzenMcCool08] section 4",
          "Random occluders in front of random layers, random receivers inside: the light that is "
          "left, exactly, with and without the floor (7).",
          measure_above,
          {&behind_all}};
}

claim boundary_claim() {
  return {"C8",
          "The piecewise function of all layers is exact at the boundaries of their intervals.",
          "[LauritzenMcCool08] section 4",
          "Receivers on a split and one step of 2^-24 past it, occluders inside the layer or not: "
          "visibility against the share lit, exactly.",
          measure_boundary,
          {&on_split, &past_split}};
}

}  // namespace bitshade::claims
