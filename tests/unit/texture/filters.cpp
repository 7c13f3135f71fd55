// The small pieces against closed forms and against the plainest loop that means the same.
#include "support/catch.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

#include "bitshade/texture/blur.hpp"
#include "bitshade/texture/gaussian.hpp"
#include "bitshade/texture/trilinear.hpp"

using namespace bitshade;

namespace {

image<float> noise(int w, int h, int channels, std::uint32_t seed = 1) {
  image<float> result(w, h, channels);
  for (float& t : result.texels) {
    seed = seed * 1664525u + 1013904223u;
    t = static_cast<float>(seed >> 8) * 0x1p-24f;
  }
  return result;
}

}  // namespace

TEST_CASE("wrap: every mode on every index around small sizes") {
  const std::vector<int> mirrored{0, 1, 2, 2, 1, 0};  // period 2n for n = 3
  for (int i = -25; i < 25; ++i) {
    CAPTURE(i);
    CHECK(wrap(i, 3, address::clamp) == (i < 0 ? 0 : i > 2 ? 2 : i));
    CHECK(wrap(i, 3, address::repeat) == ((i % 3) + 3) % 3);
    CHECK(wrap(i, 3, address::mirror) == mirrored[static_cast<std::size_t>(((i % 6) + 6) % 6)]);
    CHECK(wrap(i, 3, address::border) == (i < 0 || i > 2 ? -1 : i));
    CHECK(wrap(i, 1, address::mirror) == 0);
  }
  for (const address mode : {address::clamp, address::repeat, address::mirror}) {
    for (const int i : {INT32_MIN, INT32_MAX}) {
      const int at = wrap(i, 7, mode);
      CHECK((at >= 0 && at < 7));
    }
  }
}

TEST_CASE("exp_fixed and log2_fixed stay within their bounds") {
  double worst_exp = 0, worst_log = 0;
  for (int i = -69000; i <= 69000; ++i) {
    const double x = i / 100.0 + 1e-3 * std::sin(i);
    const auto truth = std::exp(static_cast<long double>(x));
    const auto error = std::fabs((exp_fixed(x) - truth) / truth);
    worst_exp = std::max(worst_exp, static_cast<double>(error) * 0x1p53);
    const double y = exp_fixed(x);
    const auto log_truth = std::log2(static_cast<long double>(y));
    const auto log_error = std::fabs(log2_fixed(y) - log_truth) / (1 + std::fabs(log_truth));
    worst_log = std::max(worst_log, static_cast<double>(log_error) * 0x1p53);
  }
  CAPTURE(worst_exp, worst_log);
  CHECK(worst_exp <= exp_fixed_error);
  CHECK(worst_log <= log2_fixed_error);
  for (int k = -1070; k < 1024; ++k) CHECK(log2_fixed(std::ldexp(1.0, k)) == k);
  CHECK(exp_fixed(0) == 1);
  CHECK(exp_fixed(-1e9) == 0);
  CHECK(std::isnan(exp_fixed(NAN)));
  CHECK(std::isnan(log2_fixed(-1)));
}

TEST_CASE("Gaussian weights are symmetric, on their grid and sum to exactly 1") {
  for (int taps = 1; taps <= 41; taps += 2)
    for (const double sigma : {0.1, 0.5, 1.0, 1.25, 2.0, 5.0, 100.0}) {
      CAPTURE(taps, sigma);
      const kernel k = gaussian_kernel(taps, sigma);
      long double total = 0, truth_total = 0;
      for (int i = -k.radius(); i <= k.radius(); ++i)
        truth_total += std::exp(-static_cast<long double>(i) * i / (2 * sigma * sigma));
      for (int i = 0; i < taps; ++i) {
        const double w = k.weights[static_cast<std::size_t>(i)];
        total += w;
        CHECK(w == k.weights[static_cast<std::size_t>(taps - 1 - i)]);
        CHECK(std::trunc(w / kernel_grid) == w / kernel_grid);
        const long double d = i - k.radius();
        const auto truth = std::exp(-d * d / (2 * sigma * sigma)) / truth_total;
        CHECK(std::fabs(w - truth) <= gaussian_weight_abs_error);
      }
      CHECK(total == 1);
    }
  CHECK_THROWS(gaussian_kernel(4, 1));
  CHECK_THROWS(gaussian_kernel(5, 0));
}

