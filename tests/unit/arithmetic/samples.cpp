#include "bitshade/arithmetic/samples.hpp"

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
