// Summed-area tables, resolves, blur variants and area integration against plain sums.
#include <cmath>
#include <cstdint>
#include <random>

#include "bitshade/interop/rational.hpp"
#include "bitshade/texture/area.hpp"
#include "bitshade/texture/blur_variants.hpp"
#include "bitshade/texture/resolve.hpp"
#include "bitshade/texture/sat.hpp"
#include "support/catch.hpp"

using namespace bitshade;

namespace {

constexpr auto keep = [](auto) {};

template <class T>
image<T> noise(int w, int h, int channels, std::uint32_t seed) {
  std::mt19937 random(seed);
  image<T> result(w, h, channels);
  for (T& t : result.texels) t = static_cast<T>(static_cast<float>(random() >> 8) * 0x1p-24f);
  return result;
}

}  // namespace

TEST_CASE("every order of summation equals direct sums where nothing is rounded") {
  // 16-bit codes in binary64: all sums are exact, so that the order cannot matter.
  std::mt19937 random(2);
  for (const auto& [w, h] : {std::pair{1, 1}, std::pair{1, 9}, std::pair{7, 5}, std::pair{16, 8}}) {
    image<double> in(w, h, 2);
    for (double& t : in.texels) t = static_cast<double>(random() & 0xffff);
    for (const sat_order order :
         {sat_order::running, sat_order::doubling, sat_order::pairwise, sat_order::kahan}) {
      const auto sat = make_sat(in, order, sat_offset::none, keep);
      for (int i = 0; i < 30; ++i) {
        const int x0 = static_cast<int>(random() % static_cast<unsigned>(w)),
                  y0 = static_cast<int>(random() % static_cast<unsigned>(h));
        const int x1 = x0 + static_cast<int>(random() % static_cast<unsigned>(w - x0)),
                  y1 = y0 + static_cast<int>(random() % static_cast<unsigned>(h - y0));
        double direct = 0;
        for (int y = y0; y <= y1; ++y)
          for (int x = x0; x <= x1; ++x) direct += in.at(x, y, 1);
        CAPTURE(w, h, static_cast<int>(order), x0, y0, x1, y1);
        REQUIRE(box_sum(sat, x0, y0, x1, y1, 1) == direct);
      }
    }
  }
}

TEST_CASE("offsets come back, and fractional rectangles are exact integrals") {
  image<exact_rational> in(5, 4, 1);
  for (std::size_t i = 0; i < in.texels.size(); ++i)
    in.texels[i] = exact_rational(static_cast<int>(i * i % 17)) / exact_rational(17);
  for (const sat_offset offset : {sat_offset::none, sat_offset::half, sat_offset::mean}) {
    const auto sat = make_sat(in, sat_order::running, offset, keep);
    const exact_rational mean = box_mean(sat, 1, 1, 3, 2, 0);
    exact_rational direct(0);
    for (int y = 1; y <= 2; ++y)
      for (int x = 1; x <= 3; ++x) direct += in.at(x, y);
    CHECK(mean == direct / exact_rational(6));
    // A rectangle with corners at eighths weighs each texel by its overlap.
    const exact_rational u0(0.375), v0(0.5), u1(4.125), v1(3.75);
    const exact_rational got = rectangle_mean(sat, u0, v0, u1, v1, 0);
    exact_rational sum(0);
    const auto overlap = [](const exact_rational& a, const exact_rational& b, int i) {
      const exact_rational lo = exact_rational(i) < a ? a : exact_rational(i);
      const exact_rational hi = b < exact_rational(i + 1) ? b : exact_rational(i + 1);
      return lo < hi ? hi - lo : exact_rational(0);
    };
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 5; ++x) sum += overlap(u0, u1, x) * overlap(v0, v1, y) * in.at(x, y);
    CHECK(got == sum / ((u1 - u0) * (v1 - v0)));
    CHECK(rectangle_mean(sat, exact_rational(0), exact_rational(0), exact_rational(5),
                         exact_rational(4), 0) == box_mean(sat, 0, 0, 4, 3, 0));
  }
}