TEST_CASE("blur rows equal the plain loop bit for bit, every mode, width and channel count") {
  for (const address mode : {address::clamp, address::repeat, address::mirror, address::border})
    for (const int width : {1, 2, 5, 8, 9, 70})
      for (int channels = 1; channels <= 4; ++channels)
        for (const int taps : {1, 3, 9, 25}) {
          const image<float> in = noise(width, 6, channels);
          const kernel k = gaussian_kernel(taps, 2);
          std::vector<float> across(in.row_size()), down(in.row_size());
          const int y = 4;
          const float border = 0.625f;
          blur_row_x<float>(in, k, mode, y, across, border);
          blur_row_y<float>(in, k, mode, y, down, border);
          for (int x = 0; x < width; ++x)
            for (int c = 0; c < channels; ++c) {
              float sum_x = 0, sum_y = 0;
              for (int i = 0; i < taps; ++i) {
                const auto w = static_cast<float>(k.weights[static_cast<std::size_t>(i)]);
                const int from_x = wrap(x + i - taps / 2, width, mode);
                const int from_y = wrap(y + i - taps / 2, 6, mode);
                sum_x += w * (from_x < 0 ? border : in.at(from_x, y, c));
                sum_y += w * (from_y < 0 ? border : in.at(x, from_y, c));
              }
              const auto at = static_cast<std::size_t>(x * channels + c);
              CAPTURE(static_cast<int>(mode), width, channels, taps, x, c);
              REQUIRE(across[at] == sum_x);
              REQUIRE(down[at] == sum_y);
            }
        }
}

TEST_CASE("bilinear: texel centres are exact, edges halve, indices never leave the image") {
  const image<float> in = noise(5, 3, 2);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 5; ++x) {
      const auto at = locate<double>((x + 0.5) / 5, (y + 0.5) / 3, 5, 3, address::repeat);
      CHECK(at.x0 + at.fx == Approx(x));
      CHECK(at.y0 + at.fy == Approx(y));
    }
  const auto corner = locate<float>(0, 0, 5, 3, address::repeat);
  CHECK(corner.x0 == 4);
  CHECK(corner.x1 == 0);
  CHECK(corner.fx == 0.5f);
  CHECK(bilinear(in, locate<float>(-9, 9, 5, 3, address::clamp), 1) == in.at(0, 2, 1));
  CHECK(bilinear(in, locate<float>(-9, 9, 5, 3, address::border), 1, 0.25f) == 0.25f);
  for (const float u : {INFINITY, -INFINITY, NAN, 1e30f, -1e30f, 0x1p31f})
    for (const address mode : {address::clamp, address::repeat, address::mirror, address::border}) {
      const auto at = locate<float>(u, u, 5, 3, mode);
      for (const int i : {at.x0, at.x1}) CHECK((i >= (mode == address::border ? -1 : 0) && i < 5));
      for (const int i : {at.y0, at.y1}) CHECK((i >= (mode == address::border ? -1 : 0) && i < 3));
    }
}

TEST_CASE("mip weights sum to 1, stay inside and keep the filter's meaning") {
  for (const mip_filter filter : {mip_filter::box, mip_filter::centre, mip_filter::area})
    for (int from = 1; from < 40; ++from)
      for (int x = 0; x < std::max(1, from / 2); ++x) {
        const mip_taps taps = mip_axis(filter, from, x);
        CAPTURE(static_cast<int>(filter), from, x);
        int sum = 0;
        double moment = 0;
        for (int i = 0; i < taps.count; ++i) {
          const int w = taps.weight[static_cast<std::size_t>(i)];
          CHECK(w > 0);
          sum += w;
          moment += w * (taps.first + i + 0.5);
        }
        CHECK(sum == taps.denominator);
        CHECK(taps.first >= 0);
        CHECK(taps.first + taps.count <= from);
        // centre's first moment is the texel's centre; area's only its covered mean
        if (filter == mip_filter::centre && from > 1)
          CHECK(moment / sum == Approx((x + 0.5) * from / (from / 2)));
      }
  // area conserves the mean
  image<double> in(7, 5, 1);
  double mean = 0;
  for (std::size_t i = 0; i < in.texels.size(); ++i) mean += in.texels[i] = std::sin(1.0 * i);
  const auto levels = mip_chain(in, mip_filter::area, [](auto) {});
  REQUIRE(levels.size() == 3);
  CHECK(levels.back().at(0, 0) == Approx(mean / 35));
}

