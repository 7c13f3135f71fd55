// A technique that is a function of one depth and of its filtered values, for the native engine.
#pragma once

#include <cstddef>
#include <span>

#include "bitshade/shadow/moments.hpp"
#include "run/engines.hpp"
#include "run/layered_run.hpp"
#include "run/native.hpp"
#include "run/natural.hpp"

namespace bitshade {

/// Makes a native_engine's technique of a Map, which has for T float, double or an enclosure:
///
///   size_t channels() const;
///   template <class T> void texel(const T& x, std::span<T> out) const;      depth -> channels
///   template <class T> T light(std::span<const T> filtered, const T& t) const;
template <class T, class Map>
class texel_technique {
 public:
  explicit texel_technique(const Map& map) : map_(map) {}

  int channels() const { return static_cast<int>(map_.channels()); }
  void begin(const interval&) {}
  void fill(const image<float>& depth, int y, std::span<T> row) const {
    const auto from = depth.row(y);
    const std::size_t count = map_.channels();
    for (std::size_t x = 0; x < from.size(); ++x) {
      map_.template texel<T>(clamp_depth(static_cast<T>(from[x])), row.subspan(x * count, count));
    }
  }
  T light(std::span<const T> values, const T& t) const { return map_.template light<T>(values, t); }

 private:
  Map map_;
};

/// Runs a map in binary32 or binary64, as its storage asks.
template <class Map>
void run_texel_map(run_context& run, const Map& map) {
  const auto in = [&]<class T>(T) {
    if constexpr (std::is_same_v<T, float>)
      if (runs_naturally(run)) return run_natural(run, texel_technique<T, Map>(map));
    native_engine<T, texel_technique<T, Map>> engine(run, texel_technique<T, Map>(map));
    run_layers(engine, run);
  };
  run.storage.wide ? in(double{}) : in(float{});
}

}  // namespace bitshade
