// EVSM and ESM against closed forms, quadrature and their own caps.
#include <array>
#include <cmath>
#include <vector>

#include "bitshade/arithmetic/real.hpp"
#include "bitshade/shadow/esm.hpp"
#include "bitshade/shadow/evsm.hpp"
#include "support/catch.hpp"

using namespace bitshade;

namespace {

/// (4) with coverage alpha of the nearer occluder, in any monotonic warp's units.
double two_occluders(double alpha, double a, double b, double c) {
  const double spread = alpha * (1 - alpha) * (b - a) * (b - a);
  const double d = (c - b) + alpha * (b - a);
  return spread / (spread + d * d);
}

/// Composite Simpson's rule.
template <class F>
double integral(F f, double from, double to, int halves = 4096) {
  const double h = (to - from) / halves;
  double sum = f(from) + f(to);
  for (int i = 1; i < halves; ++i) sum += (i % 2 == 0 ? 2 : 4) * f(from + i * h);
  return sum * h / 3;
}

}  // namespace

TEST_CASE("exp_of_double stays within its bound and knows its ends") {
  double worst = 0, at = 0;
  for (int i = -70000; i <= 70000; ++i) {
    const double x = i / 100.0 + (std::abs(i) < 70000 ? 1e-3 * std::sin(i) : 0);
    const auto truth = std::exp(static_cast<long double>(x));
    const auto error = static_cast<double>(std::fabs((exp_of_double(x) - truth) / truth)) * 0x1p53;
    if (error > worst) worst = error, at = x;
  }
  CAPTURE(worst, at);
  CHECK(worst <= exp_of_double_error);
  CHECK(exp_of_double(0) == 1);
  CHECK(exp_of_double(-0.0) == 1);
  CHECK(exp_of_double(-701) == 0);
  CHECK(std::isinf(exp_of_double(701)));
  CHECK(std::isinf(exp_of_double(INFINITY)));
  CHECK(exp_of_double(-INFINITY) == 0);
  CHECK(std::isnan(exp_of_double(NAN)));
}

TEST_CASE("EVSM of two planes is equation (4) in warped depth, for both warps") {
  for (const double c : {1.0, 5.0, 20.0, 40.0})
    for (const double alpha : {0.125, 0.5, 0.75})
      for (const auto& [a, b, t] :
           {std::array{0.2, 0.5, 0.8}, std::array{0.05, 0.06, 0.065}, std::array{0.6, 0.9, 1.0}}) {
        const evsm_constants k{c, c / 2, 0};
        const auto warped = [&](auto w, auto bound) {
          const double m1 = alpha * w(a) + (1 - alpha) * w(b);
          const double m2 = alpha * w(a) * w(a) + (1 - alpha) * w(b) * w(b);
          return bound(m1, m2);
        };
        const double positive =
            warped([&](double x) { return positive_warp(x, k); },
                   [&](double m1, double m2) { return evsm_positive_bound(m1, m2, t, k, 0.0); });
        const double negative =
            warped([&](double x) { return negative_warp(x, k); },
                   [&](double m1, double m2) { return evsm_negative_bound(m1, m2, t, k, 0.0); });
        const auto w = [&](double x) { return std::exp(k.positive * x); };
        const auto v = [&](double x) { return -std::exp(-k.negative * x); };
        CAPTURE(c, alpha, a, b, t);
        // M2 - M1^2 loses 3u (M2 / variance); p moves by at most a quarter of that, (t - mu)
        // likewise.
        const double spread = alpha * (1 - alpha) * std::pow(v(b) - v(a), 2);
        const double lost = 1e-15 * (v(a) * v(a) / spread);
        CHECK(positive == Approx(two_occluders(alpha, w(a), w(b), w(t))).epsilon(1e-10));
        CHECK(std::fabs(negative - two_occluders(alpha, v(a), v(b), v(t))) <= 1e-13 + lost);
        CHECK(evsm_bound(positive, negative) == std::min(positive, negative));
        CHECK(evsm_bound(positive, negative) + 1e-12 >= 0);
      }
}

TEST_CASE("EVSM of a half-covered receiver is exact: one occluder, one receiver") {
  // x = t for the uncovered share: then both bounds are that share.
  for (const double c : {0.5, 4.0, 30.0})
    for (const double covered : {0.0625, 0.5, 0.9375}) {
      const evsm_constants k{c, c, 1};
      const double a = 0.25, t = 0.75;
      const auto mix = [&](double near, double far) {
        return covered * near + (1 - covered) * far;
      };
      const double wa = positive_warp(a, k), wt = positive_warp(t, k);
      const double va = negative_warp(a, k), vt = negative_warp(t, k);
      CAPTURE(c, covered);
      CHECK(evsm_positive_bound(mix(wa, wt), mix(wa * wa, wt * wt), t, k, 0.0) ==
            Approx(1 - covered).epsilon(1e-12));
      CHECK(evsm_negative_bound(mix(va, vt), mix(va * va, vt * vt), t, k, 0.0) ==
            Approx(1 - covered).epsilon(1e-12));
    }
}

TEST_CASE("a shift changes no bit of meaning: w+ and its floor scale together") {
  const evsm_constants plain{6, 6, 0}, shifted{6, 6, 1};
  for (const double t : {0.3, 0.55, 0.9}) {
    const auto p = [&](const evsm_constants& k) {
      const double a = positive_warp(0.25, k), b = positive_warp(0.5, k);
      return evsm_positive_bound((a + b) / 2, (a * a + b * b) / 2, t, k, 1e-3);
    };
    CHECK(p(plain) == Approx(p(shifted)).epsilon(1e-13));
  }
}

