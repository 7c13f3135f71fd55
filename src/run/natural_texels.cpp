#include "run/natural_texels.hpp"

#include <algorithm>
#include <type_traits>
#include <vector>

#include "bitshade/arithmetic/bulk.hpp"
#include "bitshade/texture/blur.hpp"
#include "run/lookup.hpp"
#include "run/parallel.hpp"

namespace bitshade {

bool natural_texels::can_hold(const storage_format& storage) {
  if (storage.wide) return false;
  return !storage.code || storage.code->width == 8 || storage.code->width == 16 ||
         storage.code->width == 32;
}

natural_texels::natural_texels(const storage_format& storage, int width, int height, int channels)
    : storage_(storage), width_(width), height_(height), channels_(channels) {
  if (!storage.code)
    map_ = image<float>(width, height, channels);
  else if (storage.code->width == 8)
    map_ = image<std::uint8_t>(width, height, channels);
  else if (storage.code->width == 16)
    map_ = image<std::uint16_t>(width, height, channels);
  else
    map_ = image<std::uint32_t>(width, height, channels);
}

template <class Code>
void natural_texels::store_in(image<Code>& to, int y, std::span<const float> row) const {
  if constexpr (std::is_same_v<Code, float>)
    std::copy(row.begin(), row.end(), to.row(y).begin());
  else
    bulk::encode(*storage_.code, storage_.rounding, row, to.row(y));
}

template <class Code>
void natural_texels::load_row(const image<Code>& from, int y, std::span<float> row) const {
  if constexpr (std::is_same_v<Code, float>)
    std::copy(from.row(y).begin(), from.row(y).end(), row.begin());
  else
    bulk::decode(*storage_.code, storage_.rounding, from.row(y), row);
}

void natural_texels::store(int y, std::span<const float> row) {
  std::visit([&](auto& map) { store_in(map, y, row); }, map_);
}

void natural_texels::blur(const kernel& weights, int threads) {
  if (weights.weights.size() == 1) return;
  constexpr std::size_t band = 64;  // rows loaded at once: the halo of a wide kernel is a third
  const int radius = weights.radius();
  std::visit(
      [&]<class Code>(image<Code>& map) {
        image<Code> across(width_, height_, channels_);
        for_ranges(threads, static_cast<std::size_t>(height_), band, [&](auto first, auto last) {
          image<float> row(width_, 1, channels_), out(width_, 1, channels_);
          for (auto y = static_cast<int>(first); y < static_cast<int>(last); ++y) {
            load_row(map, y, row.row(0));
            blur_row_x<float>(row, weights, map_address, 0, out.row(0));
            store_in(across, y, out.row(0));
          }
        });
        for_ranges(threads, static_cast<std::size_t>(height_), band, [&](auto begin, auto end) {
          const int first = static_cast<int>(begin), last = static_cast<int>(end);
          image<float> rows(width_, last - first + 2 * radius, channels_),
              out(width_, 1, channels_);
          for (int y = 0; y < rows.height; ++y)
            load_row(across, wrap(first - radius + y, height_, map_address), rows.row(y));
          for (int y = first; y < last; ++y) {
            blur_row_y<float>(rows, weights, map_address, y - first + radius, out.row(0));
            store_in(map, y, out.row(0));
          }
        });
      },
      map_);
}

void natural_texels::load(std::span<const std::uint32_t> texels, std::span<float> values) const {
  const auto count = static_cast<std::size_t>(channels_);
  std::visit(
      [&]<class Code>(const image<Code>& map) {
        const auto gather = [&](Code* to) {
          for (const std::uint32_t texel : texels) {
            const Code* from = map.texels.data() + texel * count;
            for (std::size_t c = 0; c < count; ++c) *to++ = from[c];
          }
        };
        if constexpr (std::is_same_v<Code, float>) {
          gather(values.data());
        } else {
          thread_local std::vector<Code> codes;
          codes.resize(texels.size() * count);
          gather(codes.data());
          bulk::decode(*storage_.code, storage_.rounding, std::span<const Code>(codes), values);
        }
      },
      map_);
}

}  // namespace bitshade
