#include "precision/scene_bits.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "bitshade/study/bounds_sums.hpp"
#include "bitshade/study/measures.hpp"
#include "bitshade/study/precision.hpp"
#include "bitshade/study/precision_stages.hpp"
#include "bitshade/texture/mip.hpp"
#include "run/summed_area.hpp"

namespace bitshade::bit_search {

namespace {

constexpr std::array<const char*, 3> unit_names{"unorm", "significand", "fraction"};

bool bounded(const configuration& how, const scene_search& search) {
  return search.which && how.method != technique::msm;
}
bool stores(stage s) {
  return s == stage::store || s == stage::resolve || s == stage::blur || s == stage::mips;
}

int widest(const configuration& how, const scene_search& search) {
  if (search.unit == bit_unit::unorm) return 28;
  if (search.which == stage::weights || search.which == stage::shading) return 23;
  return how.method == technique::savsm ? 52 : 24;
}

/// Floats have the range of binary32, so that nothing but the significand counts.
std::string format_of(bit_unit unit, int bits) {
  return unit == bit_unit::unorm ? "unorm" + std::to_string(bits)
                                 : "e8m" + std::to_string(bits - 1);
}

/// Roundings that a stage makes on its own: the store one, a blur one a pass, mips one a level.
int roundings_of(const frame& scene, const configuration& how, stage s) {
  if (s == stage::blur) return how.filtered.way == blur_way::one_pass ? 1 : 2;
  if (s == stage::mips) return mip_levels(scene.depth.width, scene.depth.height) - 1;
  return 1;
}

/// The rectangle of the scene's receivers that running sums serve worst: the narrowest.
summed_rectangle narrowest_rectangle(const frame& scene, const configuration& how) {
  summed_rectangle worst;
  worst.map_width = worst.width = scene.depth.width;
  worst.map_height = worst.height = scene.depth.height;
  for (const receiver& r : scene.receivers) {
    if (r.surface == 0) continue;
    const auto box = box_of(r, scene.depth.width, scene.depth.height, how.smallest_box);
    worst.width = std::min(worst.width, box.x1 - box.x0);
    worst.height = std::min(worst.height, box.y1 - box.y0);
  }
  return worst;
}

int predicted_bits(const frame& scene, const configuration& how, const scene_search& search,
                   double tolerated) {
  if (!bounded(how, search)) return 0;
  const stage s = *search.which;
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
  if (s == stage::sums) {
    summed_rectangle r = narrowest_rectangle(scene, how);
    return fewest_bits(tolerated, widest(how, search), [&](int b) {
      r.arithmetic = unit_roundoff(b <= 24 ? 24 : 53);
      r.store = unit_roundoff(b);
      return summed_error_at(r, floor);
    });
  }
  if (how.method == technique::esm) {
    return fewest_bits(tolerated, 53,
                       [&](int b) { return esm_error_at(unit_roundoff(b), q.roundings); });
  }
  if (how.method == technique::csm) {
    return fewest_bits(tolerated, 53, [&](int b) {
      return csm_error_at(moment_error(1 / static_cast<double>((1ULL << b) - 1), q.roundings),
                          how.terms);
    });
  }
  if (warps_exponentially(how.method)) {
    return fewest_bits(tolerated, 53, [&](int b) {
      return evsm_error_at(unit_roundoff(b), q.roundings, how.exponent, q.floor_deviation);
    });
  }
  return search.unit == bit_unit::unorm ? unorm_bits_needed(q) : significand_bits_needed(q);
}

scene_bits searched(const frame& scene, const configuration& unrounded, const scene_search& search,
                    double tolerated, const std::vector<double>& exact, int threads) {
  const auto error_with = [&](int bits) {
    configuration how = unrounded;
    stage_choices choices;
    if (search.which) choices.in_format = stage_set::only(*search.which);
    if (search.which == stage::weights) {
      choices.weight_bits = bits;
    } else if (search.which == stage::shading) {
      choices.shading = binary_encoding(8, bits - 1);
    } else {
      how.format = format_of(search.unit, bits);
    }
    return compare(run_staged(scene, how, choices, threads).visibility, exact).largest;
  };
  scene_bits r;
  r.technique = name_of(unrounded.method);
  r.stage = search.which ? name_of(*search.which) : "all";
  r.unit = unit_names[static_cast<std::size_t>(search.unit)];
  r.layers = unrounded.method == technique::lvsm ? unrounded.layers : 1;
  r.min_variance = uses_floor(unrounded.method) ? unrounded.min_variance : 0;
  r.bounded = bounded(unrounded, search);
  r.predicted = predicted_bits(scene, unrounded, search, tolerated);
  const int most = widest(unrounded, search);
  r.error_below = error_with(2);
  if (r.error_below <= tolerated) {
    r.found = 2;
    r.error = r.error_below;
    r.error_below = 0;
    return r;
  }
  int low = 2, high = most + 1;  // low breaks, high keeps or is beyond
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    const double error = error_with(middle);
    if (error <= tolerated) {
      high = middle, r.error = error;
    } else {
      low = middle, r.error_below = error;
    }
  }
  r.found = high > most ? 0 : high;
  return r;
}

}  // namespace

std::vector<scene_search> searches_of(const configuration& asked) {
  configuration how = asked;
  const bool sums = how.method == technique::savsm;
  how.format = "half";  // with sums
  std::vector<scene_search> all;
  const auto add_stores = [&](bit_unit unit) {
    for (const stage s : stages_of(how))
      if (stores(s)) all.push_back({s, unit});
  };
  const bit_unit unit = warps_exponentially(how.method) ? bit_unit::significand : bit_unit::unorm;
  add_stores(unit);
  all.push_back({{}, unit});
  if (sums) add_stores(bit_unit::significand);
  for (const stage s : stages_of(how)) {
    if (s == stage::sums) all.push_back({s, bit_unit::significand});
    if (!stores_variance(how.method)) continue;
    if (s == stage::weights) all.push_back({s, bit_unit::fraction});
    if (s == stage::shading) all.push_back({s, bit_unit::significand});
  }
  if (sums) all.push_back({{}, bit_unit::significand});
  return all;
}

std::vector<scene_bits> search_scene(const frame& scene, const configuration& how,
                                     const std::vector<scene_search>& searches, double tolerated,
                                     int threads) {
  if (searches.empty()) return {};
  configuration unrounded = how;
  unrounded.format = warps_exponentially(how.method) ? "e8m23" : "binary32";
  const auto exact =
      run_staged(scene, unrounded, {stage_set::none(), 0, {}}, threads).visibility;
  std::vector<scene_bits> all;
  for (const scene_search& search : searches)
    all.push_back(searched(scene, unrounded, search, tolerated, exact, threads));
  return all;
}

}  // namespace bitshade::bit_search
