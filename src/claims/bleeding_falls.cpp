// C2: bleeding falls with the square of the distance behind two occluders.
#include <cmath>

#include "bitshade/study/bounds_visibility.hpp"
#include "bitshade/texture/elementary.hpp"
#include "claims/footprint.hpp"
#include "claims/laboratory.hpp"
#include "claims/table.hpp"

namespace bitshade::claims {
namespace {

/// The receiver lies at depth 1, the occluders dy and dy + dx in front of it.
std::vector<number> occluders(const sample& s) {
  const number b = number(1) - s["dy"], a = b - s["dx"];
  const int nearer = static_cast<int>(s.real("nearer")),
            farther = static_cast<int>(s.real("farther"));
  return two_depths(a, b, nearer, nearer + farther);
}

evaluation evaluate(const method& m, const sample& s) {
  if (s["dx"] == number(0) || s["dy"] == number(0) || s["dx"] + s["dy"] > number(1)) return {false};
  const number share = s["nearer"] / (s["nearer"] + s["farther"]);
  const number p = light(m, occluders(s), number(1), whole_range, 0);
  const number predicted = two_occluder_bleeding(share, s["dx"], s["dy"]);
  const number limit = s["dx"] * s["dx"] / (number(4) * s["dy"] * s["dy"]);
  const number beyond = p > limit ? p - limit : number(0);
  return {true,
          p != predicted || p > limit,
          beyond + abs(p - predicted),
          {{"visibility", p}, {"equation (4)", predicted}, {"(dx/dy)^2 / 4", limit}}};
}

const trial falls{"the light behind two occluders is (4) and at most (dx/dy)^2 / 4",
                  {{"dx"}, {"dy"}, {"nearer", quantity::whole}, {"farther", quantity::whole}},
                  evaluate};

/// p half and half at dy = ratio dx.
double bleeding_at(const method& m, const number& ratio) {
  const number dx = number(1) / (number(1) + ratio), b = dx;
  return static_cast<double>(light(m, two_depths(0, b, 1, 2), number(1), whole_range, 0));
}

/// -d ln p / d ln dy there, over a sixteenth of an octave or so.
double local_exponent(const method& m, const number& ratio) {
  const number low = ratio * number(63, 64), high = ratio * number(65, 64);
  return -(log2_fixed(bleeding_at(m, high)) - log2_fixed(bleeding_at(m, low))) /
         log2_fixed(65.0 / 63.0);
}

outcome measure(laboratory& lab) {
  outcome out;
  const method& m = lab.under_test();
  out.claim("p is equation (4) and never above (dx/dy)^2 / 4",
            out.none_in(lab.search(falls, 201, 6000), "equation (4)"));
  for (const int ratio : {1, 10, 100, 1000})
    out.add("local exponent at dy = " + std::to_string(ratio) + " dx", local_exponent(m, ratio));
  const double last = local_exponent(m, 1000);
  out.claim("the local exponent is within 0.01 of 2 at dy = 1000 dx", std::fabs(last - 2) < 0.01);
  out.limit("distance of the exponent at dy = dx from the derivative's 1.2",
            std::fabs(local_exponent(m, 1) - 1.2), 1e-3);
  for (const auto& [name, format] : storage_formats()) {
    double worst = 0;
    for_cases(falls.names, lab.stream(202), lab.tries(1000), nullptr, [&](const sample& s) {
      const evaluation e = evaluate(m, s);
      if (!e.admissible) return;
      const number got = stored_light(m, format, occluders(s), number(1), whole_range, 0);
      worst = std::max(worst, static_cast<double>(abs(got - e.numbers[1].value)));
    });
    out.add(std::string(name) + ", no floor: largest distance from (4)", worst);
  }
  out.remarks.push_back(
      "The fall is quadratic only far behind: next to the occluders it is slower, so that the "
      "bleeding one sees is not the asymptotic one.");
  return out;
}

}  // namespace

claim bleeding_falls_claim() {
  return {"C2",
          "Light bleeding behind two occluders falls like the square of the distance behind them.",
          "[LauritzenMcCool08] eq. 4",
          "Visibility behind two depths against (4) and against (dx/dy)^2 / 4; its local exponent "
          "from differences of exact values, up to dy = 1000 dx.",
          measure,
          {&falls}};
}

}  // namespace bitshade::claims
