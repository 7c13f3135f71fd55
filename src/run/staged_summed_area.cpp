// The staged engine of summed-area variance shadow maps: sums and corners take the place of filters.
#include <cstdint>
#include <utility>
#include <vector>

#include "run/staged_base.hpp"
#include "run/staged_layers.hpp"
#include "run/staged_run.hpp"
#include "run/staged_variance.hpp"
#include "run/summed_area_tables.hpp"

namespace bitshade {

namespace {

/// An integer of 64 bits; a double would round it.
staged_exact whole(std::uint64_t n) {
  return staged_exact(static_cast<double>(n >> 32)) * staged_exact(0x1p32) +
         staged_exact(static_cast<double>(n & 0xffffffff));
}

/// What one code is worth: of a norm 1/max, which binary64 would round.
staged_exact exact_unit(const encoding& e) {
  const bool norm = e.kind == family::unorm || e.kind == family::snorm;
  return norm ? staged_exact(1) / whole(max_bits(e)) : staged_exact(decode(e, 1));
}

/// One table is made: of codes, where the texels are codes that sums lose nothing of; else of the
/// arithmetic's sums or of exact ones.
template <class T>
class staged_summed_area : public staged_base<T, staged_variance> {
  using parts = staged_base<T, staged_variance>;
  using parts::has, parts::how_, parts::scene_, parts::storage_, parts::threads_;

 public:
  explicit staged_summed_area(const staged_run& run)
      : parts(run),
        floating_(run.storage.format.kind == family::binary),
        unit_(exact_unit(run.storage.format)) {
    if (floating_)
      require_sums_fit(scene_.depth.width, scene_.depth.height, storage_, how_.format);
  }

  void generate(const interval& layer) {
    this->begin(layer);
    staged_image<T> texels = this->resolved();
    if (!floating_ && texels.in_format) {
      table_ = kind::codes;
      sum_codes(texels.native);
    } else if (floating_ && has(stage::sums)) {
      table_ = kind::native;
      texels.as_native();
      native_ = running_table(std::move(texels.native),
                              [&](std::span<T> row) { round_row(storage_, row); });
    } else {
      table_ = kind::exact;
      texels.as_exact();
      exact_ = running_table(std::move(texels.exact), [](std::span<staged_exact>) {});
    }
  }

  std::vector<staged_exact> lights(const receiver& r) const {
    const auto box = box_of(r, scene_.depth.width, scene_.depth.height, how_.smallest_box);
    std::vector<T> native;
    std::vector<staged_exact> exact;
    for (int c = 0; c < this->channels(); ++c) {
      if (has(stage::filter)) {
        native.push_back(native_mean(box, c));
      } else {
        exact.push_back(exact_mean(box, c));
      }
    }
    return {this->light_of(std::move(native), std::move(exact), r)};
  }

 private:
  enum class kind { codes, native, exact };

  void sum_codes(const image<T>& texels) {
    image<std::uint64_t> codes(texels.width, texels.height, texels.channels);
    for_rows(threads_, texels.height, [&](int y) {
      encode_row<T, std::uint64_t>(storage_, texels.row(y), codes.row(y));
    });
    codes_ = running_table(std::move(codes), [](std::span<std::uint64_t>) {});
  }

  T native_mean(const texel_box& box, int c) const {
    const auto area = static_cast<T>(box.area());
    switch (table_) {
      case kind::codes:
        return static_cast<T>(static_cast<double>(sum_over(codes_, box, c)) *
                              decode(storage_.format, 1) / box.area());
      case kind::native:
        return sum_over(native_, box, c) / area;
      case kind::exact:
        if (!floating_) return static_cast<T>(sum_over(exact_, box, c).nearest() / box.area());
        break;
    }
    // The corners stay as they are: what their store would lose is the sums' doing.
    const auto at = [&](int x, int y) {
      return x < 0 || y < 0 ? staged_exact() : exact_.sums.at(x, y, c);
    };
    const T below = staged_value<T>(at(box.x1 - 1, box.y1 - 1) - at(box.x0 - 1, box.y1 - 1));
    const T above = staged_value<T>(at(box.x1 - 1, box.y0 - 1) - at(box.x0 - 1, box.y0 - 1));
    return (below - above) / area;
  }

  staged_exact exact_mean(const texel_box& box, int c) const {
    const staged_exact area(box.area());
    switch (table_) {
      case kind::codes:
        return whole(sum_over(codes_, box, c)) * unit_ / area;
      case kind::exact:
        return sum_over(exact_, box, c) / area;
      case kind::native:
        break;
    }
    const auto at = [&](int x, int y) {
      return x < 0 || y < 0 ? staged_exact() : staged_value<staged_exact>(native_.sums.at(x, y, c));
    };
    return ((at(box.x1 - 1, box.y1 - 1) - at(box.x0 - 1, box.y1 - 1)) -
            (at(box.x1 - 1, box.y0 - 1) - at(box.x0 - 1, box.y0 - 1))) /
           area;
  }

  const bool floating_;
  const staged_exact unit_;  ///< of codes
  kind table_ = kind::exact;
  summed_area<std::uint64_t> codes_;
  summed_area<T> native_;
  summed_area<staged_exact> exact_;
};

}  // namespace

void run_staged_summed_area(const staged_run& run) {
  in_arithmetic_of(run.storage, [&]<class T>(T) {
    run_staged_layers<staged_summed_area<T>>(run);
  });
}

}  // namespace bitshade
