// C25: summed-area tables, and the reduction of bleeding.
#include <algorithm>
#include <cmath>

#include "claims/footprint.hpp"
#include "claims/laboratory.hpp"
#include "claims/table.hpp"
#include "io/text.hpp"

namespace bitshade::claims {
namespace {

/// Reduced light against the share lit: below it, a penumbra has become too dark.
evaluation keeps_penumbrae(const method& m, const sample& s) {
  const number alpha = s["alpha"];
  if (alpha >= number(1)) return {false};
  const number p = light(m, s.list("x"), s["t"], whole_range, 0);
  const number reduced = m.reduce(p, alpha), truth = share_lit(s.list("x"), s["t"]);
  return {true,
          reduced < truth,
          truth - reduced,
          {{"visibility", p}, {"reduced", reduced}, {"share lit", truth}}};
}

const trial penumbra{"reduced light is no less than the share lit",
                     {{"x", quantity::share, 1, 5}, {"t"}, {"alpha"}},
                     keeps_penumbrae};

/// Whatever bleeds at most alpha is dark afterwards, and the more is taken the darker it gets.
evaluation removes_bleeding(const method& m, const sample& s) {
  const number alpha = s["alpha"];
  if (alpha >= number(1)) return {false};
  const number p = light(m, s.list("x"), s["t"], whole_range, 0);
  const number reduced = m.reduce(p, alpha);
  const bool wrong = reduced > p || (p <= alpha && reduced != number(0));
  return {true, wrong, reduced, {{"visibility", p}, {"reduced", reduced}}};
}

const trial removal{"light of at most alpha becomes darkness, and none is added", penumbra.names,
                    removes_bleeding};

/// Mean error of receivers in a penumbra: whose truth is neither dark nor lit.
double penumbra_error(const std::vector<double>& got, const std::vector<double>& truth) {
  double sum = 0;
  long count = 0;
  for (std::size_t i = 0; i < got.size(); ++i) {
    if (!(truth[i] > 0.1 && truth[i] < 0.9)) continue;
    sum += got[i] - truth[i];
    ++count;
  }
  return count == 0 ? 0 : sum / static_cast<double>(count);
}

outcome measure(laboratory& lab) {
  outcome out;
  const frame& beams = lab.scene("beams");
  std::vector<std::function<double()>> runs;
  const std::vector<int> sizes{3, 9, 25};
  for (const int taps : sizes) {
    configuration how;
    how.method = technique::savsm;
    how.format = "unorm16";
    how.smallest_box = taps;
    runs.push_back([&lab, &beams, how] {
      const cell got = lab.under_test().render(beams, how, 1);
      return got.map_seconds + got.shade_seconds;
    });
  }
  const auto times = time_in_turn(runs, 7);
  for (std::size_t i = 1; i < sizes.size(); ++i)
    out.add("map and shading with boxes of at least " + std::to_string(sizes[i]) + ", over 3",
            times[i].low / times[0].low, "", true);
  out.claim("a filter of 25 x 25 takes no more than a quarter longer than one of 3 x 3",
            times.back().low <= 1.25 * times.front().low);

  out.claim("light of at most alpha becomes darkness",
            out.none_in(lab.search(removal, 2501, 4000), "removal"));
  out.claim("penumbrae darken: light falls below the share lit",
            !out.none_in(lab.search(penumbra, 2502, 2000), "penumbrae"));

  configuration how;
  how.format = "exact";
  const auto truth = truth_geometric(beams, how, lab.threads());
  double bleed[2] = {}, shade[2] = {};
  for (const double alpha : {0.0, 0.1, 0.3, 0.6}) {
    how.bleeding_reduction = alpha;
    const auto picture = lab.picture(beams, how);
    const double area = 100 * picture.figures.bleed_area,
                 error = penumbra_error(picture.got.visibility, truth);
    out.add("beams, alpha " + brief(alpha, 1) + ": bleeding", area, "% of receivers");
    out.add("beams, alpha " + brief(alpha, 1) + ": mean error in penumbrae", error);
    bleed[alpha > 0] = area, shade[alpha > 0] = error;
  }
  out.claim("alpha = 0.6 leaves at most a tenth of the bleeding area", bleed[1] <= 0.1 * bleed[0]);
  out.claim("and darkens penumbrae", shade[1] < shade[0]);
  return out;
}

}  // namespace

claim summed_area_claim() {
  return {
      "C25",
      "Summed-area tables filter at constant cost whatever the size; the reduction (11) removes "
      "bleeding at the price of darker penumbrae.",
      "[LauritzenMcCoolSAVSM]",
      "Native times of three box sizes; random footprints reduced by random alpha, exactly; "
      "bleeding area and penumbrae on beams against alpha.",
      measure,
      {&penumbra, &removal}};
}

}  // namespace bitshade::claims
