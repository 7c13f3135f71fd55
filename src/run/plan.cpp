#include <algorithm>
#include <limits>
#include <optional>
#include <stdexcept>

#include "bitshade/formats/limits.hpp"
#include "bitshade/shadow/exponential.hpp"
#include "bitshade/shadow/moments.hpp"
#include "io/error.hpp"
#include "run/filter_plan.hpp"
#include "run/lookup.hpp"
#include "run/parallel.hpp"
#include "run/pipeline.hpp"
#include "run/splits.hpp"
#include "run/storage.hpp"

namespace bitshade {

namespace {

std::string count_of(std::size_t some, std::size_t all, const std::string& what) {
  return std::to_string(some) + " of " + std::to_string(all) + " " + what;
}

/// A number as short as it reads well: three significant digits.
std::string brief(double x) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, x, std::chars_format::general, 3).ptr;
  return {text, end};
}

bool layered(const configuration& how) { return how.method == technique::lvsm && how.layers > 1; }

struct receivers_seen {
  std::size_t all = 0;
  std::size_t in_overlap = 0;  ///< closer than delta to a split
  std::size_t by_level = 0;    ///< read a level above 0
  std::size_t by_probes = 0;   ///< read several probes
  std::size_t widened = 0;     ///< look up a layer that an overlap widens
};

receivers_seen look_at(const frame& scene, const configuration& how, const plan& p) {
  receivers_seen seen;
  const auto plain = layer_intervals(p.splits, 0), wide = layer_intervals(p.splits, how.overlap);
  const bool trilinear = how.filter == texel_filter::trilinear;
  for (const receiver& r : scene.receivers) {
    if (!has_receiver(r)) continue;
    ++seen.all;
    if (layered(how)) {
      const auto pair = blended_layers(static_cast<double>(r.t), p.splits, how.overlap);
      const auto own = static_cast<std::size_t>(layer_of(r.t, p.splits));
      seen.in_overlap += pair.near != pair.far ? 1 : 0;
      seen.widened += plain[own] != wide[own] ? 1 : 0;
    }
    if (trilinear || how.max_anisotropy > 1) {
      const auto probes = probes_of(r, scene.depth.width, scene.depth.height, how.max_anisotropy);
      seen.by_level += probes.lambda > 0 ? 1 : 0;
      seen.by_probes += probes.offsets.size() > 1 ? 1 : 0;
    }
  }
  return seen;
}

effect overlap_effect(const configuration& how, const receivers_seen& seen) {
  effect e{"overlap", layered(how) && how.overlap > 0, seen.widened > 0, ""};
  if (!layered(how)) {
    e.evidence = "there is one layer, and nothing to overlap";
  } else if (how.overlap == 0) {
    e.evidence = "the overlap is 0";
  } else {
    e.evidence = count_of(seen.widened, seen.all, "receivers look up a layer that it widens");
  }
  return e;
}

effect transition_effect(const configuration& how, const receivers_seen& seen) {
  effect e{"transition", layered(how) && how.transition && how.lookup == layer_lookup::own,
           seen.in_overlap > 0,
           ""};
  e.evidence = layered(how) ? count_of(seen.in_overlap, seen.all, "receivers lie in an overlap")
                            : "there is one layer, and nothing to blend";
  return e;
}

effect mips_effect(const configuration& how, const receivers_seen& seen) {
  const bool trilinear = how.filter == texel_filter::trilinear;
  effect e{"mips", trilinear && blurs_its_map(how.method), seen.by_level > 0, ""};
  e.evidence = e.asked      ? count_of(seen.by_level, seen.all, "receivers read a level above 0")
               : !trilinear ? "the filter is not trilinear"
                            : std::string(name_of(how.method)) + " reads level 0 alone";
  return e;
}

effect anisotropy_effect(const configuration& how, const receivers_seen& seen) {
  effect e{"anisotropy", how.max_anisotropy > 1 && blurs_its_map(how.method), seen.by_probes > 0,
           ""};
  e.evidence = e.asked ? count_of(seen.by_probes, seen.all, "receivers read more than one probe")
                       : "one probe a lookup";
  return e;
}

/// The smallest positive number that any stage of a layer can store: texels, then each blur pass,
/// where a texel may stand alone under the smallest weight.
struct smallest_stored {
  double value = std::numeric_limits<double>::infinity();
  std::size_t texels = 0;  ///< first or second moments of texels that are subnormal themselves
};

