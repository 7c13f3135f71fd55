// The techniques' staged runs, one translation unit each, so that no file instantiates them all.
#pragma once

#include "run/lookup.hpp"
#include "run/stages.hpp"
#include "run/storage.hpp"

namespace bitshade {

/// A staged run under way: what every technique's engine needs, and what it fills.
struct staged_run {
  const frame& scene;
  const configuration& how;
  const stage_choices& choices;
  const storage_format& storage;
  const layer_table& layers;
  lookup look;
  int fraction_bits = 0;  ///< of linear fetches, as the plan left them
  int threads = 0;
  cell& result;
};

void run_staged_variance(const staged_run& run);     ///< vsm, lvsm
void run_staged_summed_area(const staged_run& run);  ///< savsm
void run_staged_evsm(const staged_run& run);         ///< evsm2, evsm4
void run_staged_texels(const staged_run& run);       ///< esm, csm, msm

/// In binary32 or binary64, as the storage asks: f(float{}) or f(double{}).
template <class F>
void in_arithmetic_of(const storage_format& storage, F f) {
  storage.wide ? f(double{}) : f(float{});
}

}  // namespace bitshade
