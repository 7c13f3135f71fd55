// Hard cases 21 to 26, 28 and 29: filters where numbers get difficult.
#include <algorithm>
#include <cmath>
#include <random>

#include "bitshade/interop/rational.hpp"
#include "bitshade/texture/blur_variants.hpp"
#include "bitshade/texture/device_sampler.hpp"
#include "bitshade/texture/exact_mips.hpp"
#include "bitshade/texture/sat.hpp"
#include "support/catch.hpp"
#include "support/roundings.hpp"

using namespace bitshade;

namespace {

constexpr double q16 = 1.0 / 65535;
constexpr auto keep = [](auto) {};

/// Nine taps by five fetches and by themselves: a fraction read back from a place below 4 (half of
/// 2^-51, and its quotient's), a fetch's difference, product and sum, five products and sums; nine
/// products and eight sums.
constexpr double linear_fetches = test::roundings(3 + 3 + 5) + test::weighted_sum(9);

image<double> depths(int w, int h, int channels, unsigned seed) {
  std::mt19937 random(seed);
  image<double> out(w, h, channels);
  for (double& t : out.texels) t = decode(unorm_encoding(16), random() & 0xffff);
  return out;
}

double largest_difference(const image<double>& a, const image<double>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.texels.size(); ++i)
    worst = std::max(worst, std::fabs(a.texels[i] - b.texels[i]));
  return worst;
}

/// A separable blur whose passes are rounded to unorm16 or not.
image<double> blurred(const image<double>& in, const kernel& k, bool round_between,
                      bool round_after) {
  const auto store16 = [](std::span<double> row) {
    for (double& x : row) x = round_to(unorm_encoding(16), x);
  };
  image<double> across(in.width, in.height, in.channels), out = across;
  for (int y = 0; y < in.height; ++y) {
    blur_row_x<double>(in, k, address::clamp, y, across.row(y));
    if (round_between) store16(across.row(y));
  }
  for (int y = 0; y < in.height; ++y) {
    blur_row_y<double>(across, k, address::clamp, y, out.row(y));
    if (round_after) store16(out.row(y));
  }
  return out;
}

}  // namespace

TEST_CASE(
    "hard case 21: a blur rounded between its passes counts K = 2; a wide intermediate is the "
    "cure") {
  const image<double> in = depths(64, 48, 2, 1);
  const kernel k = gaussian_kernel(9, 2);
  const image<double> truth = blurred(in, k, false, false);
  const double twice = largest_difference(blurred(in, k, true, true), truth);
  const double once = largest_difference(blurred(in, k, false, true), truth);
  // Weights sum to 1: the first rounding is averaged. Both sums of the second pass err by
  // themselves, and each store's number is rounded to binary64; one store alone meets equal sums.
  CHECK(twice <= 2 * q16 / 2 + 2 * test::weighted_sum(9) + test::roundings(3));
  CHECK(once <= q16 / 2 + test::roundings(2));
  CHECK(twice > once);
}

TEST_CASE("hard case 22: twelve levels drift by at most K roundings; truncation drifts one way") {
  const image<double> in = depths(4096, 2, 1, 2);
  double mean = 0;
  for (const double t : in.texels) mean += t;
  mean /= static_cast<double>(in.texels.size());
  const texel_format unorm = uniform_format(unorm_encoding(16), 1),
                     half = uniform_format(binary16::value, 1);
  const auto chain = exact_mip_chain<exact_rational>(
      unorm, store(preset_detail::exact(), unorm, in), mip_filter::area);
  REQUIRE(chain.size() == 13);
  CHECK(std::fabs(decode(unorm_encoding(16), chain[12].at(0, 0)) - mean) <= 12 * q16 / 2);

  // llvmpipe stores half toward zero: every level loses, none gains.
  const filter_model truncating = *find_preset("llvmpipe");
  const coded_image base = store(truncating, half, in);
  const auto levels =
      load_chain<double>(truncating, half, device_mip_chain(truncating, half, base));
  double previous = 0, base_mean = 0;
  for (const double t : levels[0].texels)
    base_mean += t / static_cast<double>(levels[0].texels.size());
  for (std::size_t l = 1; l < levels.size(); ++l) {
    double level_mean = 0;
    for (const double t : levels[l].texels)
      level_mean += t / static_cast<double>(levels[l].texels.size());
    const double drift = level_mean - base_mean;
    CAPTURE(l, drift);
    CHECK(drift <= previous);  // half numbers over powers of two: means without rounding
    CHECK(drift >= -static_cast<double>(l) * 0x1p-11);  // an ulp of half on [1/2, 1) a level
    previous = drift;
  }
  CHECK(previous < -0x1p-12);
}

