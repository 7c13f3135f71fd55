// The kernels of texture/ and shadow/ joined into one run of a technique over a frame.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bitshade/study/configuration.hpp"
#include "bitshade/study/frame.hpp"
#include "bitshade/study/plan.hpp"

namespace bitshade {

/// What one configuration does to one frame.
///
/// Times are wall-clock seconds on the threads of the run. map_seconds and shade_seconds are the
/// technique's own work in native arithmetic; emulation_seconds is what rounding to the format
/// cost on top, which a device with that format would not pay.
struct cell {
  std::vector<double> visibility;  ///< one a receiver, in [0,1]; NaN where there is no receiver
  std::vector<int> layer;          ///< the layer that each receiver looked up; -1 where none
  std::vector<double> splits;      ///< s_0 .. s_N in use, 0 and 1 included
  std::vector<effect> effects;     ///< the plan's effects, as this run took them
  double map_seconds = 0;
  double shade_seconds = 0;
  double emulation_seconds = 0;
  bool natural = false;            ///< texels lay in memory as their format's bits
  int bytes_per_texel = 0;         ///< of the map: all layers, all channels; 0 for exact
  std::size_t samples = 0;         ///< receivers shaded
  std::vector<std::string> notes;  ///< floors below the format's noise, capped exponents, ...
};

/// Splits, layers in use and the effects that the frame needs, with evidence.
/// Throws usage_error where the configuration contradicts itself.
plan make_plan(const frame& scene, const configuration& how, int threads = 0);

/// How a format that the processor does not compute in is stored: its values in binary32, rounded
/// between the stages, or its own bits, encoded and decoded as a device does it.
enum class storage_speed { emulated, natural };

/// Runs one technique in one format; the same bits for any number of threads (0: all cores), and
/// at either speed. Where there is no natural path, natural is emulated, and the cell says so.
cell run_pipeline(const frame& scene, const configuration& how, const plan& effects,
                  int threads = 0, storage_speed speed = storage_speed::emulated);

/// Percentage-closer filtering of the frame's own depth map with the configuration's kernel and
/// footprint, in exact arithmetic: the share of the footprint with x >= t, rounded once. It has no
/// bias, whatever the configuration says.
std::vector<double> truth_pcf(const frame& scene, const configuration& how, int threads = 0);

/// The share of the same footprint that does not occlude the receiver's tangent plane.
std::vector<double> truth_geometric(const frame& scene, const configuration& how, int threads = 0);

}  // namespace bitshade