smallest_stored smallest_of(const frame& scene, const configuration& how, const plan& p,
                            double smallest_normal) {
  const double weight = smallest_blur_share(how);
  smallest_stored result;
  const bool squares = how.channels() > 1;
  const auto intervals = layer_intervals(p.splits, how.overlap);
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    if (p.layer_users[i] == 0) continue;
    for (const image<float>* map : depth_maps(scene, how.filtered.msaa)) {
      for (const float depth : map->texels) {
        const double x = warp(clamp_depth(static_cast<double>(depth)), intervals[i]);
        if (x == 0) continue;
        const double stored = squares ? x * x : x;
        result.value = std::min(result.value, stored);
        result.texels += stored < smallest_normal ? 1 : 0;
      }
    }
  }
  if (squares) result.value /= how.filtered.msaa;
  // Two passes, 4x a mip level, and a margin of 2 for the rounding of each step.
  if (how.blurred() && squares) result.value *= weight * weight;
  if (how.filter == texel_filter::trilinear) {
    result.value /= static_cast<double>(scene.depth.width) * scene.depth.height;
  }
  result.value /= 2;
  return result;
}

/// The smallest magnitude that a technique of functions of depth stores: values between those of
/// depths 0 and 1 filter to such. 0 where terms pass through it.
std::optional<double> smallest_function_of(const configuration& how) {
  switch (how.method) {
    case technique::esm:
    case technique::evsm2:
      return 1;
    case technique::evsm4:
      return exp_of_double(-2 * how.negative_exponent) / 2;
    case technique::csm:
    case technique::msm:
    case technique::deep:
      return 0;
    case technique::lvsm:  // depths of both signs may cancel
      if (layered(how) && how.warping == layer_warp::unclamped) return 0;
      return std::nullopt;
    default:
      return std::nullopt;
  }
}

effect subnormals_effect(const frame& scene, const configuration& how, const plan& p) {
  effect e{"subnormals", false, false, ""};
  if (how.exact()) {
    e.evidence = "exact arithmetic has none";
    return e;
  }
  const auto storage = storage_named(how.format);
  if (!storage.code || storage.code->kind != family::binary) {
    e.evidence = storage.code ? how.format + " has none"
                              : how.format + " is native: the processor keeps them";
    return e;
  }
  e.asked = true;
  const int exponent = min_exponent(*storage.code);
  const double normal =
      exponent < -1000 ? 0x1p-1000
                       : std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
  const auto function = smallest_function_of(how);
  const auto smallest =
      function ? smallest_stored{*function, 0} : smallest_of(scene, how, p, normal);
  e.needed = smallest.value < normal;
  if (smallest.texels > 0) {
    const std::size_t maps = depth_maps(scene, how.filtered.msaa).size();
    e.evidence = count_of(
        smallest.texels, scene.depth.texels.size() * maps,
        (maps > 1 ? "samples store a subnormal " : "texels store a subnormal ") + how.format);
  } else if (e.needed) {
    e.evidence = "filtering may leave " + brief(smallest.value) + ", under the smallest normal " +
                 brief(normal);
  } else {
    e.evidence = "no stage stores less than " + brief(smallest.value) +
                 ", above the smallest normal " + brief(normal);
  }
  return e;
}

effect empty_layers_effect(const plan& p) {
  const auto empty = static_cast<std::size_t>(
      std::count(p.layer_users.begin(), p.layer_users.end(), std::size_t{0}));
  // Nobody reads what such a layer holds: it can never change a pixel.
  return {"layers without receivers", empty > 0, false,
          count_of(empty, p.layer_users.size(), "layers have no receiver")};
}

}  // namespace

plan make_plan(const frame& scene, const configuration& how, int threads) {
  const default_float_environment environment;
  try {
    how.validate();
  } catch (const std::invalid_argument& e) {
    throw usage_error(e.what());
  }
  if (how.filtered.msaa > 1 && !scene.samples.contains(how.filtered.msaa)) {
    throw usage_error("this depth map has one sample a texel: leave out msaa = " +
                      std::to_string(how.filtered.msaa));
  }
  plan result;
  auto found = splits_of(scene, how, threads);
  result.splits = std::move(found.splits);
  result.notes = std::move(found.notes);
  configuration plain = how;
  if (!layered(how)) {
    plain.transition = false;
    plain.lookup = layer_lookup::own;
  }
  result.effects = {{"transition", layered(how) && how.transition, true, ""}};
  const auto table = layers_of(scene, plain, result);
  for (const auto& users : table.users) result.layer_users.push_back(users.size());

  const auto seen = look_at(scene, how, result);
  result.effects = {overlap_effect(how, seen),
                    transition_effect(how, seen),
                    mips_effect(how, seen),
                    anisotropy_effect(how, seen),
                    subnormals_effect(scene, how, result),
                    empty_layers_effect(result)};
  for (effect& e : filter_effects(scene, how)) result.effects.push_back(std::move(e));
  return result;
}

}  // namespace bitshade
