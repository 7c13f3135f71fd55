// What certificates know of a map in the format: its values, and a radius beside each.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "bitshade/shadow/layers.hpp"
#include "bitshade/shadow/moments.hpp"
#include "bitshade/texture/image.hpp"
#include "run/certify.hpp"
#include "run/lookup.hpp"
#include "run/parallel.hpp"
#include "run/storage.hpp"

namespace bitshade::certified {

/// Running sums of radii are binary64: a hair more covers their own rounding.
inline constexpr double up = 1 + 0x1p-40;

struct moment {
  double value = 0, radius = 0;
};

/// A level of the map as the format pipeline stored it, and what each value may be off by.
template <class T>
struct level {
  image<T> values;
  image<double> radii;
};

template <class T>
class texel_maker {
 public:
  texel_maker(const frame& scene, const storage_format& storage, int threads)
      : scene_(scene), storage_(storage), threads_(threads) {}

 protected:
  static constexpr double unit = sizeof(T) == sizeof(float) ? 0x1p-24 : 0x1p-53;

  /// The unfiltered moments of a layer.
  level<T> texels(const interval& layer) const {
    const image<float>& depth = scene_.depth;
    level<T> base{image<T>(depth.width, depth.height, 2),
                  image<double>(depth.width, depth.height, 2)};
    const bool whole = layer.near == 0 && layer.far == 1;
    stored_pass(base, [&](int y) {
      const auto row = base.values.row(y);
      const auto off = base.radii.row(y);
      warp_row<T>(depth.row(y), layer, row, 2);
      square_row<T>(row, 2);
      for (std::size_t i = 0; i < row.size(); i += 2) {
        const double x = static_cast<double>(row[i]);
        off[i] = whole ? 0 : 2.1 * unit * x;  // a difference and a quotient
        off[i + 1] = (2 * x * off[i] + off[i] * off[i] + 1.1 * unit * x * x) * up;
      }
    });
    return base;
  }

  /// What `roundings` of the arithmetic may have done to a row of sums of positive numbers.
  void widen(level<T>& to, int y, double roundings) const {
    const auto row = to.values.row(y);
    const auto off = to.radii.row(y);
    for (std::size_t i = 0; i < row.size(); ++i) {
      off[i] = (off[i] + roundings * unit * std::fabs(static_cast<double>(row[i]))) * up;
    }
  }

  /// Makes rows, stores them, and adds to each radius what its store really moved.
  template <class Row>
  void stored_pass(level<T>& to, Row make) const {
    for_rows(threads_, to.values.height, [&](int y) {
      make(y);
      const auto row = to.values.row(y);
      const std::vector<T> before(row.begin(), row.end());
      round_row(storage_, row);
      for (std::size_t i = 0; i < row.size(); ++i) {
        const double moved = static_cast<double>(row[i]) - static_cast<double>(before[i]);
        to.radii.row(y)[i] = (to.radii.row(y)[i] + std::fabs(moved)) * up;
      }
    });
  }

  const frame& scene_;
  const storage_format& storage_;
  const int threads_;
};

}  // namespace bitshade::certified
