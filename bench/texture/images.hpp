// What the benchmarks of images share: inputs, comparison, stored formats.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>

#include "bitshade/formats/name.hpp"
#include "bitshade/formats/random.hpp"
#include "bitshade/texture/bulk.hpp"
#include "support/table.hpp"

namespace bench {

using namespace bitshade;
using bulk::instruction_set;

template <class T>
using shared_image = std::shared_ptr<image<T>>;
template <class T>
shared_image<T> make_image(int w, int h, int channels) {
  return std::make_shared<image<T>>(w, h, channels);
}

/// Depths of a slope with noise, and their squares.
inline image<float> moments(int w, int h, int channels) {
  image<float> result(w, h, channels);
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const auto at = static_cast<std::uint64_t>(y * w + x);
      const double noise = static_cast<double>(random_bits(1, at) >> 40) * 0x1p-24;
      const auto depth = static_cast<float>(0.2 + 0.3 * x / w + 0.2 * y / h + 0.2 * noise);
      result.at(x, y, 0) = depth;
      if (channels > 1) result.at(x, y, 1) = depth * depth;
    }
  return result;
}

template <class T>
std::string difference(const T* got, const T* expected, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    if (std::memcmp(got + i, expected + i, sizeof(T)) == 0) continue;
    char text[120];
    std::snprintf(text, sizeof text, "value %zu is %a instead of %a", i,
                  static_cast<double>(got[i]), static_cast<double>(expected[i]));
    return text;
  }
  return {};
}
template <class T>
std::string difference(const image<T>& got, const image<T>& expected) {
  return difference(got.texels.data(), expected.texels.data(), expected.texels.size());
}

struct storage {
  std::string name;
  bulk::texel_code code;
};
inline const storage storages[] = {{"half", {binary16::value, {}}},
                                   {"unorm16", {unorm16::value, {}}}};

inline image<std::uint16_t> coded(const bulk::texel_code& code, const image<float>& in) {
  image<std::uint16_t> out(in.width, in.height, in.channels);
  bulk::encode(code.format, code.rule, in.texels, std::span(out.texels));
  return out;
}
inline image<float> decoded(const bulk::texel_code& code, const image<std::uint16_t>& in) {
  image<float> out(in.width, in.height, in.channels);
  bulk::decode(code.format, code.rule, in.texels, std::span(out.texels));
  return out;
}

void add_sampling(table& table);
void add_blurs(table& table, int channels);
void add_blur_ways(table& table);
void add_mips(table& table, int channels);
void add_tables(table& table, int channels);

}  // namespace bench
