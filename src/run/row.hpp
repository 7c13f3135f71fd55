// One finished cell of a study, as it is stored, listed and drawn.
#pragma once

#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

#include "bitshade/study/measures.hpp"
#include "bitshade/study/plan.hpp"

namespace bitshade {

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
  int bytes_per_texel = 0;
  std::size_t samples = 0;
  double map_seconds = 0;
  double shade_seconds = 0;
  double emulation_seconds = 0;
  int threads = 0;
  std::vector<double> splits;
  std::vector<effect> effects;
  std::vector<std::string> notes;

  double nanoseconds_per_sample() const {
    return samples == 0 ? 0 : shade_seconds * 1e9 / static_cast<double>(samples);
  }
};

/// What a column holds: the same bits on every run, or a time of this one.
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
  f("threads", column_kind::time, r.threads);
  f("map_seconds", column_kind::time, r.map_seconds);
  f("shade_seconds", column_kind::time, r.shade_seconds);
  f("emulation_seconds", column_kind::time, r.emulation_seconds);
}

}  // namespace bitshade
