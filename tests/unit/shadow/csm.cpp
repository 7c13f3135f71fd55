// Convolution shadow maps against the series, its coefficients by quadrature, and filtered planes.
#include "bitshade/shadow/csm.hpp"

#include <array>
#include <cmath>
#include <vector>

#include "bitshade/arithmetic/real.hpp"
#include "support/catch.hpp"

using namespace bitshade;

namespace {

constexpr long double pi = 3.141592653589793238462643383279502884L;

/// Composite Simpson's rule.
template <class F>
long double integral(F f, long double from, long double to, int halves = 20000) {
  const long double h = (to - from) / halves;
  long double sum = f(from) + f(to);
  for (int i = 1; i < halves; ++i) sum += (i % 2 == 0 ? 2 : 4) * f(from + i * h);
  return sum * h / 3;
}

/// The partial sum of the square wave of period 2 that is the depth test on (-1, 1).
long double partial_sum(int terms, long double x, long double t) {
  long double sum = 0.5L;
  for (int k = 1; k <= terms; ++k) {
    const long double c = (2 * k - 1) * pi;
    sum += 2 / c * std::sin(c * (x - t));
  }
  return sum;
}

csm_constants plain(int terms) {
  csm_constants c;
  c.terms = terms;
  c.gain = 1;
  c.biased = false;
  return c;
}

}  // namespace

TEST_CASE("half_turns stays within its bound; multiples of a quarter turn are exact") {
  double worst = 0, at = 0;
  for (int i = -40000; i <= 40000; ++i) {
    const double y = i / 313.0;
    const auto got = half_turns(y);
    const long double reduced = std::remainder(static_cast<long double>(y), 2.0L) * pi;
    const double error = static_cast<double>(std::max(std::fabs(got.cosine - std::cos(reduced)),
                                                      std::fabs(got.sine - std::sin(reduced))));
    if (error * 0x1p53 > worst) worst = error * 0x1p53, at = y;
  }
  CAPTURE(worst, at);
  CHECK(worst <= half_turns_error);
  for (int n = -9; n <= 9; ++n) {
    CHECK(half_turns(n / 2.0).sine == std::array{0, 1, 0, -1}[static_cast<std::size_t>(n & 3)]);
    CHECK(half_turns(n / 2.0).cosine == std::array{1, 0, -1, 0}[static_cast<std::size_t>(n & 3)]);
  }
  CHECK(inverse_half_turns(1.0, 1) == Approx(static_cast<double>(1 / pi)).epsilon(1e-16));
  for (int n = 1; n < 200; ++n) {
    const long double truth = 1 / (pi * n);
    CHECK(std::fabs((inverse_half_turns(1.0, n) - truth) / truth) <= 0x1p-53L * 1.5L);
  }
}

TEST_CASE("the coefficients are the depth test's Fourier integrals") {
  // Odd square wave of period 2: coefficient of sin(n pi y) is 2 int_0^1 sin(n pi y) dy, half of it
  // for a step from 0 to 1.
  for (int k = 1; k <= 16; ++k) {
    const int n = 2 * k - 1;
    // Simpson's rule errs by (n pi h)^4 / 180 of the integral's size, n pi / 2 times itself here.
    const double simpson = 1e-14 + std::pow(3.15 * n / 20000, 4) / 180 * 3.15 * n / 2;
    const long double by_quadrature =
        integral([&](long double y) { return std::sin(n * pi * y); }, 0, 1);
    CHECK(2 * inverse_half_turns(1.0, n) ==
          Approx(static_cast<double>(by_quadrature)).epsilon(simpson));
    const long double even =
        integral([&](long double y) { return std::sin((n + 1) * pi * y); }, 0, 1);
    CHECK(std::fabs(even) < 1e-12L);  // even multiples do not appear
  }
}

TEST_CASE("CSM of one texel is the partial sum, biased or not") {
  for (const int terms : {1, 4, 16, 64})
    for (const float x : {0.0f, 0.125f, 0.3f, 0.9f, 1.0f})
      for (const double t : {0.0, 0.2, 0.31, 0.5, 1.0}) {
        csm_constants c = plain(terms);
        const auto truth = static_cast<double>(partial_sum(terms, x, t));
        const double clamped = std::min(1.0, std::max(0.0, truth));
        for (const bool biased : {false, true}) {
          c.biased = biased;
          std::vector<double> texel(c.channels());
          csm_texel<double>(x, c, texel);
          CAPTURE(terms, x, t, biased);
          CHECK(std::fabs(csm_visibility<double>(texel, t, c) - clamped) <= 1e-14 * terms);
        }
        std::vector<double> texel(c.channels());
        csm_texel<double>(x, c, texel);
        for (const double v : texel) CHECK((v >= 0 && v <= 1));
      }
}