TEST_CASE("binary32 tables err as their order says: pairwise and Kahan least, offsets help") {
  const image<float> in = noise<float>(256, 256, 1, 5);
  image<double> wide(256, 256, 1);
  for (std::size_t i = 0; i < in.texels.size(); ++i) wide.texels[i] = in.texels[i];
  const auto truth = make_sat(wide, sat_order::running, sat_offset::none, keep);
  const auto worst = [&](const auto& sat) {
    double largest = 0;
    for (int y = 240; y < 248; ++y)
      for (int x = 0; x < 248; ++x)
        largest =
            std::max(largest, std::fabs(static_cast<double>(box_mean(sat, x, y, x + 7, y + 7, 0)) -
                                        box_mean(truth, x, y, x + 7, y + 7, 0)));
    return largest;
  };
  const double running = worst(make_sat(in, sat_order::running, sat_offset::none, keep));
  const double kahan = worst(make_sat(in, sat_order::kahan, sat_offset::none, keep));
  const double half = worst(make_sat(in, sat_order::running, sat_offset::half, keep));
  const double split = worst(make_split_sat(in, sat_order::running, 256));
  // The largest sum is under 2^16, so that an ulp is 2^-8 at most; four corners, 64 texels, each
  // direction adds its rounding at every step it makes: 2 * 256 half ulps bound a corner.
  CHECK(running <= 4 * 2 * 256 * 0x1p-9 / 64);
  CAPTURE(running, kahan, half, split);
  CHECK(half < running);
  CHECK(split < running);
  CHECK(kahan <= running);
}

TEST_CASE("modular tables wrap and stay exact; what does not fit is refused") {
  std::mt19937 random(9);
  image<std::uint64_t> codes(300, 200, 1);
  for (auto& t : codes.texels) t = 0xffffff - (random() & 0xff);  // sums pass 2^32 many times over
  const auto sat = make_modular_sat<std::uint32_t>(codes, 24);
  const auto wide = make_modular_sat<std::uint64_t>(codes, 24);
  CHECK(modular_box_texels<std::uint32_t>(24) == 256);
  bool wrapped = false;
  for (int y = 0; y + 15 < 200; y += 7)
    for (int x = 0; x + 15 < 300; x += 5) {
      std::uint64_t direct = 0;
      for (int j = 0; j < 16; ++j)
        for (int i = 0; i < 16; ++i) direct += codes.at(x + i, y + j);
      REQUIRE(box_sum(sat, x, y, x + 15, y + 15, 0) == direct);
      REQUIRE(box_sum(wide, x, y, x + 15, y + 15, 0) == direct);
      wrapped = wrapped || wide.sums.at(x + 15, y + 15) > 0xffffffff;
    }
  CHECK(wrapped);
  CHECK_THROWS(make_modular_sat<std::uint32_t>(codes, 16));
  CHECK_THROWS(make_modular_sat<std::uint32_t>(codes, 33));
  CHECK_THROWS(make_modular_sat<std::uint32_t>(codes, -1));
  CHECK(modular_box_texels<std::uint32_t>(32) == 1);
  CHECK(modular_box_texels<std::uint32_t>(33) == 0);
  CHECK(modular_box_texels<std::uint64_t>(64) == 1);
  CHECK(modular_box_texels<std::uint64_t>(0) == ~std::uint64_t{0});
  CHECK_THROWS(require_sat_fits(4096, 4096, 1, 65504));
  CHECK_NOTHROW(require_sat_fits(128, 128, 1, 65504));
}

TEST_CASE("resolves are means; patterns are the standard ones and centred in Latin squares") {
  for (const int n : {1, 2, 4, 8}) {
    const auto pattern = sample_pattern(n);
    REQUIRE(static_cast<int>(pattern.size()) == n);
    std::vector<image<double>> samples;
    for (int s = 0; s < n; ++s) samples.push_back(image<double>(3, 2, 2, s + 1.0));
    std::vector<double> out(6);
    resolve_row<double>(samples, 1, out);
    for (const double x : out) CHECK(x == (n + 1) / 2.0);
    for (const auto& a : pattern)
      for (const auto& b : pattern)
        if (&a != &b) CHECK((a.x != b.x && a.y != b.y));  // no two share a row or a column
  }
  CHECK_THROWS(sample_pattern(3));
}

