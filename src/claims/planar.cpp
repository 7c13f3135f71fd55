// C1: behind one plane the reconstruction is exact.
#include "bitshade/study/bounds_visibility.hpp"
#include "claims/footprint.hpp"
#include "claims/laboratory.hpp"
#include "claims/table.hpp"

namespace bitshade::claims {
namespace {

/// Texels of an occluder at depth a, and of a receiver around depth t that slants across them.
std::vector<number> planes(const sample& s) {
  std::vector<number> x(static_cast<std::size_t>(s.real("covered")), s["a"]);
  const int open = static_cast<int>(s.real("open"));
  for (int k = 0; k < open; ++k)
    x.push_back(s["t"] + s["slope"] * number(2 * k + 1 - open, 2 * open));
  return x;
}

evaluation evaluate(const method& m, const sample& s) {
  const number half_span = s["slope"] / number(2);
  if (!(s["a"] < s["t"] - half_span) || s["t"] + half_span > number(1)) return {false};
  const number truth = s["open"] / (s["covered"] + s["open"]);
  const number p = light(m, planes(s), s["t"], whole_range, s.real("floor"));
  return {true, p != truth, abs(p - truth), {{"visibility", p}, {"share lit", truth}}};
}

const trial exact_behind_a_plane{"the light is the share lit",
                                 {{"a"},
                                  {"t"},
                                  {"covered", quantity::whole},
                                  {"open", quantity::whole},
                                  {"slope"},
                                  {"floor", quantity::grid}},
                                 evaluate};

void no_slope(sample& s) { s.list("slope").front() = 0; }
void no_floor(sample& s) { s.list("floor").front() = 0; }
void square_and_unfloored(sample& s) { no_slope(s), no_floor(s); }

outcome measure(laboratory& lab) {
  outcome out;
  out.claim("planes of any slope: exact",
            out.none_in(lab.search(exact_behind_a_plane, 101, 3000, no_floor), "slanted"));
  out.claim("with the variance's floor: exact",
            out.none_in(lab.search(exact_behind_a_plane, 102, 3000, no_slope), "floored"));
  out.condition = "both planes face the light squarely and no floor acts";
  out.provided("exact for every depth and coverage",
               out.none_in(lab.search(exact_behind_a_plane, 103, 4000, square_and_unfloored),
                           "square, no floor"));

  for (const auto& [name, format] : storage_formats()) {
    double worst = 0, share_of_bound = 0;
    const double step = largest_step(format);
    for_cases(exact_behind_a_plane.names, lab.stream(104), lab.tries(1500), square_and_unfloored,
              [&](const sample& s) {
                if (!(s["a"] < s["t"])) return;
                const auto x = planes(s);
                const number truth = s["open"] / (s["covered"] + s["open"]);
                const auto error = static_cast<double>(
                    abs(stored_light(lab.under_test(), format, x, s["t"], whole_range, 0) - truth));
                const double mean = static_cast<double>(lab.under_test().filter(x));
                const auto gap = static_cast<double>(s["t"] - s["a"]);
                const double variance =
                    static_cast<double>(truth * (number(1) - truth)) * gap * gap;
                const double e = moment_error(step, 1), noise = variance_error(e, mean).width();
                worst = std::max(worst, error);
                if (variance <= 2 * noise) return;  // the bound asks for a variance above the noise
                share_of_bound =
                    std::max(share_of_bound, error / visibility_error(noise, e, variance - noise));
              });
    out.add(std::string(name) + ", square, no floor: largest error", worst);
    out.limit(std::string(name) + ": error over its bound, where variance > 2 D", share_of_bound,
              1);
  }
  out.remarks.push_back(
      "Without a floor no format keeps a bound where occluder and receiver nearly touch: the "
      "variance is then smaller than its own rounding.");
  return out;
}

}  // namespace

claim planar_claim() {
  return {"C1",
          "One planar occluder in front of one planar receiver is reconstructed exactly.",
          "[LauritzenMcCool08]",
          "Random depths and coverages, the receiver's plane slanted across the footprint or not; "
          "visibility against the share of the footprint that is lit, in exact arithmetic, then "
          "with moments stored in formats.",
          measure,
          {&exact_behind_a_plane}};
}

}  // namespace bitshade::claims
