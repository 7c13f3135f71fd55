#include "precision/scene_bits.hpp"

#include <cmath>

#include "bitshade/study/measures.hpp"
#include "bitshade/study/precision.hpp"
#include "bitshade/study/precision_stages.hpp"
#include "bitshade/texture/mip.hpp"

namespace bitshade::bit_search {

namespace {

bool exponential(const configuration& how) {
  return how.method == technique::evsm2 || how.method == technique::evsm4;
}
bool stores(stage s) {
  return s == stage::store || s == stage::resolve || s == stage::blur || s == stage::mips;
}

int widest(const configuration& how, stage s) {
  if (s == stage::weights || s == stage::shading) return 23;
  return exponential(how) ? 24 : 28;
}

const char* unit_of(const configuration& how, stage s) {
  if (s == stage::weights) return "fraction";
  return s == stage::shading || exponential(how) ? "significand" : "unorm";
}

/// Roundings that a stage makes on its own: the store one, a blur one a pass, mips one a level.
int roundings_of(const frame& scene, const configuration& how, stage s) {
  if (s == stage::blur) return how.filtered.way == blur_way::one_pass ? 1 : 2;
  if (s == stage::mips) return mip_levels(scene.depth.width, scene.depth.height) - 1;
  return 1;
}

int predicted_bits(const frame& scene, const configuration& how, stage s, double tolerated) {
  precision_question q;
  q.tolerated = tolerated;
  q.floor_deviation = std::sqrt(how.min_variance);
  q.width = uniform_layer_width(how.method == technique::lvsm ? how.layers : 1, how.overlap);
  q.roundings = roundings_of(scene, how, s);
  const double floor = layer_floor_variance(q);
  if (s == stage::weights) {
    return fewest_bits(tolerated, 40,
                       [&](int b) { return weight_error_at(moved_share(b), 1, floor); });
  }
  if (s == stage::shading) {
    return fewest_bits(tolerated, 53,
                       [&](int b) { return shading_error_at(unit_roundoff(b), q.width, floor); });
  }
  if (exponential(how)) {
    return fewest_bits(tolerated, 53, [&](int b) {
      return evsm_error_at(unit_roundoff(b), q.roundings, how.exponent, q.floor_deviation);
    });
  }
  return unorm_bits_needed(q);
}

}  // namespace

scene_bits search_scene(const frame& scene, const configuration& asked, stage which,
                        double tolerated, int threads) {
  configuration how = asked;
  const auto light = [&](int bits) {
    stage_choices choices;
    choices.in_format = bits == 0 ? stage_set::none() : stage_set::only(which);
    how.format = exponential(how) ? "e8m23" : "binary32";
    if (bits > 0 && which == stage::weights) choices.weight_bits = bits;
    if (bits > 0 && which == stage::shading) choices.shading = binary_encoding(8, bits - 1);
    if (bits > 0 && stores(which)) {
      how.format =
          exponential(how) ? "e8m" + std::to_string(bits - 1) : "unorm" + std::to_string(bits);
    }
    return run_staged(scene, how, choices, threads).visibility;
  };
  const auto exact = light(0);
  const auto error_with = [&](int bits) { return compare(light(bits), exact).largest; };
  scene_bits r;
  r.technique = name_of(how.method);
  r.stage = name_of(which);
  r.unit = unit_of(how, which);
  r.layers = how.method == technique::lvsm ? how.layers : 1;
  r.min_variance = how.min_variance;
  r.predicted = predicted_bits(scene, how, which, tolerated);
  int low = 1, high = widest(how, which) + 1;  // low breaks, high keeps or is beyond
  r.error_below = error_with(2);
  if (r.error_below <= tolerated) {
    r.found = 2;
    r.error = r.error_below;
    r.error_below = 0;
    return r;
  }
  low = 2;
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    const double error = error_with(middle);
    if (error <= tolerated) {
      high = middle, r.error = error;
    } else {
      low = middle, r.error_below = error;
    }
  }
  r.found = high > widest(how, which) ? 0 : high;
  return r;
}

}  // namespace bitshade::bit_search
