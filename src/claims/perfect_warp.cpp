// C4: a step at the receiver's depth, the perfect warp.
#include <algorithm>

#include "claims/footprint.hpp"
#include "claims/laboratory.hpp"
#include "claims/table.hpp"

namespace bitshade::claims {
namespace {

/// The step at c as the thinnest layer there is: everything in front of it becomes 0.
interval step_at(const sample& s) { return {s.real("c") - split_grid, s.real("c")}; }

evaluation evaluate(const method& m, const sample& s) {
  const auto& x = s.list("x");
  const interval step = step_at(s);
  const number b = *std::max_element(x.begin(), x.end());
  if (!(step.near >= 0 && b <= number(step.near))) return {false};
  const double floor = s.real("floor");
  const number at_c = light(m, x, s["c"], step, floor), at_b = light(m, x, b, step, floor);
  return {true,
          at_c != number(0) || at_b != number(1),
          at_c + abs(number(1) - at_b),
          {{"light at C", at_c}, {"light at B", at_b}, {"share lit at B", share_lit(x, b)}}};
}

const trial step_warp{
    "C gets no light and B all of it",
    {{"x", quantity::share, 2, 5}, {"c", quantity::grid}, {"floor", quantity::grid}},
    evaluate};

void occluders_in_front(sample& s) {
  const number limit = std::max(number(0), number(s.real("c") - split_grid));
  for (number& x : s.list("x")) x = std::min(x, limit);
}
void unfloored(sample& s) {
  occluders_in_front(s);
  s.list("floor").front() = 0;
}

outcome measure(laboratory& lab) {
  outcome out;
  out.claim("C gets 0 and B gets 1, whatever the floor",
            out.none_in(lab.search(step_warp, 401, 3000, occluders_in_front), "any floor"));
  out.condition = "no floor acts";
  out.provided("C gets 0 and B gets 1",
               out.none_in(lab.search(step_warp, 402, 5000, unfloored), "no floor"));
  double lost = 0;
  for (const auto& [name, format] : storage_formats()) {
    double worst = 0;
    for_cases(step_warp.names, lab.stream(403), lab.tries(800), unfloored, [&](const sample& s) {
      const evaluation e = evaluate(lab.under_test(), s);
      if (!e.admissible) return;
      lost = std::max(lost, 1 - static_cast<double>(e.numbers[2].value));
      worst = std::max(worst, static_cast<double>(stored_light(
                                  lab.under_test(), format, s.list("x"), s["c"], step_at(s), 0)));
    });
    out.add(std::string(name) + ", no floor: most light at C", worst);
  }
  out.add("most shadow on B itself that the step loses", lost);
  out.remarks.push_back(
      "The step serves one receiver depth alone: what the nearer occluder does to B is lost, and "
      "the floor of a layer that thin is capped at 1, which lights C by a half.");
  return out;
}

}  // namespace

claim perfect_warp_claim() {
  return {
      "C4",
      "A warp that steps at the depth of receiver C leaves no light there and full light at the "
      "occluder B in front of it.",
      "[LauritzenMcCool08] eq. 5",
      "The step as a layer of width 2^-24 that ends at C, random occluders in front; with and "
      "without the floor that (7) gives such a layer.",
      measure,
      {&step_warp}};
}

}  // namespace bitshade::claims
