// Gaussian blurs.
#include <cmath>

#include "bitshade/texture/blur.hpp"
#include "bitshade/texture/blur_variants.hpp"
#include "texture/passes.hpp"

namespace bench {
namespace {

image<float> blurred(const image<float>& in, const kernel& w,
                     const std::function<void(std::span<float>)>& store) {
  image<float> across(in.width, in.height, in.channels), out = across;
  for (int y = 0; y < in.height; ++y) {
    blur_row_x<float>(in, w, address::clamp, y, across.row(y));
    store(across.row(y));
  }
  for (int y = 0; y < in.height; ++y) blur_row_y<float>(across, w, address::clamp, y, out.row(y));
  return out;
}

}  // namespace

/// Both passes at once: an element is a value of one pass.
void add_blurs(table& table, int channels) {
  const std::string group = "9 x 9 blur, a pass of 2048^2 x " + std::to_string(channels);
  add_copies(table, group, channels);
  const kernel w = gaussian_kernel(9, 2.0);
  const auto in = std::make_shared<image<float>>(moments(size, size, channels));
  const auto out = make_image<float>(size, size, channels);
  const double elements = 2.0 * static_cast<double>(in->texels.size());
  for (const auto set : {instruction_set::avx512, instruction_set::avx2}) {
    if (!bulk::has(set)) continue;
    const std::string name = set == instruction_set::avx512 ? ", AVX-512" : ", AVX2";
    const auto work = [=](int threads) {
      on_threads(threads, size, [&](int first, int last) {
        bulk::blur(*in, w, address::clamp, {first, last}, *out, set);
      });
    };
    add_pass(
        table, group, "binary32" + name, elements, work,
        [=] {
          work(2);
          return difference(*out, blurred(*in, w, [](std::span<float>) {}));
        },
        32, native_limit);
    for (const storage& s : storages) {
      const auto codes = std::make_shared<image<std::uint16_t>>(coded(s.code, *in));
      const auto result = make_image<std::uint16_t>(size, size, channels);
      const auto pass = [=](int threads) {
        on_threads(threads, size, [&](int first, int last) {
          bulk::blur(s.code, *codes, w, address::clamp, {first, last}, *result, set);
        });
      };
      add_pass(
          table, group, s.name + name, elements, pass,
          [=] {
            pass(2);
            const auto store = [&](std::span<float> row) {
              bulk::round(s.code.format, s.code.rule, row, row);
            };
            return difference(*result, coded(s.code, blurred(decoded(s.code, *codes), w, store)));
          },
          16, stored_limit);
    }
  }
}

/// The templates of all three ways: their fetches' price, each against the separable blur.
void add_blur_ways(table& table) {
  const std::string group = "9 x 9 blur by the templates, 512^2 x 2";
  const kernel w = gaussian_kernel(9, 2.0);
  const auto in = std::make_shared<image<float>>(moments(512, 512, 2));
  const auto across = make_image<float>(512, 512, 2), out = make_image<float>(512, 512, 2);
  const auto rows = [](auto row) {
    for (int y = 0; y < 512; ++y) row(y);
  };
  const auto separable = [=] {
    rows([&](int y) { blur_row_x<float>(*in, w, address::clamp, y, across->row(y)); });
    rows([&](int y) { blur_row_y<float>(*across, w, address::clamp, y, out->row(y)); });
  };
  const auto square = [=] {
    rows([&](int y) { blur_row_square<float>(*in, w, address::clamp, y, out->row(y)); });
  };
  const auto taps = linear_taps(w, 0);
  const auto linear = [=] {
    rows([&](int y) { blur_row_linear<float>(*in, taps, address::clamp, y, across->row(y)); });
    rows([&](int y) { blur_column_linear<float>(*across, taps, address::clamp, y, out->row(y)); });
  };
  // All three are one sum in other orders: 81 products of numbers below 1, each step within an ulp.
  const auto check = [=](const std::function<void()>& work) {
    separable();
    const image<float> expected = *out;
    work();
    for (std::size_t i = 0; i < expected.texels.size(); ++i)
      if (!(std::fabs(out->texels[i] - expected.texels[i]) <= 2 * 81 * 0x1p-24f))
        return "value " + std::to_string(i);
    return std::string();
  };
  const std::size_t n = in->texels.size();
  table.add({group, "separable", n, separable, [=] { return check(separable); }, "", 0, {}});
  table.add({group, "one pass", n, square, [=] { return check(square); }, "separable", 0, {}});
  table.add(
      {group, "linear fetches", n, linear, [=] { return check(linear); }, "separable", 0, {}});
}

}  // namespace bench