TEST_CASE("a chain's footprint gives the sampled value, also on its base level") {
  const image<float> base = noise(13, 8, 1);
  image<double> wide(13, 8, 1);
  for (std::size_t i = 0; i < base.texels.size(); ++i) wide.texels[i] = base.texels[i];
  for (const mip_filter filter : {mip_filter::box, mip_filter::centre, mip_filter::area}) {
    const auto chain = mip_chain(wide, filter, [](auto) {});
    for (const address mode : {address::clamp, address::repeat, address::mirror, address::border})
      for (int i = 0; i < 40; ++i) {
        const double u = 0.07 * i - 0.9, v = 0.05 * i - 0.5;
        const gradients g{0.01 * i, 0.02, -0.03, 0.004 * i};
        const probe_set probes = vulkan_probes(g, 13, 8, 16);
        const double value = anisotropic<double>(chain, u, v, probes, mode, 0, 8, 0.75);
        const auto texels =
            chain_footprint<double>(13, 8, static_cast<int>(chain.size()), u, v, probes, mode);
        double sum = 0, weights = 0, base_sum = 0, base_weights = 0;
        for (const auto& t : texels) {
          sum +=
              t.weight *
              (t.x < 0 || t.y < 0 ? 0.75 : chain[static_cast<std::size_t>(t.level)].at(t.x, t.y));
          weights += t.weight;
        }
        for (const auto& t : on_base_level(texels, 13, 8, filter)) {
          base_sum += t.weight * (t.x < 0 ? 0.75 : wide.at(t.x, t.y));
          base_weights += t.weight;
        }
        CHECK(sum == Approx(value));
        CHECK(weights == Approx(1));
        CHECK(base_sum == Approx(value));
        CHECK(base_weights == Approx(1));
      }
  }
}

TEST_CASE("Vulkan's probes: count, level and symmetry") {
  const probe_set isotropic = vulkan_probes({1.0 / 64, 0, 0, 1.0 / 64}, 64, 64, 16);
  CHECK(isotropic.offsets.size() == 1);
  CHECK(isotropic.lambda == 0);
  const probe_set long_x = vulkan_probes({16.0 / 64, 0, 0, 1.0 / 64}, 64, 64, 16);
  REQUIRE(long_x.offsets.size() == 16);
  CHECK(long_x.lambda == 0);
  for (std::size_t i = 0; i < 16; ++i) {
    CHECK(long_x.offsets[i].du == -long_x.offsets[15 - i].du);
    CHECK(std::fabs(long_x.offsets[i].du - ((i + 1) / 17.0 - 0.5) / 4) <= probe_grid / 2);
    CHECK(long_x.offsets[i].dv == 0);
  }
  CHECK(vulkan_probes({16.0 / 64, 0, 0, 1.0 / 64}, 64, 64, 4).lambda == 2);
  CHECK(vulkan_probes({1, 0, 0, 0}, 64, 64, 4).offsets.size() == 4);
  CHECK(vulkan_probes({0, 0, 0, 0}, 64, 64, 4).offsets.size() == 1);
  CHECK(vulkan_probes({NAN, 0, 0, 0}, 64, 64, 4).offsets.size() == 1);
  const level_blend blend = blend_levels(1.75, 5);
  CHECK(blend.near == 1);
  CHECK(blend.far == 2);
  CHECK(blend.fraction == 0.75);
  CHECK(blend_levels(99, 5).near == 4);
  CHECK(blend_levels(99, 5).fraction == 0);
  CHECK(blend_levels(1.5, 5, 0).near == 1);
  CHECK(blend_levels(1.51, 5, 0).near == 2);
}
