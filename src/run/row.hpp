// One finished cell of a study, as it is stored, listed and drawn.
#pragma once

#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

#include "bitshade/study/measures.hpp"
#include "bitshade/study/plan.hpp"

namespace bitshade {

/// A time over repeated runs: its median and quartiles.
struct spread {
  double median = 0, low = 0, high = 0;
};

/// Times at the natural speed of a storage: texels in memory as the format's own bits.
struct natural_times {
  int repeats = 0;       ///< 0: not measured
  bool natural = false;  ///< else there is no natural path, and emulation is left out of the times
  spread map, shade;     ///< seconds
  /// Multiples of the time that the reference, a single-layer VSM in binary32, takes for a frame:
  /// of the map, of shading, of both.
  spread relative_map, relative_shade, relative;
};

/// What a graphics processor would feel of a configuration.
struct device_cost {
  int passes = 0;
  double fetches_per_sample = 0;
  double bytes_per_frame = 0;
};

/// Everything that is known of a cell, apart from its pictures.
struct row {
  std::string key;    ///< digest of input, configuration and program: the identity of a cell
  std::string scene;  ///< what the user calls the input
  std::string input;  ///< digest of the frame's bits
  std::string technique;
  std::string format;
  int layers = 1;
  std::string configuration;  ///< configuration::key()
  std::string version;        ///< of the program, with its build
  measures figures;
  error_figures vsm_difference;  ///< from the picture of a single-layer VSM in binary32
  int bytes_per_texel = 0;
  std::size_t samples = 0;
  double map_seconds = 0;
  double shade_seconds = 0;
  double emulation_seconds = 0;
  int repeats = 1;  ///< of the emulated run; the times above are their medians
  spread map, shade, emulation;
  natural_times natural;
  device_cost device;
  int threads = 0;
  std::vector<double> splits;
  std::vector<effect> effects;
  std::vector<std::string> notes;

  double nanoseconds_per_sample() const {
    return samples == 0 ? 0 : shade_seconds * 1e9 / static_cast<double>(samples);
  }
};

/// What a column holds: the same bits on every run, or a time of this one and how it was taken.
enum class column_kind { text, integer, real, time };

/// Calls f(name, kind, value) for each column of a row, in the order of CSV, JSON and database.
/// Lists (splits, effects, notes) are not columns: JSON and the database hold them apart.
template <class Row, class F>
void each_column(Row& r, F f) {
  f("key", column_kind::text, r.key);
  f("scene", column_kind::text, r.scene);
  f("input", column_kind::text, r.input);
  f("technique", column_kind::text, r.technique);
  f("format", column_kind::text, r.format);
  f("layers", column_kind::integer, r.layers);
  f("configuration", column_kind::text, r.configuration);
  f("version", column_kind::text, r.version);
  auto& m = r.figures;
  const auto errors = [&](const std::string& name, auto& e) {
    f(name + "_rmse", column_kind::real, e.rmse);
    f(name + "_largest", column_kind::real, e.largest);
    f(name + "_p999", column_kind::real, e.p999);
    f(name + "_mean", column_kind::real, e.signed_mean);
    f(name + "_count", column_kind::integer, e.count);
  };
  errors("method_error", m.method);
  errors("method_pcf_error", m.method_pcf);
  errors("format_error", m.format);
  errors("total_error", m.total);
  errors("vsm_difference", r.vsm_difference);
  f("receivers", column_kind::integer, m.receivers);
  f("bleed_area", column_kind::real, m.bleed_area);
  f("bleed_integral", column_kind::real, m.bleed_integral);
  f("acne_area", column_kind::real, m.acne_area);
  f("violations", column_kind::integer, m.violations);
  f("largest_violation", column_kind::real, m.largest_violation);
  f("jump", column_kind::real, m.jump);
  f("banding", column_kind::real, m.banding);
  f("bytes_per_texel", column_kind::integer, r.bytes_per_texel);
  f("samples", column_kind::integer, r.samples);
  f("passes", column_kind::integer, r.device.passes);
  f("fetches_per_sample", column_kind::real, r.device.fetches_per_sample);
  f("bytes_per_frame", column_kind::real, r.device.bytes_per_frame);
  f("threads", column_kind::time, r.threads);
  f("repeats", column_kind::time, r.repeats);
  f("map_seconds", column_kind::time, r.map_seconds);
  f("shade_seconds", column_kind::time, r.shade_seconds);
  f("emulation_seconds", column_kind::time, r.emulation_seconds);
  const auto quartiles = [&](const std::string& name, auto& s) {
    f(name + "_low", column_kind::time, s.low);
    f(name + "_high", column_kind::time, s.high);
  };
  quartiles("map_seconds", r.map);
  quartiles("shade_seconds", r.shade);
  quartiles("emulation_seconds", r.emulation);
  auto& n = r.natural;
  f("natural_repeats", column_kind::time, n.repeats);
  f("natural_storage", column_kind::time, n.natural);
  f("natural_map_seconds", column_kind::time, n.map.median);
  quartiles("natural_map_seconds", n.map);
  f("natural_shade_seconds", column_kind::time, n.shade.median);
  quartiles("natural_shade_seconds", n.shade);
  f("natural_map_relative", column_kind::time, n.relative_map.median);
  quartiles("natural_map_relative", n.relative_map);
  f("natural_shade_relative", column_kind::time, n.relative_shade.median);
  quartiles("natural_shade_relative", n.relative_shade);
  f("natural_relative", column_kind::time, n.relative.median);
  quartiles("natural_relative", n.relative);
}

}  // namespace bitshade
