// Hard cases 21 to 26, 28 and 29 in every format that they concern.
#include <algorithm>
#include <cmath>
#include <random>

#include "bitshade/formats/limits.hpp"
#include "bitshade/interop/rational.hpp"
#include "bitshade/texture/blur_variants.hpp"
#include "bitshade/texture/device_sampler.hpp"
#include "bitshade/texture/exact_mips.hpp"
#include "bitshade/texture/sat.hpp"
#include "support/catch.hpp"
#include "support/half_step.hpp"
#include "support/roundings.hpp"

using namespace bitshade;
using test::format_named;
using test::half_step;
using test::hard_formats;

namespace {

/// Nine taps by five fetches and by themselves, as in texture.cpp.
constexpr double linear_fetches = test::roundings(3 + 3 + 5) + test::weighted_sum(9);

/// Depths that the format holds.
image<double> depths(const encoding& e, int w, int h, unsigned seed) {
  std::mt19937 random(seed);
  image<double> out(w, h);
  for (double& t : out.texels) t = round_to(e, static_cast<double>(random() >> 8) * 0x1p-24);
  return out;
}

double largest_difference(const image<double>& a, const image<double>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.texels.size(); ++i)
    worst = std::max(worst, std::fabs(a.texels[i] - b.texels[i]));
  return worst;
}

void store_rows(const encoding& e, image<double>& in) {
  for (double& x : in.texels) x = round_to(e, x);
}

}  // namespace

TEST_CASE("hard case 21 in every format: K roundings of a blur, and the wide intermediate's one") {
  const kernel k = gaussian_kernel(9, 2);
  for (const auto name : hard_formats) {
    const encoding e = format_named(name);
    const image<double> in = depths(e, 48, 40, 1);
    const auto blurred = [&](bool between, bool after) {
      image<double> across = in, out = in;
      for (int y = 0; y < in.height; ++y)
        blur_row_x<double>(in, k, address::clamp, y, across.row(y));
      if (between) store_rows(e, across);
      for (int y = 0; y < in.height; ++y)
        blur_row_y<double>(across, k, address::clamp, y, out.row(y));
      if (after) store_rows(e, out);
      return out;
    };
    const auto truth = blurred(false, false);
    const double twice = largest_difference(blurred(true, true), truth);
    const double once = largest_difference(blurred(false, true), truth);
    CAPTURE(std::string(name), once, twice, half_step(e));
    // As in texture.cpp: two sums of the second pass, and the numbers that stores leave.
    CHECK(once <= half_step(e) + test::roundings(2));
    CHECK(twice <= 2 * half_step(e) + 2 * test::weighted_sum(9) + test::roundings(3));
    CHECK(twice > once);
  }
}

TEST_CASE("hard case 22 in every format: twelve levels drift by K roundings, truncated ones down") {
  for (const auto name : hard_formats) {
    const encoding e = format_named(name);
    const texel_format format = uniform_format(e, 1);
    const image<double> in = depths(e, 4096, 1, 2);
    double mean = 0;
    for (const double t : in.texels) mean += t / 4096;
    const auto top = [&](const filter_model& m) {
      image<double> level = in;
      for (int l = 1; l <= 12; ++l) {
        image<double> next(level.width / 2, 1);
        downsample_row<double>(level, mip_filter::box, 0, next.row(0));
        level = load_image<double>(m, format, store(m, format, next));
      }
      return level.at(0, 0) - mean;
    };
    filter_model nearest, down;
    down.store.direction = rounding::toward_zero;
    CAPTURE(std::string(name), top(nearest), top(down), half_step(e));
    // The mean's 4096 additions; a level's sum and the number that its store leaves.
    CHECK(std::fabs(top(nearest)) <= 12 * half_step(e) + test::roundings(4096 + 12 * 2));
    // A binary format's numbers truncated: never up, and less than two half steps a level.
    if (e.kind != family::binary) continue;
    CHECK(top(down) <= 0);
    CHECK(top(down) >= -12 * 2 * half_step(e));
    CHECK(top(down) < top(nearest));
  }
}

