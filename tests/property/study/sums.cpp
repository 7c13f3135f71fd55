// Running sums stay within their bound, on maps that are made to drift.
#include "bitshade/study/bounds_sums.hpp"

#include <cmath>
#include <random>

#include "bitshade/study/precision_stages.hpp"
#include "run/storage.hpp"
#include "run/summed_area_tables.hpp"
#include "support/catch.hpp"

using namespace bitshade;

namespace {

/// The share of the bound that maps of one depth reach at least: every sum of a binade is rounded
/// to the same side.
constexpr double sums_reached = 0.4;

struct worst {
  double share = 0;
  int over = 0;
};

/// Means of stored running sums against true ones; texels are multiples of 2^-20, so that binary64
/// holds every sum.
template <class T>
void compare_boxes(const image<T>& texels, const storage_format& storage, int significand,
                   worst& found) {
  image<double> plain(texels.width, texels.height);
  std::copy(texels.texels.begin(), texels.texels.end(), plain.texels.begin());
  const auto exact = running_table(plain, [](std::span<double>) {});
  const auto sums = running_table(texels, [&](std::span<T> row) { round_row(storage, row); });
  image<double> kept(texels.width, texels.height);
  std::copy(sums.sums.texels.begin(), sums.sums.texels.end(), kept.texels.begin());
  const summed_area<double> stored{kept, {0}};
  for (const int width : {1, 3, 9, texels.width}) {
    for (const int height : {1, 5, texels.height}) {
      summed_rectangle r{texels.width, texels.height, width, height,
                         unit_roundoff(sizeof(T) == 4 ? 24 : 53), unit_roundoff(significand)};
      const double bound = summed_mean_error(r), corners = corner_error(r);
      for (int y = 0; y + height <= texels.height; y += 3) {
        for (int x = 0; x + width <= texels.width; x += 2) {
          const texel_box box{x, y, x + width, y + height};
          const double area = box.area();
          const double mean = sum_over(exact, box, 0) / area;
          const double off = std::fabs(sum_over(stored, box, 0) / area - mean);
          const double all = std::fabs(static_cast<double>(sum_over(sums, box, 0) /
                                                           static_cast<T>(box.area())) -
                                       mean);
          // The judge's own differences are binary64's.
          found.over += off > bound + 0x1p-30 || all > bound + corners + 0x1p-30;
          found.share = std::max(found.share, off / bound);
        }
      }
    }
  }
}

template <class T>
worst search(int significand, int width, int height) {
  const auto storage = storage_named("e8m" + std::to_string(significand - 1));
  std::mt19937 random(static_cast<unsigned>(significand * 1000 + width));
  worst found;
  for (const double depth : {1.0, 1.0 - 0x1p-12, 0x1.8p-1, 0x1.5555p-1, 0x1p-20, -1.0, -1.0}) {
    image<T> texels(width, height);
    for (T& x : texels.texels)
      x = static_cast<T>(depth < 0 ? static_cast<double>(random() >> 12) * 0x1p-20 : depth);
    compare_boxes(texels, storage, significand, found);
  }
  return found;
}

}  // namespace

TEST_CASE("means of running sums stay within their bound, and come near it") {
  double share = 0;
  for (const int significand : {12, 16, 20, 24}) {
    for (const auto& [width, height] : {std::pair{40, 30}, {16, 64}, {64, 8}}) {
      const worst found = search<float>(significand, width, height);
      CAPTURE(significand, width, height, found.share);
      CHECK(found.over == 0);
      share = std::max(share, found.share);
    }
  }
  CHECK(search<double>(32, 64, 64).over == 0);
  CAPTURE(share);
  CHECK(share >= sums_reached);
}

TEST_CASE("of sums that may grow without end nothing is known") {
  summed_rectangle r{1024, 1024, 9, 9, unit_roundoff(24), unit_roundoff(8)};
  CHECK(summed_mean_error(r) == std::numeric_limits<double>::infinity());
  CHECK(summed_error_at(r, 1e-4) == 1);
  r.store = unit_roundoff(40);
  r.arithmetic = unit_roundoff(53);
  CHECK(summed_mean_error(r) == Approx(2.0 / 9 * 0x1p20 * 0x1p-40).epsilon(0.01));
}