TEST_CASE("linear-sampled taps equal the exact ones, and an 8-bit fraction costs what it says") {
  const image<double> in = noise<double>(40, 1, 1, 3);
  for (const int taps : {3, 5, 7, 9, 25}) {
    const kernel k = gaussian_kernel(taps, 2);
    std::vector<double> exact(40), paired(40), coarse(40);
    blur_row_x<double>(in, k, address::repeat, 0, exact);
    blur_row_linear<double>(in, linear_taps(k), address::repeat, 0, paired);
    blur_row_linear<double>(in, linear_taps(k, 8), address::repeat, 0, coarse);
    CHECK(linear_taps(k).size() ==
          static_cast<std::size_t>(taps / 2 % 2 == 0 ? (taps + 1) / 2 : (taps + 3) / 2));
    double worst = 0;
    for (std::size_t i = 0; i < 40; ++i) {
      CHECK(std::fabs(exact[i] - paired[i]) < 1e-14);
      worst = std::max(worst, std::fabs(exact[i] - coarse[i]));
    }
    CHECK(worst <= 0x1p-9);  // half a step of the fraction, weights sum to at most 1
    if (taps > 3) CHECK(worst > 0);
  }
}

TEST_CASE("kernels in 8 bits: the sum is reported, renormalising mends it") {
  // theory: an 8-bit Gaussian with sigma 2 sums to 1.0039 with 5 or 9 taps, to 1 with 7
  for (const auto& [taps, sum] :
       {std::pair{5, 256.0 / 255}, std::pair{7, 1.0}, std::pair{9, 256.0 / 255}}) {
    CAPTURE(taps);
    CHECK(std::fabs(round_kernel(gaussian_kernel(taps, 2), unorm_encoding(8), false).sum - sum) <
          1e-12);
    CHECK(std::fabs(round_kernel(gaussian_kernel(taps, 2), unorm_encoding(8), true).sum - 1) <
          1e-12);
  }
}

TEST_CASE("one pass and two passes blur alike in exact arithmetic") {
  image<exact_rational> in(6, 5, 1);
  for (std::size_t i = 0; i < in.texels.size(); ++i)
    in.texels[i] = exact_rational(static_cast<int>(i * 7 % 11));
  const kernel k = gaussian_kernel(3, 1);
  image<exact_rational> across(6, 5, 1);
  std::vector<exact_rational> two(6), one(6);
  for (int y = 0; y < 5; ++y) blur_row_x<exact_rational>(in, k, address::mirror, y, across.row(y));
  for (int y = 0; y < 5; ++y) {
    blur_row_y<exact_rational>(across, k, address::mirror, y, two);
    blur_row_square<exact_rational>(in, k, address::mirror, y, one);
    for (std::size_t x = 0; x < 6; ++x) CHECK(one[x] == two[x]);
  }
}

TEST_CASE("area integration is exact: whole texels, constants, translation by a period") {
  image<exact_rational> in(4, 4, 1);
  for (std::size_t i = 0; i < 16; ++i) in.texels[i] = exact_rational(static_cast<int>(i * i));
  const exact_rational centre(0.5);
  // One pixel over the whole image: the plain mean.
  exact_rational sum(0);
  for (const auto& t : in.texels) sum += t;
  CHECK(area_mean(in, centre, centre, {1, 0, 0, 1}, address::repeat, 0) ==
        sum / exact_rational(16));
  // A sheared footprint of a period's width in a repeated image: rows count equally.
  CHECK(area_mean(in, centre, centre, {1, 0, 0.25, 1}, address::repeat, 0) ==
        sum / exact_rational(16));
  const gradients slanted{0.3125, 0.125, -0.25, 0.1875};
  const exact_rational here =
      area_mean(in, exact_rational(0.3), exact_rational(0.6), slanted, address::repeat, 0);
  const exact_rational there = area_mean(in, exact_rational(0.3) + exact_rational(1),
                                         exact_rational(0.6), slanted, address::repeat, 0);
  CHECK(here == there);
  const image<exact_rational> flat(4, 4, 1, exact_rational(3) / exact_rational(7));
  CHECK(area_mean(flat, exact_rational(0.1), exact_rational(0.9), slanted, address::clamp, 0) ==
        exact_rational(3) / exact_rational(7));
  image<double> wide(4, 4, 1, 0.75);
  CHECK(ewa_reference(wide, 0.3, 0.6, slanted, address::repeat, 0) == Approx(0.75));
}