TEST_CASE("a filtered slanted plane has the moments of the integral, and its bound with them") {
  const evsm_constants k{8, 5, 0};
  const double from = 0.3, to = 0.7, t = 0.68;
  const int texels = 20000;
  std::array<double, 4> sums{};
  for (int i = 0; i < texels; ++i) {
    const double x = from + (to - from) * (i + 0.5) / texels;
    const double w = positive_warp(x, k), v = negative_warp(x, k);
    sums[0] += w, sums[1] += w * w, sums[2] += v, sums[3] += v * v;
  }
  const auto mean = [&](double rate) {
    return integral([&](double x) { return std::exp(rate * x); }, from, to) / (to - from);
  };
  const std::array<double, 4> truth{mean(8), mean(16), mean(-5), mean(-10)};
  for (std::size_t i = 0; i < 4; ++i) {
    // The midpoint rule errs by (b - a)^2 f'' / (24 n^2): below 1e-8 relative here.
    CHECK(sums[i] / texels == Approx(truth[i]).epsilon(1e-8));
  }
  const double p = evsm_positive_bound(sums[0] / texels, sums[1] / texels, t, k, 0.0);
  const double d = std::exp(8 * t) - truth[0], variance = truth[1] - truth[0] * truth[0];
  CHECK(p == Approx(variance / (variance + d * d)).epsilon(1e-6));
}

TEST_CASE("exponent caps follow from the formats") {
  CHECK(exponent_cap(binary16::value, 2, 0) == Approx(std::log(65504.0) / 2).epsilon(1e-11));
  CHECK(exponent_cap(binary16::value) > 5.54);
  CHECK(exponent_cap(binary16::value) < 5.55);
  CHECK(exponent_cap(binary32::value) > 44.3);
  CHECK(exponent_cap(binary32::value) < 44.37);
  CHECK(exponent_cap(binary32::value, 1) == Approx(88.72).epsilon(1e-4));
  CHECK(exponent_cap(bfloat16::value) < exponent_cap(binary32::value));
  CHECK(exponent_cap(unorm16::value) == 700);
  CHECK(negative_exponent_turns_subnormal(binary16::value) == Approx(4.852).epsilon(1e-3));
  CHECK_THROWS_AS(check_exponent(5.55, binary16::value, "half"), std::invalid_argument);
  CHECK_THROWS_AS(check_exponent(0, binary16::value, "half"), std::invalid_argument);
  CHECK_THROWS_AS(check_exponent(NAN, binary16::value, "half"), std::invalid_argument);
  CHECK_NOTHROW(check_exponent(11, binary16::value, "half", 1));
  CHECK(evsm_constants_for(30, 9, unorm16::value, "unorm16").shift == 1);
  CHECK(evsm_constants_for(30, 9, binary32::value, "binary32").shift == 0);
}

TEST_CASE("the noise of a stored pair covers what rounding did to its variance") {
  const encoding formats[] = {binary16::value, bfloat16::value, binary32::value, unorm16::value,
                              unorm8::value};
  for (const encoding& e : formats) {
    const double shift = ends_at_one(e) ? 1 : 0;
    const evsm_constants k{5, 5, shift};
    double worst = 0;
    for (int i = 0; i <= 4000; ++i) {
      const double w = positive_warp(i / 4000.0, k);
      const double m1 = round_to(e, w), m2 = round_to(e, w * w);
      const long double feigned = static_cast<long double>(m2) - static_cast<long double>(m1) * m1;
      // exp and the square err by a few u of binary64 as well.
      const double allowed = warped_noise(e, w) + 8 * w * w * 0x1p-53;
      worst = std::max(worst, static_cast<double>(std::fabs(feigned)) / allowed);
      REQUIRE(std::fabs(feigned) <= allowed);
    }
    CAPTURE(worst);
    CHECK(worst > 0.5);  // a bound, and no loose one
  }
}

TEST_CASE("ESM: Markov's bound, exact for what is all lit or far behind") {
  const esm_constants k{30, 0};
  for (const double t : {0.1, 0.5, 1.0}) {
    CHECK(esm_visibility(esm_warp(t, k), t, k) == Approx(1).epsilon(1e-13));
    for (const double x : {0.05, 0.3, 0.9}) {
      const double p = esm_visibility(esm_warp(x, k), t, k);
      CHECK(p == Approx(x >= t ? 1 : std::exp(-30 * (t - x))).epsilon(1e-13));
    }
  }
  const double half_covered = (esm_warp(0.2, k) + esm_warp(0.8, k)) / 2;
  CHECK(esm_visibility(half_covered, 0.8, k) == Approx(0.5 + 0.5 * std::exp(-18.0)).epsilon(1e-12));
  CHECK_THROWS_AS(esm_constants_for(89, binary32::value, "binary32"), std::invalid_argument);
  CHECK(esm_constants_for(88, binary32::value, "binary32").shift == 0);
}

TEST_CASE("rows equal the definition bit for bit, in float and in double") {
  std::vector<float> depth;
  for (int i = 0; i < 1003; ++i) depth.push_back(static_cast<float>(i) / 1000 - 0.001f);
  const evsm_constants k{7, 3, 0};
  std::vector<float> out(depth.size() * 4);
  positive_warp_row<float>(depth, k, out, 4);
  negative_warp_row<float>(depth, k, out, 4);
  std::vector<double> wide(depth.size());
  esm_row<double>(depth, {7, 0}, wide);
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const float x = clamp_depth(depth[i]);
    REQUIRE(out[4 * i] == positive_warp(x, k));
    REQUIRE(out[4 * i + 2] == negative_warp(x, k));
    REQUIRE(wide[i] == esm_warp(static_cast<double>(x), {7, 0}));
  }
}
