// Maps of one depth's function (texel_maps.hpp) as Techniques of staged_base.hpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "bitshade/shadow/layers.hpp"
#include "bitshade/shadow/moments.hpp"
#include "bitshade/study/configuration.hpp"
#include "bitshade/texture/image.hpp"
#include "run/shading_arithmetic.hpp"
#include "run/storage.hpp"

namespace bitshade {

/// Source: Map of(how, storage), the Map of a configuration. Texels and light are made of the same
/// operations as texel_technique's.
template <class V, class Source>
class staged_texels {
 public:
  staged_texels(const configuration& how, const storage_format& storage)
      : map_(Source::of(how, storage)) {}

  int channels() const { return static_cast<int>(map_.channels()); }
  void begin(const interval&) {}
  template <class Keep>
  void fill(const image<float>& depth, int y, std::span<V> row, Keep) const {
    const auto from = depth.row(y);
    const std::size_t count = map_.channels();
    for (std::size_t x = 0; x < from.size(); ++x) {
      const auto texel = row.subspan(x * count, count);
      if (x > 0 && from[x] == from[x - 1]) {  // an enclosure of e^x takes its time
        const auto before = row.subspan((x - 1) * count, count);
        std::copy(before.begin(), before.end(), texel.begin());
      } else {
        map_.template texel<V>(clamp_depth(static_cast<V>(from[x])), texel);
      }
    }
  }
  V light(std::span<const V> values, const V& t) const { return map_.template light<V>(values, t); }
  shading_input shading(const std::vector<double>&, double) const { return {}; }

 private:
  decltype(Source::of(std::declval<const configuration&>(),
                      std::declval<const storage_format&>())) map_;
};

}  // namespace bitshade
