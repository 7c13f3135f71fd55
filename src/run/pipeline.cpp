#include "run/pipeline.hpp"

#include <cmath>

#include "bitshade/formats/name.hpp"
#include "bitshade/shadow/bleeding.hpp"
#include "bitshade/shadow/layer_packing.hpp"
#include "io/error.hpp"
#include "io/text.hpp"
#include "run/engines.hpp"
#include "run/parallel.hpp"

namespace bitshade {

namespace {

/// Bytes of one texel over all layers and channels, in the format's own packing.
int bytes_of(const configuration& how, const plan& effects, int bits) {
  const auto layers =
      how.method == technique::lvsm ? static_cast<int>(effects.splits.size()) - 1 : 1;
  if (how.method == technique::savsm && parse_encoding(how.format)->kind != family::binary) {
    bits = bits <= 16 ? 32 : 64;  // sums of codes
  }
  if (how.method == technique::lvsm && how.one_pass) {
    return (bits * 4 * packed_textures(layers) + 7) / 8;
  }
  return (bits * how.channels() * layers + 7) / 8;
}

using run_function = void (*)(run_context&);

run_function function_of(const configuration& how) {
  switch (how.method) {
    case technique::hard:
    case technique::pcf:
      return how.exact() ? run_depth_exact : run_depth_native;
    case technique::deep:
      return how.exact() ? run_depth_exact : run_deep_native;
    case technique::vsm:
    case technique::lvsm:
      return how.exact() ? run_variance_exact : run_variance_native;
    case technique::savsm:
      return how.exact() ? run_summed_area_exact : run_summed_area_native;
    case technique::evsm2:
    case technique::evsm4:
      return how.exact() ? run_evsm_exact : run_exponential_native;
    case technique::esm:
      return how.exact() ? run_esm_exact : run_exponential_native;
    case technique::csm:
      return how.exact() ? run_csm_exact : run_csm_native;
    case technique::msm:
      return how.exact() ? run_msm_exact : run_msm_native;
    default:
      break;
  }
  throw usage_error("technique " + std::string(name_of(how.method)) +
                    " is not part of this build: use another");
}

/// The second form of less bleeding, in the run's own arithmetic; exact lights are rounded to
/// binary64 before it.
void reduce_by_power(const configuration& how, bool wide, cell& result) {
  const power_reduction form{how.bleeding_power, how.bleeding_lift};
  for (double& p : result.visibility) {
    if (p != p) continue;
    p = wide ? reduce_bleeding_by_power(p, form)
             : static_cast<double>(reduce_bleeding_by_power(static_cast<float>(p), form));
  }
  if (how.exact()) {
    result.notes.push_back("the power of the light is taken in binary64, within 2^-45 of itself");
  }
}

/// Comparisons by less than the store's rounding are decided by it.
void note_bias(const configuration& how, const encoding& format, cell& result) {
  const double half_step = format.kind == family::binary
                               ? std::ldexp(1.0, -format.fraction_bits - 2)  // in [1/2, 1)
                               : decode(format, 1) / 2;
  if (how.depth_bias >= half_step) return;
  const double digit = std::pow(10.0, std::floor(std::log10(half_step)) - 1);
  const double enough = std::ceil(half_step / digit) * digit;  // two digits: a bias to copy
  result.notes.push_back(how.format + " moves depths by up to " + brief(enough, 2) +
                         ", more than the depth bias of " + detail::shortest(how.depth_bias) +
                         ": lit surfaces may shade themselves");
}

}  // namespace

cell run_pipeline(const frame& scene, const configuration& how, const plan& effects, int threads,
                  storage_speed speed) {
  const default_float_environment environment;
  const auto run = function_of(how);
  cell result;
  storage_format storage;
  if (!how.exact()) {
    storage = storage_named(how.format);
    result.bytes_per_texel = bytes_of(how, effects, storage.bits);
    if (!effects.simulates("subnormals")) storage.rounding.subnormal = subnormals::flush_output;
  }
  const auto layers = layers_of(scene, how, effects);
  result.splits = layers.splits;
  result.layer = layers.own;
  result.effects = effects.effects;
  for (const int own : layers.own) result.samples += own >= 0 ? 1 : 0;
  run_context context{scene,   how,     effects,
                      layers,  storage, lookup_of(how, effects),
                      threads, result,  speed == storage_speed::natural};
  run(context);
  // Where the arithmetic's own type is the storage, there is nothing to emulate.
  result.natural |= context.natural && !how.exact() && !storage.code;
  if (how.powered() && !compares_depths(how.method))
    reduce_by_power(how, how.exact() || storage.wide, result);
  if (compares_depths(how.method) && storage.code) note_bias(how, *storage.code, result);
  result.notes.insert(result.notes.begin(), effects.notes.begin(), effects.notes.end());
  return result;
}

}  // namespace bitshade
