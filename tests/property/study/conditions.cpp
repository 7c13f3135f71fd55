// Floors, thin layers, overlaps, tables and mip chains: the conditions of study/, each at its edge.
#include <cmath>
#include <random>

#include "bitshade/interop/rational.hpp"
#include "bitshade/shadow/evsm.hpp"
#include "bitshade/study/bounds_visibility.hpp"
#include "bitshade/texture/mip.hpp"
#include "bitshade/texture/sat.hpp"
#include "precision/store.hpp"
#include "support/catch.hpp"

using namespace bitshade;

TEST_CASE("a floor that keeps eps keeps it, and any lower one is broken") {
  const rational eps(1, 255), noise(1, 1 << 20);
  // The worst case of section 6: stored at the floor, true one noise above, d^2 = sqrt(v v').
  const auto error = [&](const rational& floor) {
    const auto f = static_cast<double>(floor), v = static_cast<double>(floor + noise);
    const rational d(std::sqrt(std::sqrt(f * v)));
    const auto light = [&](const rational& x) { return rational(x / (x + d * d)); };
    return rational(light(floor + noise) - light(floor));
  };
  const rational floor = floor_for(noise, eps);
  CHECK(error(floor) <= eps);
  CHECK(error(floor * 999 / 1000) > eps);
}

TEST_CASE("layers and overlaps of the narrowest width let eps through, narrower ones more") {
  const double eps = 1.0 / 255;
  for (const double deviation : {0.03, 0.01, 0.001}) {
    const rational floor = rational(deviation) * rational(deviation);
    const rational w(narrowest_layer(deviation, eps));
    CHECK(floor_residue(floor, w) <= rational(eps));
    CHECK(floor_residue(floor, rational(w * 999 / 1000)) > rational(eps));
    CHECK(least_overlap(16, 0.001, deviation, eps) >= narrowest_layer(deviation, eps));
    CHECK(least_overlap(16, 1, deviation, eps) == 16);
  }
}

TEST_CASE("two occluders let through exactly what equation (4) says") {
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i) {
    const auto some = [&] { return rational(1 + static_cast<int>(random() % 255), 256); };
    const rational alpha = some(), a = some() / 4, dx = some() / 4, dy = some() / 4;
    const rational b = a + dx, t = b + dy;
    const rational m1 = alpha * a + (1 - alpha) * b;
    const rational v = alpha * a * a + (1 - alpha) * b * b - m1 * m1;
    CHECK(v / (v + (t - m1) * (t - m1)) == two_occluder_bleeding(alpha, dx, dy));
  }
}

TEST_CASE("summed-area tables of codes lose nothing with the extra bits, and wrap with one fewer") {
  const int width = 12, height = 5, bits = 8;
  const int extra = summed_area_extra_bits(width, height);
  const std::uint64_t most = std::uint64_t{width} * height * 255;
  CHECK(most < (std::uint64_t{1} << (bits + extra)));
  // A power of two of texels leaves no bit to spare.
  CHECK((std::uint64_t{16} * 8 * 255 >> (bits + summed_area_extra_bits(16, 8) - 1)) == 1);
  // A wrapped table still gives every box whose own sum fits: 256 x 256 codes of 255 in 16 bits.
  image<std::uint16_t> codes(64, 64, 1, 255);
  const auto sums = make_sat(std::move(codes), sat_order::running, sat_offset::none,
                             [](std::span<std::uint16_t>) {});
  CHECK(box_sum(sums, 40, 40, 55, 55, 0) == 16 * 16 * 255);
}

TEST_CASE("a mip chain rounds once a level: to nearest both ways, cut always down") {
  std::mt19937 random(5);
  const double steps = 255;
  const auto worst = [&](bool nearest) {
    double low = 0, high = 0;
    for (int n = 0; n < 200; ++n) {
      image<double> base(8, 8, 1);
      double mean = 0;
      for (double& x : base.texels) {
        x = static_cast<double>(random() % 256) / steps;
        mean += x / 64;
      }
      const auto chain = mip_chain(base, mip_filter::box, [&](std::span<double> row) {
        for (double& x : row) {
          const double code = x * steps;
          x = (nearest ? std::nearbyint(code) : std::floor(code + 0x1p-30)) / steps;
        }
      });
      const double error = (chain.back().at(0, 0) - mean) * steps;
      low = std::min(low, error);
      high = std::max(high, error);
    }
    return std::pair{low, high};
  };
  const auto [down, up] = worst(true);
  CHECK(down >= -3 * 0.5);
  CHECK(up <= 3 * 0.5);
  CHECK(down < -0.3);
  CHECK(up > 0.3);
  const auto [cut, none] = worst(false);
  CHECK(cut >= -3 * 1.0);
  CHECK(cut < -1.0);
  CHECK(none <= 0x1p-20);
}

TEST_CASE("exponents at their cap stay finite when squared and summed, beyond it they do not") {
  for (const auto& [format, roundings] : {std::pair{binary16::value, 3}, {binary32::value, 3}}) {
    const double cap = exponent_cap(format, 2, roundings), largest = largest_of(format);
    const auto squared = [&](double c) {
      const double w = round_to(format, std::exp(c));
      return round_to(format, w * w);
    };
    CHECK(squared(cap) <= largest);
    CHECK(squared(cap * 1.01) > largest);
  }
  CHECK(exponent_cap(binary16::value) == Approx(5.54).margin(0.01));
  CHECK(exponent_cap(binary32::value) == Approx(44.36).margin(0.01));
  CHECK(negative_exponent_turns_subnormal(binary16::value) == Approx(4.852).margin(0.001));
}
