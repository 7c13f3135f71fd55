// Summed-area tables with radii: what every rounding of the sums really did. docs/theory.md section 5.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "bitshade/study/bounds_sums.hpp"
#include "run/certify_texels.hpp"
#include "run/summed_area_tables.hpp"

namespace bitshade::certified {

template <class T>
class summed_map : public texel_maker<T> {
  using parts = texel_maker<T>;
  using parts::scene_, parts::storage_, parts::threads_, parts::unit;

 public:
  summed_map(const frame& scene, const configuration& how, const storage_format& storage,
             const lookup&, int threads)
      : parts(scene, storage, threads), how_(how) {}

  /// What the texels' arithmetic and the roundings of sums may add to a rectangle's moment.
  double arithmetic(const receiver& r) const {
    const double texel = 10.1 * unit;
    if (!floating()) return (texel + 0x1p-46) * up;
    const auto box = box_of(r);
    const double ends = 1.0 / static_cast<double>(std::uint64_t{2} << storage_.format.fraction_bits);
    return (texel + summed_mean_error({scene_.depth.width, scene_.depth.height, box.x1 - box.x0,
                                       box.y1 - box.y0, unit, ends})) *
           up;
  }

  void generate(const interval& layer) {
    level<T> texels = this->texels(layer);
    if (floating()) {
      sum_floats(std::move(texels.values), texels.radii);
    } else {
      sum_codes(texels.values, texels.radii);
    }
    inner_ = running_table(std::move(texels.radii), [](std::span<double>) {});
  }

  /// The mean over a receiver's rectangle; corners and sums of radii are binary64's.
  moment filtered(const receiver& r, int c) const {
    const texel_box box = box_of(r);
    const double area = box.area();
    double inside = sum_over(inner_, box, c) + 0x1p-36 * at(inner_.sums, box.x1, box.y1, c);
    if (!floating()) {
      const double sum = static_cast<double>(sum_over(codes_, box, c));
      return {sum * decode(storage_.format, 1) / area, inside / area * up + 0x1p-46};
    }
    for (const int x : {box.x1, box.x0}) {  // the columns beside the rectangle
      const double bottom = at(edges_, x, box.y1, c);
      inside += bottom - at(edges_, x, box.y0, c) + 0x1p-36 * bottom;
    }
    const auto corner = [&](int x, int y) { return at(sums_.sums, x, y, c); };
    const double below = corner(box.x1, box.y1) - corner(box.x0, box.y1);
    const double above = corner(box.x1, box.y0) - corner(box.x0, box.y0);
    inside += 0x1p-50 * (corner(box.x1, box.y1) + corner(box.x0, box.y1) + corner(box.x1, box.y0));
    return {(below - above) / area, inside / area * up + 0x1p-46};
  }

 private:
  bool floating() const { return storage_.format.kind == family::binary; }
  texel_box box_of(const receiver& r) const {
    return bitshade::box_of(r, scene_.depth.width, scene_.depth.height, how_.smallest_box);
  }
  /// What is summed over the texels before column x and row y.
  template <class V>
  static double at(const image<V>& sums, int x, int y, int c) {
    return x == 0 || y == 0 ? 0 : static_cast<double>(sums.at(x - 1, y - 1, c));
  }

  /// Codes whose sums lose nothing; `radii` grow by how far each lies from its texel's value.
  void sum_codes(const image<T>& values, image<double>& radii) {
    image<std::uint64_t> codes(values.width, values.height, 2);
    const double one = decode(storage_.format, 1);
    for_rows(threads_, values.height, [&](int y) {
      encode_row<T, std::uint64_t>(storage_, values.row(y), codes.row(y));
      for (std::size_t i = 0; i < codes.row(y).size(); ++i) {
        const double code = static_cast<double>(codes.row(y)[i]) * one;
        const double moved = code - static_cast<double>(values.row(y)[i]);
        radii.row(y)[i] = (radii.row(y)[i] + std::fabs(moved) + 0x1p-51) * up;
      }
    });
    codes_ = running_table(std::move(codes), [](std::span<std::uint64_t>) {});
  }

  /// The format's own sums. A rounding of a row's prefix counts to the texel it stands at (`radii`);
  /// the store of a row's sums and whatever happens along a column count to that column (edges_).
  void sum_floats(image<T> values, image<double>& radii) {
    const int height = values.height;
    edges_ = image<double>(values.width, height, 2);
    int calls = 0;
    sums_ = running_table(std::move(values), [&](std::span<T> row) {
      const std::vector<T> before(row.begin(), row.end());
      round_row(storage_, row);
      // Rows first, each once; then what is added along the columns, from the second row on.
      const bool along_row = calls < height;
      const int y = along_row ? calls : calls - height + 1;
      ++calls;
      for (std::size_t i = 0; i < row.size(); ++i) {
        const double sum = std::fabs(static_cast<double>(before[i]));
        const double moved = std::fabs(static_cast<double>(row[i]) - static_cast<double>(before[i]));
        double& edge = edges_.row(y)[i];
        edge = (edge + moved) * up;
        if (along_row) {
          radii.row(y)[i] = (radii.row(y)[i] + unit * sum) * up;
        } else {
          edge = (edge + unit * sum) * up;
        }
      }
    });
    for (int y = 1; y < height; ++y)
      for (std::size_t i = 0; i < edges_.row(y).size(); ++i)
        edges_.row(y)[i] += edges_.row(y - 1)[i];
  }

  const configuration& how_;
  summed_area<std::uint64_t> codes_;
  summed_area<T> sums_;
  summed_area<double> inner_;
  image<double> edges_;
};

}  // namespace bitshade::certified
