#include "run/pipeline.hpp"

#include "bitshade/formats/name.hpp"
#include "io/error.hpp"
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
  return (bits * how.channels() * layers + 7) / 8;
}

using run_function = void (*)(run_context&);

run_function function_of(const configuration& how) {
  switch (how.method) {
    case technique::hard:
    case technique::pcf:
      return how.exact() ? run_depth_exact : run_depth_native;
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

}  // namespace

cell run_pipeline(const frame& scene, const configuration& how, const plan& effects, int threads) {
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
  run_context context{scene,   how,   effects, layers, storage, lookup_of(how, effects),
                      threads, result};
  run(context);
  return result;
}

}  // namespace bitshade
