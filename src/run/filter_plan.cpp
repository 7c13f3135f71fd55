#include "run/filter_plan.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

#include "bitshade/texture/blur_variants.hpp"
#include "run/lookup.hpp"

namespace bitshade {

namespace {

/// Below it a moment's eighth may be a subnormal binary32: the mean of equal samples may differ.
constexpr float smallest_resolved_depth = 0x1p-60F;

effect msaa_effect(const frame& scene, const configuration& how) {
  effect e{"msaa", true, false, ""};
  const auto& samples = scene.samples.at(how.filtered.msaa);
  std::size_t differing = 0, tiny = 0;
  for (std::size_t i = 0; i < scene.depth.texels.size(); ++i) {
    const float centre = scene.depth.texels[i];
    const auto differs = [&](const map_sample& s) { return s.depth.texels[i] != centre; };
    differing += std::any_of(samples.begin(), samples.end(), differs) ? 1 : 0;
    tiny += centre > 0 && centre < smallest_resolved_depth ? 1 : 0;
  }
  e.needed = differing > 0 || (tiny > 0 && !how.exact());
  e.evidence = std::to_string(differing) + " of " + std::to_string(scene.depth.texels.size()) +
               " texels have samples of several depths";
  if (differing == 0 && e.needed) {
    e.evidence += ", but " + std::to_string(tiny) + " are so near that their mean may be rounded";
  }
  return e;
}

effect one_pass_effect(const configuration& how) {
  return {"one-pass blur", true, !how.exact(),
          how.exact() ? "exact sums are the same in one pass and in two"
                      : "the products are summed, and stored, in another order"};
}

effect fractions_effect(const configuration& how) {
  effect e{"blur fractions", true, false, ""};
  const auto taps = linear_taps(blur_of(how));
  const double grid = std::ldexp(1.0, how.filtered.fraction_bits);
  const auto off_grid = [&](const linear_tap& tap) {
    return std::floor(tap.offset * grid) != tap.offset * grid;
  };
  const auto count = std::count_if(taps.begin(), taps.end(), off_grid);
  e.needed = count > 0 && !how.exact();
  e.evidence = how.exact() ? "exact weights lie on no grid"
                           : std::to_string(count) + " of " + std::to_string(taps.size()) +
                                 " fetches lie between steps of 2^-" +
                                 std::to_string(how.filtered.fraction_bits) + " texels";
  return e;
}

}  // namespace

std::vector<effect> filter_effects(const frame& scene, const configuration& how) {
  std::vector<effect> effects;
  const filtering& f = how.filtered;
  if (f.msaa > 1 && takes_samples(how.method)) effects.push_back(msaa_effect(scene, how));
  if (how.blurred() && blurs_its_map(how.method)) {
    if (f.way == blur_way::one_pass) effects.push_back(one_pass_effect(how));
    if (f.way == blur_way::linear && f.fraction_bits > 0) effects.push_back(fractions_effect(how));
  }
  if (f.lookups > 1 && averages_lookups(how.method)) {
    effects.push_back({"several lookups", true, true,
                       "each light is the mean of " + std::to_string(f.lookups * f.lookups)});
  }
  return effects;
}

double smallest_blur_share(const configuration& how) {
  double least = 1;
  const auto take = [&](double w) {
    if (w > 0) least = std::min(least, w);
  };
  for (const double w : blur_of(how).weights) take(w);
  if (how.filtered.way == blur_way::linear) {
    for (const int bits : {0, how.filtered.fraction_bits}) {
      for (const linear_tap& tap : linear_taps(blur_of(how), bits)) {
        const double f = tap.offset - std::floor(tap.offset);
        take(tap.weight * f);
        take(tap.weight * (1 - f));
      }
    }
  }
  return least;
}

}  // namespace bitshade
