#include "run/staged_run.hpp"

#include <algorithm>

#include "bitshade/shadow/lloyd.hpp"
#include "bitshade/shadow/moments.hpp"
#include "io/error.hpp"
#include "run/engines.hpp"
#include "run/parallel.hpp"
#include "run/shading_arithmetic.hpp"

namespace bitshade {

namespace {

using run_function = void (*)(const staged_run&);

/// None where a technique has no stages that can be told apart.
run_function function_of(technique t) {
  switch (t) {
    case technique::vsm:
    case technique::lvsm:
      return run_staged_variance;
    case technique::savsm:
      return run_staged_summed_area;
    case technique::evsm2:
    case technique::evsm4:
      return run_staged_evsm;
    case technique::esm:
    case technique::csm:
    case technique::msm:
      return run_staged_texels;
    default:
      return nullptr;
  }
}

bool relaxed(const configuration& how) {
  return how.method == technique::lvsm && how.layers > 1 && how.splits == split_rule::lloyd;
}

void refuse_uncovered(const configuration& how, const stage_choices& choices) {
  if (how.exact()) throw usage_error("stages in a format need a format, not exact: unorm16, say");
  require_stages(how);
  if (how.lookup != layer_lookup::own || how.direct_index || how.noise_floor || how.powered()) {
    throw usage_error(
        "stages are compared for one layer a receiver under one floor: leave out --lookup, "
        "--direct-index, --noise-floor and --bleeding-power");
  }
  const double exponent = how.method == technique::evsm4
                              ? std::max(how.exponent, how.negative_exponent)
                              : how.exponent;
  if (warps_exponentially(how.method)) require_exact_exponent(exponent);
  if (relaxed(how) && (how.lloyd != lloyd_choices{} || how.min_width != 0)) {
    throw usage_error(
        "stages are compared with Lloyd's splits at rest, in exact sums: leave out the options "
        "--lloyd-* and --min-width");
  }
  if (choices.shading &&
      (!stores_variance(how.method) || shading_in(*choices.shading) == nullptr)) {
    throw usage_error(std::string("shading can be done in ") + shading_arithmetics +
                      ", for vsm, savsm and lvsm");
  }
}

/// Lloyd's splits from moments without a rounding that counts: binary64's.
std::vector<double> unrounded_splits(const frame& scene, int layers) {
  const image<float>& depth = scene.depth;
  std::vector<lloyd_sample> samples;
  for (int y = 0; y < std::max(1, depth.height - 1); ++y) {
    for (int x = 0; x < std::max(1, depth.width - 1); ++x) {
      double first = 0, second = 0;
      for (const int j : {y, std::min(y + 1, depth.height - 1)}) {
        for (const int i : {x, std::min(x + 1, depth.width - 1)}) {
          const double d = clamp_depth(static_cast<double>(depth.at(i, j)));
          first += d / 4, second += d * d / 4;
        }
      }
      samples.push_back(lloyd_sample_of(first, second));
    }
  }
  const lloyd_samples field(samples);
  const auto start = uniform_splits(layers);
  lloyd_relaxation relaxation({start.begin() + 1, start.end() - 1});
  relaxation.relax(field, 1000);
  const auto full = splits_from(relaxation.interior());
  return {full.begin() + 1, full.end() - 1};
}

}  // namespace

void require_stages(const configuration& how) {
  if (function_of(how.method) == nullptr) {
    throw usage_error("stages of " + std::string(name_of(how.method)) +
                      " cannot be made exact one by one, since it compares depths and filters "
                      "answers: use vsm, savsm, lvsm, evsm2, evsm4, esm, csm or msm");
  }
}

std::vector<stage> stages_of(const configuration& how) {
  std::vector<stage> all;
  const bool filtered = blurs_its_map(how.method);
  if (relaxed(how)) all.push_back(stage::splits);
  all.push_back(stage::store);
  if (how.filtered.msaa > 1) all.push_back(stage::resolve);
  if (filtered && how.blurred()) all.push_back(stage::blur);
  if (filtered && how.filter == texel_filter::trilinear) all.push_back(stage::mips);
  if (filtered && how.filter == texel_filter::bilinear && how.max_anisotropy == 1)
    all.push_back(stage::weights);
  if (how.method == technique::savsm && !how.exact() &&
      storage_named(how.format).format.kind == family::binary)
    all.push_back(stage::sums);
  all.push_back(stage::filter);
  all.push_back(stage::shading);
  return all;
}

cell run_staged(const frame& scene, const configuration& asked, const stage_choices& choices,
                int threads) {
  const default_float_environment environment;
  refuse_uncovered(asked, choices);
  configuration how = asked;
  if (relaxed(how) && !choices.in_format.has(stage::splits)) {
    how.manual_splits = unrounded_splits(scene, how.layers);
    how.layers = static_cast<int>(how.manual_splits.size()) + 1;
    how.splits = split_rule::manual;
  }
  const plan effects = make_plan(scene, how, threads);
  const layer_table layers = layers_of(scene, how, effects);
  storage_format storage = storage_named(how.format);
  if (!effects.simulates("subnormals")) storage.rounding.subnormal = subnormals::flush_output;
  cell result;
  result.splits = layers.splits;
  result.layer = layers.own;
  const staged_run run{scene,
                       how,
                       choices,
                       storage,
                       layers,
                       lookup_of(how, effects),
                       effects.simulates("blur fractions") ? how.filtered.fraction_bits : 0,
                       threads,
                       result};
  function_of(how.method)(run);
  return result;
}

}  // namespace bitshade
