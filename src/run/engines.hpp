// The techniques' runs, one translation unit each, so that no file instantiates them all.
#pragma once

#include "run/lookup.hpp"
#include "run/pipeline.hpp"
#include "run/storage.hpp"

namespace bitshade {

/// A run under way: what every technique's function needs, and what it fills.
struct run_context {
  const frame& scene;
  const configuration& how;
  const plan& effects;
  const layer_table& layers;
  const storage_format& storage;  ///< nothing to be read where `how` is exact
  lookup look;
  int threads = 0;
  cell& result;
  bool natural = false;  ///< texels stored as their format's bits, where there is a path for it
};

void run_variance_native(run_context& run);  ///< vsm, lvsm in binary32 or binary64
void run_variance_exact(run_context& run);   ///< vsm, lvsm in integers of proven width
void run_depth_native(run_context& run);     ///< hard, pcf in binary32 or binary64
void run_depth_exact(run_context& run);      ///< hard, pcf, deep without rounding
void run_deep_native(run_context& run);

void run_exponential_native(run_context& run);  ///< evsm2, evsm4, esm
void run_evsm_exact(run_context& run);          ///< evsm2, evsm4 in certified enclosures
void run_esm_exact(run_context& run);
void run_csm_native(run_context& run);
void run_csm_exact(run_context& run);
void run_msm_native(run_context& run);
void run_msm_exact(run_context& run);

void run_summed_area_native(run_context& run);  ///< savsm
void run_summed_area_exact(run_context& run);   ///< savsm in integers of proven width

/// Exact exponentials are certified up to here: e^(2c) and e^(-2c) stay within 2^+-1000.
inline constexpr double exact_exponent_cap = 300;
/// Throws usage_error for a larger one.
void require_exact_exponent(double exponent);

/// truth_pcf(), but for the configuration's depth bias: x >= t - bias.
std::vector<double> pcf_exact(const frame& scene, const configuration& how, int threads);
/// The hard test of the map as it is: 1 where x >= t - bias at the nearest texel.
std::vector<double> hard_exact(const frame& scene, double bias, int threads);

}  // namespace bitshade
