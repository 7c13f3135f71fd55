// C26: what a tight range of depths is worth, and what lies before it.
#include <algorithm>
#include <cmath>

#include "bitshade/formats/round_to.hpp"
#include "bitshade/shadow/moments.hpp"
#include "bitshade/study/bounds_visibility.hpp"
#include "claims/footprint.hpp"
#include "claims/laboratory.hpp"
#include "claims/table.hpp"

namespace bitshade::claims {
namespace {

/// The largest error, in world units, of distances between 500 and 510 stored in [near, far].
double world_error(const laboratory& lab, const encoding& format, double near, double far) {
  double most = 0;
  random_stream random = lab.stream(2601);
  for (long i = 0; i < lab.tries(20000); ++i) {
    const number z(random.next(500, 510));
    const number depth = lab.under_test().metric(z, near, far);
    const number stored(round_to(format, static_cast<double>(depth)));
    most = std::max(most, static_cast<double>(abs(stored - depth)) * (far - near));
  }
  return most;
}

/// An occluder before the layer's near plane, as the metric (13) gives it: negative, unless
/// clamped.
evaluation before_near(const method& m, const sample& s) {
  const interval layer{s.real("near"), s.real("far")};
  if (!(layer.near < layer.far) || !(s["d"] < s["near"]) || !(s["t"] > s["near"]) ||
      s["t"] > s["far"])
    return {false};
  const auto depth = [&](const number& z) { return m.metric(z, s["near"], s["far"]); };
  // A texture of [0,1] clamps both moments, each by itself.
  const number first = clamp_depth(depth(s["d"]));
  const number second = clamp_depth(depth(s["d"]) * depth(s["d"]));
  const number p = m.chebyshev(m.variance(first, second), depth(s["t"]), 0);
  const number clamped = light(m, std::vector<number>{s["d"]}, s["t"], layer, 0);
  return {true,
          p != number(0),
          p,
          {{"squared before it is clamped", p}, {"clamped before it is squared", clamped}}};
}

const trial near_plane{"behind a depth in front of the near plane it is dark",
                       {{"d"}, {"t"}, {"near", quantity::grid}, {"far", quantity::grid}},
                       before_near};

/// Moves a case there: near before far, the occluder before near, the receiver between them.
void in_front_of_near(sample& s) {
  if (s["far"] < s["near"]) std::swap(s.list("near").front(), s.list("far").front());
  if (s["d"] >= s["near"]) s.list("d").front() = s["near"] / number(2);
  if (s["t"] <= s["near"] || s["t"] > s["far"]) s.list("t").front() = s["far"];
}

outcome measure_range(laboratory& lab) {
  outcome out;
  bool gained = true;
  for (const auto& [name, format] : storage_formats()) {
    const double loose = world_error(lab, format, 0, 1000),
                 tight = world_error(lab, format, 500, 510);
    out.add(std::string(name) + ": error at 0 to 1000 over that at 500 to 510", loose / tight);
    gained = gained && loose / tight > 50;
  }
  out.claim("a range 100 times tighter gains 50 times the precision or more in every format",
            gained);

  const encoding& single = binary32::value;
  double depth = 0, variance = 0, bare = 0;
  for_cases({{"x", quantity::share, 1, 4}, {"t"}}, lab.stream(2602), lab.tries(2000), nullptr,
            [&](const sample& s) {
              const auto& x = s.list("x");
              const method& m = lab.under_test();
              std::vector<number> first, second, kept_first, kept_second;
              for (const number& d : x) {
                const double stored = round_to(single, static_cast<double>(d));
                first.push_back(d), second.push_back(d * d);
                kept_first.emplace_back(stored);
                kept_second.emplace_back(round_to(single, static_cast<double>(d * d)));
                depth = std::max(depth, static_cast<double>(abs(kept_first.back() - d)));
              }
              const auto at = m.variance(m.filter(first), m.filter(second));
              const auto kept = m.variance(m.filter(kept_first), m.filter(kept_second));
              variance = std::max(variance, static_cast<double>(abs(kept.variance - at.variance)));
            });
  // One texel just in front of the receiver: what noise alone lets through.
  random_stream random = lab.stream(2603);
  for (long i = 0; i < lab.tries(2000); ++i) {
    const number x(random.next(0.5, 1));
    const number t = x + number(0x1p-12);
    bare =
        std::max(bare, static_cast<double>(stored_light(
                           lab.under_test(), single, std::vector<number>{x}, t, whole_range, 0)));
  }
  out.add("binary32: largest error of a depth", depth);
  out.add("binary32: largest error of a variance", variance);
  out.add("binary32, no floor: most light 2^-12 behind one occluder, where there is none", bare);
  out.limit("binary32: error of a variance, against 1.5 2^-24 and a little", variance,
            variance_error(moment_error(0x1p-24, 1), 1.0).width());
  out.claim("binary32 keeps depths and variances to 1e-6", depth <= 1e-6 && variance <= 1e-6);
  out.claim("and visibility without a floor", bare <= 1e-6);
  out.claim("depths before a layer's near plane do no harm, squared before they are clamped",
            out.none_in(lab.search(near_plane, 2604, 3000, in_front_of_near), "d < near"));

  const auto residue = static_cast<double>(
      light(lab.under_test(), std::vector<number>{number(0)}, number(1), whole_range, 0.01));
  out.add("sigma_min^2 = 0.01: light left over the whole depth range", residue);
  out.add("sigma_min^2 = 0.01: distance at which 1/255 is left, in depth ranges",
          narrowest_layer(0.1, tolerated_error));
  out.claim("sigma_min^2 = 0.01 leaves at most 1/255 of light at the far end",
            residue <= tolerated_error);
  out.condition =
      "precision means depths and variances, depths are clamped before they are squared, and the "
      "floor is smaller than 0.01 by far";
  out.provided("a tight range gains 50 times the precision or more", gained);
  out.provided("binary32 keeps depths and variances to 1e-6", depth <= 1e-6 && variance <= 1e-6);
  return out;
}

}  // namespace

claim depth_range_claim() {
  return {"C26",
          "A tight depth range gains precision in proportion; binary32 is accurate to 1e-6; depths "
          "are normalised layer by layer as in (13); sigma_min^2 = 0.01 serves.",
          "[Marinescu11]",
          "The same distances stored over two ranges; errors of depth, variance and visibility in "
          "binary32; occluders before a layer's near plane; the light that the floor leaves.",
          measure_range,
          {&near_plane}};
}

}  // namespace bitshade::claims
