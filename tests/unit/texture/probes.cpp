// Probes of anisotropic lookups: Feline's weights, the ellipse's axes, and both against the
// elliptical average and exact area integration.
#include "bitshade/texture/probes.hpp"

#include <cmath>
#include <random>

#include "bitshade/texture/area.hpp"
#include "bitshade/texture/sampler.hpp"
#include "support/catch.hpp"

using namespace bitshade;

namespace {

probe_plan feline(const gradients& g, int limit = 16) {
  return plan_probes(anisotropy_rule::feline, log2_rule::nearest, g, 64, 64, limit);
}

gradients stretched(std::mt19937& random, double length, double ratio) {
  const double angle = static_cast<double>(random() >> 8) * 0x1p-24 * 6.28;
  const double c = std::cos(angle) * length / 64, s = std::sin(angle) * length / 64;
  return {c, s, -s / ratio, c / ratio};
}

}  // namespace

TEST_CASE("Feline: weights are a Gaussian of the place on the axis, symmetric, summing to 1") {
  for (int n = 2; n <= 16; ++n) {
    const double major = 16, minor = 32.0 / (n + 1);  // n = 2 major/minor - 1
    const probe_plan plan = feline({major / 64, 0, 0, minor / 64});
    REQUIRE(plan.count == n);
    REQUIRE_FALSE(plan.uniform);
    double total = 0, unscaled = 0;
    const double end = 1 - minor / major;  // the last probe's own footprint reaches r = 1
    const auto gaussian = [&](int i) {
      const double r = end * (2.0 * i + 1 - n) / (n - 1);
      return std::exp(-2 * r * r);
    };
    for (int i = 0; i < n; ++i) unscaled += gaussian(i);
    for (int i = 0; i < n; ++i) {
      CAPTURE(n, i);
      total += static_cast<double>(plan.weight(i));
      // The end's place is a quotient in binary32: the Gaussian's slope there is at most 4.
      CHECK(std::fabs(static_cast<double>(plan.weight(i)) - gaussian(i) / unscaled) <= 0x1p-21);
      CHECK(plan.weight(i) == plan.weight(n - 1 - i));
      if (2 * i + 2 < n) CHECK(plan.weight(i) < plan.weight(i + 1));
    }
    CHECK(std::fabs(total - 1) <= n * 0x1p-25);  // each weight rounded once
    CHECK(std::fabs(static_cast<double>(plan.first) + end) <= 0x1p-22);
    CHECK(std::fabs(static_cast<double>(plan.spacing) - 2 * end / (n - 1)) <= 0x1p-21);
    CHECK(std::fabs(static_cast<double>(plan.lambda) - std::log2(minor)) <= 0x1p-20);
  }
}

TEST_CASE("Feline: one probe where nothing is stretched, none beyond the limit") {
  CHECK(feline({1.0 / 64, 0, 0, 1.0 / 64}).count == 1);
  CHECK(feline({1.0 / 64, 0, 0, 1.0 / 64}).weight(0) == 1);
  const probe_plan limited = feline({42.0 / 64, 0, 0, 1.0 / 64}, 6);
  CHECK(limited.count == 6);
  CHECK(limited.lambda == std::log2(12.0f));         // the minor radius grew to 2 * 42 / 7
  CHECK(feline({8.0 / 64, 0, 0, 0}, 4).count == 4);  // an empty minor axis
  CHECK(feline({0, 0, 0, 0}).count == 1);
}

TEST_CASE("Feline: a radius below a texel counts as one") {
  const probe_plan narrow = feline({4.0 / 64, 0, 0, 0.25 / 64});
  CHECK(narrow.count == 7);  // 2 * 4 / 1 - 1, not 31
  CHECK(narrow.lambda == 0);
  CHECK(narrow.first == -0.75f);  // the last footprint, of radius 1, ends where the ellipse does
  const probe_plan magnified = feline({0.5 / 64, 0, 0, 0.125 / 64});
  CHECK(magnified.count == 1);
  CHECK(magnified.lambda == 0);
}

