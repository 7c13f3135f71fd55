// C23: exponential variance shadow maps.
#include <algorithm>
#include <cmath>

#include "bitshade/shadow/evsm.hpp"
#include "claims/footprint.hpp"
#include "claims/laboratory.hpp"
#include "claims/table.hpp"
#include "io/text.hpp"

namespace bitshade::claims {
namespace {

/// Both bounds of a footprint in binary64, no floor.
struct both_bounds {
  double positive, negative;
};

both_bounds bounds_of(const method& m, const sample& s, double c) {
  const evsm_constants constants{c, c, 1};
  std::vector<number> x[2], squares[2];
  for (const double depth : s.reals("x")) {
    const double w[2] = {positive_warp(depth, constants), negative_warp(depth, constants)};
    for (int k = 0; k < 2; ++k) {
      x[k].emplace_back(w[k]);
      squares[k].push_back(x[k].back() * x[k].back());
    }
  }
  // Filters and Chebyshev stay exact: only e^x is rounded.
  const number t[2] = {number(positive_warp(s.real("t"), constants)),
                       number(-negative_warp(s.real("t"), constants))};
  double p[2];
  for (int k = 0; k < 2; ++k) {
    auto at = m.variance(m.filter(x[k]), m.filter(squares[k]));
    if (k == 1) at.mean = -at.mean;
    p[k] = static_cast<double>(m.chebyshev(at, t[k], 0));
  }
  return {p[0], p[1]};
}

/// What rounding e^x once can do to p where its variance is not tiny; cases nearer are left out.
constexpr double margin = 1e-6;

evaluation larger_is_darker(const method& m, const sample& s) {
  if (!(s["c"] < s["larger"])) return {false};
  const both_bounds small = bounds_of(m, s, s.real("c")), large = bounds_of(m, s, s.real("larger"));
  const double before = m.darker(small.positive, small.negative),
               after = m.darker(large.positive, large.negative);
  return {true,
          after > before + margin,
          number(std::max(0.0, after - before)),
          {{"visibility with c", number(before)},
           {"visibility with the larger c", number(after)},
           {"share lit", share_lit(s.list("x"), s["t"])}}};
}

const trial larger_exponent{
    "a larger c gives no more light",
    {{"x", quantity::share, 2, 4}, {"t"}, {"c", quantity::whole}, {"larger", quantity::whole}},
    larger_is_darker};

void two_in_front(sample& s) {
  s.list("x").resize(2);
  for (number& x : s.list("x")) x = std::min(x, s["t"]);
}

/// Whether an artefact of both together is one of each alone.
bool only_where_both(const laboratory& lab, outcome& out) {
  long artefacts = 0, alone = 0;
  for_cases(larger_exponent.names, lab.stream(2302), lab.tries(2000), nullptr,
            [&](const sample& s) {
              const both_bounds p = bounds_of(lab.under_test(), s, s.real("c"));
              const auto truth = static_cast<double>(share_lit(s.list("x"), s["t"]));
              const auto shows = [&](double light) { return light > truth + tolerated_error; };
              if (!shows(lab.under_test().darker(p.positive, p.negative))) return;
              ++artefacts;
              alone += shows(p.positive) && shows(p.negative) ? 0 : 1;
            });
  out.add("random footprints with too much light", static_cast<double>(artefacts));
  out.add("of these with one warp alone to blame", static_cast<double>(alone));
  return alone == 0;
}

outcome measure(laboratory& lab) {
  outcome out;
  out.claim("too much light only where both warps give too much", only_where_both(lab, out));
  out.claim("a larger c never gives more light",
            out.none_in(lab.search(larger_exponent, 2301, 2500), "any footprint"));
  const bool in_front = out.none_in(lab.search(larger_exponent, 2303, 2500, two_in_front),
                                    "two depths, none behind the receiver");

  for (const auto& [name, format] : storage_formats()) {
    const double cap = std::min(exponent_cap(format), 100.0);
    const bool free = ends_at_one(format);
    if (!free) out.add(std::string(name) + ": largest c before e^2c overflows", cap);
    const double c = free ? 5 : cap;
    out.add(std::string(name) + ", c = " + brief(c) + ": noise 3u/c^2, as depth",
            std::sqrt(warped_noise(format, 1) / (c * c)));
  }
  bool better = true, faster = true;
  for (const char* name : {"garden", "beams"}) {
    const frame& scene = lab.scene(name);
    configuration evsm, lvsm, csm;
    evsm.method = technique::evsm4, evsm.format = "binary32", evsm.exponent = 20;
    evsm.negative_exponent = 20;
    lvsm.method = technique::lvsm, lvsm.layers = 4, lvsm.splits = split_rule::lloyd;
    csm.method = technique::csm, csm.format = "unorm8", csm.terms = 8;
    struct {
      const char* name;
      const configuration& how;
      double rmse;
    } all[] = {{"EVSM, 4 x binary32, c = 20", evsm, 0},
               {"LVSM, 4 layers of unorm16", lvsm, 0},
               {"CSM, 8 terms of unorm8", csm, 0}};
    std::vector<std::function<double()>> runs;
    for (auto& each : all) {
      each.rmse = lab.picture(scene, each.how).figures.total.rmse;
      out.add(std::string(name) + ", " + each.name + ": RMSE", each.rmse);
      runs.push_back([&lab, &scene, how = each.how] {
        const cell got = lab.under_test().render(scene, how, 1);
        return got.map_seconds + got.shade_seconds;
      });
    }
    const auto times = time_in_turn(runs, 5);
    for (const std::size_t other : {1u, 2u}) {
      const double ratio = times[other].low / times[0].low;
      out.add(std::string(name) + ": time of " + all[other].name + " over EVSM's", ratio, "", true);
      faster = faster && ratio > 1;
      better = better && all[0].rmse < all[other].rmse;
    }
  }
  out.claim("on both scenes a smaller error than LVSM and CSM", better);
  out.claim("on both scenes faster than LVSM and CSM", faster);
  out.condition =
      "two occluders lie in front of the receiver and the format holds e^2c; not in general, and "
      "not in every comparison";
  out.provided("a larger c never gives more light behind two occluders", in_front);
  out.provided("too much light only where both warps give too much", out.claimed.front().held);
  return out;
}

}  // namespace

claim exponential_claim() {
  return {
      "C23",
      "EVSM shows artefacts only where both warps do; a larger c reduces them; it is better and "
      "faster than LVSM and CSM.",
      "[LauritzenMcCool08] section 7",
      "Both bounds of random footprints with random exponents, everything exact but e^x; "
      "overflow and noise limits of c; errors and times on two scenes.",
      measure,
      {&larger_exponent}};
}

}  // namespace bitshade::claims
