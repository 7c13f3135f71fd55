#include "run/staged.hpp"

#include <algorithm>
#include <stdexcept>

#include "bitshade/shadow/evsm.hpp"
#include "bitshade/shadow/lloyd.hpp"
#include "bitshade/shadow/moments.hpp"
#include "io/error.hpp"
#include "run/slope.hpp"

namespace bitshade {

namespace {

/// vsm and lvsm over any number; the same operations as variance_technique's.
template <class V>
class staged_variance {
 public:
  explicit staged_variance(const configuration& how) : how_(how) {}

  int channels() const { return 2; }
  void begin(const interval& layer) {
    layer_ = layer;
    floor_ = layer_floor<V>(how_.min_variance, layer);
  }
  template <class Keep>
  void fill(const image<float>& depth, int y, std::span<V> row, Keep keep) const {
    warp_row<V>(depth.row(y), layer_, row, 2, how_.warping);
    if (how_.second == second_moment::centred) {
      centred_square_row<V>(row, 2);
    } else {
      if (how_.second == second_moment::square_of_stored) keep(row);
      square_row<V>(row, 2);
    }
    if (how_.slope_term) add_layer_slope<V>(depth, y, layer_, how_, row);
  }
  V light(std::span<const V> values, const V& t) const {
    const auto at = how_.second == second_moment::centred
                        ? mean_and_centred_variance(values[0], values[1])
                        : mean_and_variance(values[0], values[1]);
    return chebyshev(at, warp(t, layer_, how_.warping), floor_);
  }
  shading_input shading(const std::vector<double>& values, double t) const {
    return {values[0], values[1],         t,
            layer_,    how_.min_variance, how_.second == second_moment::centred};
  }

 private:
  const configuration& how_;
  interval layer_;
  V floor_{};
};

/// evsm2 and evsm4 over any number; the same operations as evsm_technique's.
template <class V>
class staged_evsm {
 public:
  explicit staged_evsm(const configuration& how)
      : how_(how), four_(how.method == technique::evsm4), constants_(constants_of(how)) {}

  int channels() const { return four_ ? 4 : 2; }
  void begin(const interval&) {}
  template <class Keep>
  void fill(const image<float>& depth, int y, std::span<V> row, Keep) const {
    const auto count = static_cast<std::size_t>(channels());
    positive_warp_row<V>(depth.row(y), constants_, row, count);
    if (four_) negative_warp_row<V>(depth.row(y), constants_, row, count);
    for (std::size_t i = 0; i < row.size(); i += 2) row[i + 1] = row[i] * row[i];
    if (how_.slope_term) add_evsm_slope<V>(depth, y, constants_, count, row);
  }
  V light(std::span<const V> m, const V& t) const {
    const V bound = evsm_positive_bound(m[0], m[1], t, constants_, how_.min_variance);
    if (!four_) return bound;
    return evsm_bound(bound, evsm_negative_bound(m[2], m[3], t, constants_, how_.min_variance));
  }
  shading_input shading(const std::vector<double>&, double) const { return {}; }

 private:
  static evsm_constants constants_of(const configuration& how) {
    const double negative = how.method == technique::evsm4 ? how.negative_exponent : how.exponent;
    try {
      return evsm_constants_for(how.exponent, negative, storage_named(how.format).format,
                                how.format);
    } catch (const std::invalid_argument& e) {
      throw usage_error(e.what());
    }
  }
  const configuration& how_;
  bool four_;
  evsm_constants constants_;
};

bool is_variance(technique t) { return t == technique::vsm || t == technique::lvsm; }
bool relaxed(const configuration& how) {
  return how.method == technique::lvsm && how.layers > 1 && how.splits == split_rule::lloyd;
}

void refuse_uncovered(const configuration& how, const stage_choices& choices) {
  if (how.exact()) throw usage_error("stages in a format need a format, not exact: unorm16, say");
  if (!is_variance(how.method) && how.method != technique::evsm2 &&
      how.method != technique::evsm4) {
    throw usage_error("stages of " + std::string(name_of(how.method)) +
                      " cannot be made exact one by one: use vsm, lvsm, evsm2 or evsm4");
  }
  if (how.lookup != layer_lookup::own || how.direct_index || how.noise_floor || how.powered()) {
    throw usage_error(
        "stages are compared for one layer a receiver under one floor: leave out --lookup, "
        "--direct-index, --noise-floor and --bleeding-power");
  }
  if (relaxed(how) && (how.lloyd != lloyd_choices{} || how.min_width != 0)) {
    throw usage_error(
        "stages are compared with Lloyd's splits at rest, in exact sums: leave out the options "
        "--lloyd-* and --min-width");
  }
  if (choices.shading && (!is_variance(how.method) || shading_in(*choices.shading) == nullptr)) {
    throw usage_error(std::string("shading can be done in ") + shading_arithmetics +
                      ", for vsm and lvsm");
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

template <class T, template <class> class Technique>
void run_in(const frame& scene, const configuration& how, const stage_choices& choices,
            const storage_format& storage, const lookup& look, const layer_table& layers,
            int fraction_bits, int threads, cell& result) {
  staged_engine<T, Technique> engine(scene, how, choices, storage, look, fraction_bits, threads);
  run_staged_layers(engine, scene, layers, threads, result);
}

}  // namespace

std::vector<stage> stages_of(const configuration& how) {
  std::vector<stage> all;
  if (relaxed(how)) all.push_back(stage::splits);
  all.push_back(stage::store);
  if (how.filtered.msaa > 1) all.push_back(stage::resolve);
  if (how.blurred()) all.push_back(stage::blur);
  if (how.filter == texel_filter::trilinear) all.push_back(stage::mips);
  if (how.filter == texel_filter::bilinear && how.max_anisotropy == 1)
    all.push_back(stage::weights);
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
  const lookup look = lookup_of(how, effects);
  const int fractions = effects.simulates("blur fractions") ? how.filtered.fraction_bits : 0;
  const auto run = [&]<class T>(T) {
    if (is_variance(how.method)) {
      run_in<T, staged_variance>(scene, how, choices, storage, look, layers, fractions, threads,
                                 result);
    } else {
      run_in<T, staged_evsm>(scene, how, choices, storage, look, layers, fractions, threads, result);
    }
  };
  storage.wide ? run(double{}) : run(float{});
  return result;
}

}  // namespace bitshade