TEST_CASE("Feline: one probe, of the coarsest level, where the ellipse's own is coarser still") {
  image<double> in(16, 16, 1);
  std::mt19937 random(3);
  for (double& t : in.texels) t = static_cast<double>(random() >> 8) * 0x1p-24;
  auto chain = mip_chain(in, mip_filter::box, [](std::span<double>) {});
  chain.resize(3);  // 16, 8, 4: probes apart see other texels
  sampler_state state;
  state.mips = mip_selection::linear;
  state.max_anisotropy = 16;
  filter_model m;
  m.anisotropy = anisotropy_rule::feline;
  // Radii 12 and 4.5 texels: log2 4.5 is beyond level 2; at 4 it is not.
  const auto at = [&](double minor) {
    return sample_gradients<double>(m, chain, 0.4, 0.3, {12.0 / 16, 0, 0, minor / 16}, state, 0);
  };
  CHECK(at(4.5) == sample_level<double>(m, chain.back(), 0.4, 0.3, state, 0));
  CHECK(at(4) != sample_level<double>(m, chain.back(), 0.4, 0.3, state, 0));
}

TEST_CASE("the ellipse's axes are orthogonal and span the same ellipse") {
  std::mt19937 random(4);
  const auto unit = [&] { return static_cast<float>(random() >> 8) * 0x1p-23f - 1; };
  for (int i = 0; i < 200; ++i) {
    float a = unit(), b = unit(), c = unit(), d = unit();
    const double xx = a * a + c * c, xy = a * b + c * d, yy = b * b + d * d;  // J J^T
    const double area = std::fabs(static_cast<double>(a) * d - static_cast<double>(b) * c);
    probe_detail::orthogonalise(a, b, c, d);
    CAPTURE(i);
    CHECK(std::fabs(a * c + b * d) <= 1e-6f);
    CHECK(std::fabs(a * a + c * c - xx) <= 1e-6);
    CHECK(std::fabs(a * b + c * d - xy) <= 1e-6);
    CHECK(std::fabs(b * b + d * d - yy) <= 1e-6);
    CHECK(std::fabs(std::fabs(static_cast<double>(a) * d - static_cast<double>(b) * c) - area) <=
          1e-6);
  }
}

TEST_CASE("Feline's weights come closer to the elliptical average than equal ones do") {
  std::mt19937 random(9);
  image<double> in(64, 64, 1);
  for (double& t : in.texels) t = static_cast<double>(random() >> 8) * 0x1p-24;
  const auto chain = mip_chain(in, mip_filter::box, [](std::span<double>) {});
  sampler_state state;
  state.u = state.v = address::repeat;
  state.mips = mip_selection::linear;
  state.max_anisotropy = 16;
  const auto error = [&](anisotropy_rule rule) {
    filter_model m;
    m.anisotropy = rule;
    std::mt19937 places(21);
    double sum = 0;
    for (int i = 0; i < 300; ++i) {
      const double u = static_cast<double>(places() >> 8) * 0x1p-24,
                   v = static_cast<double>(places() >> 8) * 0x1p-24;
      const gradients g = stretched(places, 12, 8);
      const double got = sample_gradients<double>(m, chain, u, v, g, state, 0);
      const double truth = ewa_reference(in, u, v, g, address::repeat, 0);
      sum += (got - truth) * (got - truth);
    }
    return std::sqrt(sum / 300);
  };
  const double weighted = error(anisotropy_rule::feline), equal = error(anisotropy_rule::ellipse);
  CAPTURE(weighted, equal);
  CHECK(weighted < equal);
}

TEST_CASE("every rule of probes keeps a constant and a ramp, as area integration does") {
  image<double> flat(64, 64, 1, 0.375), ramp(64, 64, 1);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) ramp.at(x, y) = (x + 0.5) / 64;
  const auto flats = mip_chain(flat, mip_filter::box, [](std::span<double>) {});
  const auto ramps = mip_chain(ramp, mip_filter::box, [](std::span<double>) {});
  sampler_state state;
  state.mips = mip_selection::linear;
  state.max_anisotropy = 16;
  std::mt19937 random(31);
  for (const auto rule : {anisotropy_rule::vulkan, anisotropy_rule::determinant,
                          anisotropy_rule::ellipse, anisotropy_rule::feline}) {
    filter_model m;
    m.anisotropy = rule;
    for (int i = 0; i < 100; ++i) {
      const gradients g = stretched(random, 6, 1 + i % 12);
      CAPTURE(static_cast<int>(rule), i);
      // Weights are binary32: 16 of them, each within 2^-25 of its own.
      CHECK(std::fabs(sample_gradients<double>(m, flats, 0.5, 0.5, g, state, 0) - 0.375) <=
            16 * 0x1p-25);
      // du, dv and the spacing are binary32 too.
      CHECK(std::fabs(sample_gradients<double>(m, ramps, 0.5, 0.5, g, state, 0) - 0.5) <= 0x1p-19);
      CHECK(std::fabs(area_mean(ramp, 0.5, 0.5, g, address::clamp, 0) - 0.5) <= 1e-12);
    }
  }
}