TEST_CASE("hard case 22: the exact chain of stored texels has one rounding a level") {
  for (const auto name : hard_formats) {
    const encoding e = format_named(name);
    const texel_format format = uniform_format(e, 1);
    const auto base = store(preset_detail::exact(), format, depths(e, 64, 2, 3));
    const auto chain = load_chain<double>(
        filter_model{}, format, exact_mip_chain<exact_rational>(format, base, mip_filter::area));
    REQUIRE(chain.size() == 7);
    for (std::size_t l = 1; l < chain.size(); ++l)
      for (int x = 0; x < chain[l].width; ++x) {
        double mean = 0;
        const int rows = chain[l - 1].height;
        for (int j = 0; j < rows; ++j)
          for (int i = 0; i < 2; ++i) mean += chain[l - 1].at(2 * x + i, j) / (2 * rows);
        CAPTURE(std::string(name), l, x);
        // Up to four texels and the level's, rounded to binary64, and three additions.
        CHECK(std::fabs(chain[l].at(x, 0) - mean) <= half_step(e) + test::roundings(1 + 1 + 3));
      }
  }
}

TEST_CASE("hard case 23 in every format: what the sum of rounded weights says is what happens") {
  const image<double> flat(32, 1, 1, 1.0);
  std::vector<double> out(32);
  for (const auto name : hard_formats)
    for (const int taps : {3, 5, 7, 9, 25}) {
      const encoding e = format_named(name);
      for (const bool renormalise : {false, true}) {
        const auto k = round_kernel(gaussian_kernel(taps, 2), e, renormalise);
        blur_row_x<double>(flat, k.taps, address::clamp, 0, out);
        CAPTURE(std::string(name), taps, renormalise, k.sum);
        CHECK(std::fabs(out[16] - k.sum) <= 2 * test::weighted_sum(taps));
        CHECK(std::fabs(k.sum - 1) <=
              (renormalise ? 1 : taps) * half_step(e) + test::weighted_sum(taps));
      }
    }
}

TEST_CASE("hard case 24 at 4, 6 and 8 bits of fraction, in every format: error within the pairs'") {
  const kernel k = gaussian_kernel(9, 2);
  for (const auto name : hard_formats) {
    const encoding e = format_named(name);
    const image<double> in = depths(e, 200, 1, 5);
    image<double> exact = in, linear = in;
    blur_row_x<double>(in, k, address::clamp, 0, exact.row(0));
    double before = 1;
    for (const int bits : {4, 6, 8}) {
      blur_row_linear<double>(in, linear_taps(k, bits), address::clamp, 0, linear.row(0));
      const double error = largest_difference(linear, exact);
      CAPTURE(std::string(name), bits, error);
      // Half a step of each pair's weight, texels at most 1 apart; the pairs weigh 1 - w_0.
      CHECK(error <= std::ldexp(1 - k.weights[4], -bits - 1));
      CHECK(error > 0);
      CHECK(error < before);
      before = error;
    }
    blur_row_linear<double>(in, linear_taps(k), address::clamp, 0, linear.row(0));  // the cure
    CHECK(largest_difference(linear, exact) <= linear_fetches);
  }
}

TEST_CASE("hard case 25 in every format: every address mode and size, lit images stay lit") {
  for (const auto name : hard_formats) {
    const encoding e = format_named(name);
    const texel_format format = uniform_format(e, 1);
    for (const auto& [w, h] : {std::pair{1, 1}, std::pair{1, 6}, std::pair{7, 5}})
      for (const address mode : {address::clamp, address::repeat, address::mirror, address::border})
        for (const char* preset : {"exact", "d3d11", "vulkan-strict", "cuda", "softpipe"}) {
          const filter_model m = *find_preset(preset);
          std::vector<coded_image> chain;
          for (int l = 0; l < mip_levels(w, h); ++l)
            chain.push_back(
                store(filter_model{}, format, image<double>(mip_size(w, l), mip_size(h, l), 1, 1)));
          sampler_state state;
          state.u = state.v = mode;
          state.mips = mip_selection::linear;
          state.border = {1, 1, 1, 1};
          const device_sampler sampler(m, format, chain, state);
          for (const float u : {-1e9f, -2.5f, -0.001f, 0.0f, 0.5f, 1.0f, 7.25f, 1e9f}) {
            CAPTURE(std::string(name), w, h, static_cast<int>(mode), preset, u);
            REQUIRE(std::fabs(sampler.lod(u, 0.3f, 0.5f, 0) - 1) <= 0x1p-22f);
          }
        }
  }
}