TEST_CASE("hard case 23: weights that do not sum to 1 are flagged, and renormalised on request") {
  const image<double> flat(16, 1, 1, 1.0);
  std::vector<double> out(16);
  for (const int taps : {5, 7, 9}) {
    const rounded_kernel as_stored =
        round_kernel(gaussian_kernel(taps, 2), unorm_encoding(8), false);
    blur_row_x<double>(flat, as_stored.taps, address::clamp, 0, out);
    // What sum announces is what happens, added in another order.
    CHECK(std::fabs(out[8] - as_stored.sum) <= 2 * test::weighted_sum(taps));
    const rounded_kernel mended = round_kernel(gaussian_kernel(taps, 2), unorm_encoding(8), true);
    CHECK(std::fabs(mended.sum - 1) <= test::weighted_sum(taps));
  }
  CHECK(std::fabs(round_kernel(gaussian_kernel(9, 2), unorm_encoding(8), false).sum - 1) > 1e-3);
}

TEST_CASE(
    "hard case 24: linear-sampled taps with 8-bit fractions err within their bound; exact taps "
    "cure") {
  const image<double> in = depths(200, 1, 1, 5);
  const kernel k = gaussian_kernel(9, 2);
  image<double> exact(200, 1, 1), coarse = exact, fine = exact;
  blur_row_x<double>(in, k, address::clamp, 0, exact.row(0));
  blur_row_linear<double>(in, linear_taps(k, 8), address::clamp, 0, coarse.row(0));
  blur_row_linear<double>(in, linear_taps(k), address::clamp, 0, fine.row(0));
  const double error = largest_difference(coarse, exact);
  // Each pair's fraction is off by 2^-9 of its weight at most, times a difference of depths <= 1.
  const double pairs = 1 - k.weights[4];
  CHECK(error <= pairs * 0x1p-9);
  CHECK(error > 4 * q16);  // and that is more than the format's own step
  CHECK(largest_difference(fine, exact) <= linear_fetches);
}

TEST_CASE(
    "hard case 25: borders, all modes, degenerate and odd sizes: no dark frame, nothing outside") {
  for (const auto& [w, h] :
       {std::pair{1, 1}, std::pair{1, 9}, std::pair{9, 1}, std::pair{7, 5}, std::pair{16, 8}})
    for (const filter_model& m : presets)
      for (const address mode :
           {address::clamp, address::repeat, address::mirror, address::border}) {
        const int bits = m.order == accumulation::lerp_codes ? 8 : 16;
        const texel_format format = uniform_format(unorm_encoding(bits), 1);
        std::vector<coded_image> chain;
        for (int l = 0; l < mip_levels(w, h); ++l)
          chain.emplace_back(mip_size(w, l), mip_size(h, l), 1, low_bits(bits));
        sampler_state state;
        state.u = state.v = mode;
        state.mips = mip_selection::linear;
        state.border = {1, 1, 1, 1};  // a lit border leaves a lit image lit
        const device_sampler sampler(m, format, chain, state);
        for (const float u : {-2.5f, -0.001f, 0.0f, 0x1p-30f, 0.5f, 0.999999f, 1.0f, 1.001f, 7.25f})
          for (const float v : {-1.0f, 0.0f, 0.3f, 1.0f, 2.0f}) {
            const float got = sampler.lod(u, v, 0.5f, 0);
            CAPTURE(w, h, std::string(m.name), static_cast<int>(mode), u, v);
            REQUIRE(std::fabs(got - 1.0f) <= 0x1p-22f);
          }
      }
}