TEST_CASE("CSM of a filtered slanted plane is the integral of the series over it") {
  const csm_constants c = plain(8);
  const double from = 0.35, to = 0.6;
  for (const double t : {0.2, 0.4, 0.5, 0.8}) {
    std::vector<double> filtered(c.channels());
    for (std::size_t i = 0; i < filtered.size(); ++i) {
      const long double rate = static_cast<long double>(2 * (i / 2) + 1) * pi;
      filtered[i] = static_cast<double>(
          integral(
              [&](long double z) { return i % 2 == 0 ? std::cos(rate * z) : std::sin(rate * z); },
              from, to) /
          (to - from));
    }
    const long double truth =
        integral([&](long double z) { return partial_sum(c.terms, z, t); }, from, to) / (to - from);
    CAPTURE(t);
    const auto clamped = static_cast<double>(std::min(1.0L, std::max(0.0L, truth)));
    CHECK(csm_visibility<double>(filtered, t, c) == Approx(clamped).margin(1e-12));
  }
}

TEST_CASE("more terms approach percentage-closer filtering of two planes") {
  // alpha of the filter sees 0.2, the rest 0.7; the truth at t = 0.45 is 1 - alpha.
  const double alpha = 0.375, t = 0.45;
  double before = 1;
  for (const int terms : {2, 8, 32}) {
    const csm_constants c = plain(terms);
    std::vector<double> near(c.channels()), far(c.channels());
    csm_texel<double>(0.2, c, near);
    csm_texel<double>(0.7, c, far);
    for (std::size_t i = 0; i < near.size(); ++i) near[i] = alpha * near[i] + (1 - alpha) * far[i];
    const double error = std::fabs(csm_visibility<double>(near, t, c) - (1 - alpha));
    CAPTURE(terms, error);
    // The tail of the series beyond M terms at distance d: below 1 / (pi M sin(pi d)).
    CHECK(error <= 1 / (3.14159 * terms * std::sin(3.14159 * 0.25)));
    CHECK(error < before);
    before = error;
  }
}

TEST_CASE("gain lights what touches the receiver; damping shrinks the ringing") {
  csm_constants c = plain(4);
  std::vector<double> texel(c.channels());
  csm_texel<double>(0.5, c, texel);
  CHECK(csm_visibility<double>(texel, 0.5, c) == Approx(0.5));
  c.gain = 2;
  CHECK(csm_visibility<double>(texel, 0.5, c) == Approx(1));
  c.gain = 1;
  c.offset = 0.125;
  CHECK(csm_visibility<double>(texel, 0.5, c) > 0.9);
  c.offset = 0;
  c.gain = 0.5;  // so that values above 1 are seen
  const auto overshoot = [&](double damping) {
    c.damping = damping;
    double most = 0;
    for (int i = 0; i < 500; ++i) {
      most = std::max(most, 2 * csm_visibility<double>(texel, i / 1000.0, c) - 1);
    }
    return most;
  };
  // Gibbs: Si(pi)/pi - 1/2 = 0.0895 in the limit of many terms, a little more with few.
  CHECK(overshoot(0) == Approx(0.0895).epsilon(0.05));
  CHECK(overshoot(1.5) < 0.01);
}

TEST_CASE(
    "CSM rows equal texels, in every arithmetic; 8-bit storage costs what its step predicts") {
  using half = real<binary16>;
  const csm_constants c = csm_constants_for(4, unorm8::value);
  CHECK(c.biased);
  CHECK_FALSE(csm_constants_for(4, binary16::value).biased);
  CHECK_FALSE(csm_constants_for(4, snorm16::value).biased);
  std::vector<float> depth;
  for (int i = 0; i < 301; ++i) depth.push_back(static_cast<float>(i) / 300);
  std::vector<float> row(depth.size() * c.channels());
  std::vector<half> row16(row.size());
  csm_row<float>(depth, c, row);
  csm_row<half>(depth, c, row16);
  csm_constants linear = c;
  linear.gain = 1;
  for (std::size_t i = 0; i < depth.size(); ++i) {
    std::vector<float> texel(c.channels());
    csm_texel<float>(depth[i], c, texel);
    std::vector<double> exact(c.channels()), stored(c.channels());
    csm_texel<double>(depth[i], c, exact);
    double allowed = 1e-13;
    for (std::size_t k = 0; k < texel.size(); ++k) {
      REQUIRE(row[i * c.channels() + k] == texel[k]);
      stored[k] = round_to(unorm8::value, exact[k]);
      // |error| <= q of the unbiased term, times 2/c_k and |cos| + |sin| <= sqrt 2 of a pair.
      allowed += 2 / (3.14159 * (2 * (k / 2) + 1)) * (1.0 / 255) * 0.70711;
    }
    for (const double t : {0.3, 0.55}) {
      const double change =
          csm_visibility<double>(stored, t, linear) - csm_visibility<double>(exact, t, linear);
      CAPTURE(i, t);
      REQUIRE(std::fabs(change) <= allowed * 1.0001);
    }
  }
}
