#include "bitshade/arithmetic/samples_math.hpp"

#include <cmath>
#include <compare>

#include "support/catch.hpp"

using namespace bitshade;

TEST_CASE("samples are equal where their means are, so that exactly one of <, == and > holds") {
  using half = samples<binary16, 4>;
  CHECK(half(3) == half(3, 7));
  CHECK(half(3) != half(2));
  // As many samples up as down give the same mean, whichever they are.
  int equal = 0;
  for (std::uint64_t i = 0; i < 20; ++i) {
    for (std::uint64_t j = 0; j < 20; ++j) {
      const half x(0.1, i), y(0.1, j);
      CHECK((x < y) + (x == y) + (y < x) == 1);
      CHECK((x <= y) == !(y < x));
      equal += i != j && x == y;
    }
  }
  CHECK(equal > 20);
}

TEST_CASE("samples that differ by their roundings alone are indistinguishable") {
  using single = samples<binary32, 16>;
  const single a(0.1, 1), b(0.3, 2);
  CHECK(indistinguishable(a + b - b, a));
  CHECK_FALSE(indistinguishable(a, b));
  CHECK_FALSE(indistinguishable(single(1), single(1 + 0x1p-23)));
}

TEST_CASE("samples end in a number, their mean, and order by it") {
  using sampled = samples<binary16>;
  CHECK(static_cast<float>(sampled(1.5)) == 1.5f);
  CHECK(std::is_lt(sampled(1) <=> sampled(2)));
}

TEST_CASE("fma rounds each sample once") {
  using half = samples<binary16, 64>;
  CHECK(fma(half(2), half(3), half(1)) == half(7));
  // 1 + 2^-11 + 2^-21 lies just beyond the middle of two numbers: both occur, and nothing else.
  const half r = fma(half(1 + 0x1p-10), half(0x1p-11), half(1));
  int up = 0;
  for (std::size_t i = 0; i < 64; ++i) {
    CHECK((r.sample(i) == 1 || r.sample(i) == 1 + 0x1p-10));
    up += r.sample(i) != 1;
  }
  CHECK((up > 12 && up < 52));  // 32 +- 5 standard deviations
  CHECK(abs(half(-2)) == half(2));
}

TEST_CASE("functions of samples round each sample's exact value up or down, without bias") {
  using half = samples<binary16, 4096>;
  const auto check = [](const char* name, const half& got, double exact) {
    CAPTURE(name, exact);
    const double below = round_to(binary16::value, exact, {rounding::down});
    const double above = round_to(binary16::value, exact, {rounding::up});
    int outside = 0;
    for (std::size_t i = 0; i < 4096; ++i) outside += got.sample(i) != below && got.sample(i) != above;
    CHECK(outside == 0);
    // The mean of 4096 has a standard deviation of at most 1/128 of the step between both; six of them.
    CHECK(std::fabs(got.mean() - exact) <= (above - below) * 6 / 128);
  };
  const half x(0.75), y(1.25, 1);
  check("exp", exp(x), std::exp(0.75));
  check("log", log(y), std::log(1.25));
  check("sin", sin(x), std::sin(0.75));
  check("atanh", atanh(x), std::atanh(0.75));
  check("pow", pow(x, y), std::pow(0.75, 1.25));
  check("atan2", atan2(x, y), std::atan2(0.75, 1.25));
  CHECK(floor(-y) == half(-2));
  CHECK(round(half(2.5)) == half(3));
  CHECK(exp(x) == exp(half(0.75)));  // the same expression draws the same bits
}

TEST_CASE("a cancelled exponential loses digits, and samples tell how many") {
  using single = samples<binary32, 64>;
  const single x(0x1p-12);
  // exp(x) - 1 keeps x's 24 bits less the 12 that the 1 pushes out; expm1 keeps all.
  CHECK(std::fabs((exp(x) - single(1)).significant_bits() - 12) < 2);
  CHECK(expm1(x).significant_bits() > 22);
}