TEST_CASE("hard case 26 in every format: a ramp under 16:1 probes errs by its texels alone") {
  for (const auto name : hard_formats) {
    const encoding e = format_named(name);
    const texel_format format = uniform_format(e, 1);
    std::vector<coded_image> chain;
    for (int l = 0; l < 7; ++l) {
      image<double> ramp(64 >> l, 64 >> l, 1);
      for (int y = 0; y < ramp.height; ++y)
        for (int x = 0; x < ramp.width; ++x) ramp.at(x, y) = (x + 0.5) / ramp.width;
      chain.push_back(store(filter_model{}, format, ramp));
    }
    sampler_state state;
    state.mips = mip_selection::linear;
    state.max_anisotropy = 16;
    filter_model m = *find_preset("vulkan-strict");
    m.grid_bits = 0;
    const device_sampler sampler(m, format, chain, state);
    for (int i = 0; i <= 60; ++i) {
      const double ratio = 1 + i * 0.25;
      const float got = sampler.gradient(0.5f, 0.5f, {ratio / 128, 0, 0, 1.0 / 128}, 0);
      CAPTURE(std::string(name), ratio);
      // The ramp's own value, texels rounded once and a mean of them; 64 roundings of binary32.
      CHECK(std::fabs(static_cast<double>(got) - 0.5) <= half_step(e) + 64 * 0x1p-24);
    }
  }
}

TEST_CASE("hard case 28 in every format: what a table's store must hold, or the refusal") {
  constexpr auto size = 4096;
  for (const auto name : hard_formats) {
    const encoding e = format_named(name);
    const double most = decode(e, max_bits(e));
    CAPTURE(std::string(name), most);
    if (most < static_cast<double>(size) * size)
      CHECK_THROWS_WITH(require_sat_fits(size, size, 1, most), Catch::Contains("saturates"));
    else
      CHECK_NOTHROW(require_sat_fits(size, size, 1, most));
  }
  // What fits is not yet good: a smaller map in bfloat16 errs as 8 bits of significand predict.
  const encoding coarse = format_named("bfloat16");
  const image<double> in = depths(coarse, 64, 64, 7);
  const auto table = make_sat(in, sat_order::running, sat_offset::none, [&](std::span<double> row) {
    for (double& x : row) x = round_to(coarse, x);
  });
  double direct = 0;
  for (int y = 56; y < 64; ++y)
    for (int x = 56; x < 64; ++x) direct += in.at(x, y) / 64;
  const double error = std::fabs(box_mean(table, 56, 56, 63, 63, 0) - direct);
  // A rounding of a sum under 4096 is at most half of 2^4, of a row's at most half of 2^-1; each
  // corner collects those of up to 64 rows.
  CHECK(error <= 4 * 64 * (8 + 0.25) / 64);
  CHECK(error > half_step(coarse));
}

TEST_CASE("hard case 29 for codes of 8, 16 and 24 bits: a wrapping table's boxes are exact") {
  for (const int bits : {8, 16, 24}) {
    const int w = bits == 24 ? 40 : 700, h = bits == 24 ? 30 : 600;
    image<std::uint64_t> codes(w, h, 1, low_bits(bits));
    if (bits == 8) codes = image<std::uint64_t>(5000, 3400, 1, 255);  // to pass 2^32 at all
    const auto sat = make_modular_sat<std::uint32_t>(codes, bits);
    const std::uint64_t whole = low_bits(bits) * static_cast<std::uint64_t>(codes.width) *
                                static_cast<std::uint64_t>(codes.height);
    CAPTURE(bits);
    CHECK(sat.sums.texels.back() != whole);  // it did wrap
    const int side = bits == 24 ? 16 : 256;  // at most 2^(32 - bits) texels
    REQUIRE(static_cast<std::uint64_t>(side) * static_cast<std::uint64_t>(side) <=
            modular_box_texels<std::uint32_t>(bits));
    CHECK(box_sum(sat, codes.width - side, codes.height - side, codes.width - 1, codes.height - 1,
                  0) ==
          low_bits(bits) * static_cast<std::uint64_t>(side) * static_cast<std::uint64_t>(side));
  }
}