TEST_CASE("hard case 26: 16:1 anisotropy and changing probe counts leave no seam on a ramp") {
  // A ramp is what every symmetric set of probes must give back, however many there are. The
  // levels are ramps too, so that only roundings can show.
  const texel_format format = uniform_format(binary32::value, 1);
  std::vector<coded_image> chain;
  for (int l = 0; l < 7; ++l) {
    image<double> ramp(64 >> l, 64 >> l, 1);
    for (int y = 0; y < ramp.height; ++y)
      for (int x = 0; x < ramp.width; ++x) ramp.at(x, y) = (x + 0.5) / ramp.width;
    chain.push_back(store(preset_detail::exact(), format, ramp));
  }
  // u, the offsets and their sums are each rounded at 2^-24, 16 times; weights fl(1/n) likewise.
  constexpr double seam = 64 * 0x1p-24;
  sampler_state state;
  state.mips = mip_selection::linear;
  state.max_anisotropy = 16;
  for (const char* name : {"d3d11", "vulkan-strict", "cuda", "swiftshader"}) {
    filter_model m = *find_preset(name);
    m.grid_bits = 0;  // the grid's own 2^-9 texels would hide what the probes do
    m.weight_bits = 0;
    const device_sampler sampler(m, format, chain, state);
    int counts = 0;
    for (int i = 0; i <= 400; ++i) {
      const double ratio = 1 + i * 0.04;
      const float got = sampler.gradient(0.5f, 0.5f, {ratio / 128, 0, 0, 1.0 / 128}, 0);
      CAPTURE(name, ratio);
      CHECK(std::fabs(static_cast<double>(got) - 0.5) <= seam);
      const probe_plan plan =
          plan_probes(m.anisotropy, m.log2, {ratio / 128, 0, 0, 1.0 / 128}, 64, 64, 16);
      double sum = 0;
      for (int k = 0; k < plan.count; ++k) sum += plan.weight(k);
      CHECK(std::fabs(sum - 1) <= 16 * 0x1p-25);
      counts = std::max(counts, plan.count);
    }
    CHECK(counts == 16);
  }
}

TEST_CASE("hard case 28: tables of 4096 x 4096, window in the far corner") {
  constexpr int size = 4096;
  std::mt19937 random(3);
  image<std::uint32_t> codes(size, size, 1);
  for (auto& t : codes.texels) t = random() & 0xffff;
  std::uint64_t direct = 0;
  for (int y = size - 8; y < size; ++y)
    for (int x = size - 8; x < size; ++x) direct += codes.at(x, y);
  const double truth = static_cast<double>(direct) / 64 / 65535;

  image<float> in(size, size, 1);
  for (std::size_t i = 0; i < in.texels.size(); ++i)
    in.texels[i] = static_cast<float>(codes.texels[i]) / 65535.0f;
  const auto floats = make_sat(std::move(in), sat_order::running, sat_offset::none, keep);
  const double error = std::fabs(
      static_cast<double>(box_mean(floats, size - 8, size - 8, size - 1, size - 1, 0)) - truth);
  CHECK(error > 100 * q16);  // the plain method fails, as predicted:
  CHECK(error <=
        4 * 4096.0 * 2 / 2 / 64);  // four corners, 2 x 4096 roundings of half an ulp (1 at 2^23)

  const auto integers = make_sat(std::move(codes), sat_order::running, sat_offset::none, keep);
  CHECK(box_sum(integers, size - 8, size - 8, size - 1, size - 1, 0) == direct);

  CHECK_THROWS_WITH(require_sat_fits(size, size, 1, 65504), Catch::Contains("saturates"));  // half
  CHECK_THROWS_WITH(require_sat_fits(size, size, 1, 1), Catch::Contains("saturates"));  // unorm16
  CHECK_NOTHROW(require_sat_fits(size, size, 1, 0x1.fffffep127));
}

TEST_CASE("hard case 29: a uint32 table that wraps keeps box sums exact") {
  image<std::uint64_t> codes(600, 500, 1, 0xffff);
  const auto sat = make_modular_sat<std::uint32_t>(codes, 16);
  constexpr std::uint64_t whole = std::uint64_t{600} * 500 * 0xffff;
  static_assert(whole > 0xffffffff);
  CHECK(sat.sums.at(599, 499) == static_cast<std::uint32_t>(whole));  // it did wrap
  CHECK(box_sum(sat, 344, 244, 599, 499, 0) == 256u * 256u * 0xffffu);
  CHECK(modular_box_texels<std::uint32_t>(16) == 65536);
}
