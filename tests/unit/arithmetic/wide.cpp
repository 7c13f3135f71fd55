#include "bitshade/arithmetic/wide.hpp"

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <random>

#include "support/catch.hpp"

using namespace bitshade;
using boost::multiprecision::cpp_int;

namespace {

template <std::size_t N>
cpp_int big(const wide<N>& a) {
  cpp_int value = 0;
  for (std::size_t i = N; i-- > 0;) value = (value << 64) + a.limb[i];
  return value;
}

template <std::size_t N>
wide<N> random_wide(std::mt19937_64& random) {
  wide<N> a;
  const auto used = random() % (64 * N) + 1;
  for (std::size_t i = 0; i < N; ++i) {
    if (64 * i < used) a.limb[i] = random();
    if (64 * (i + 1) > used && 64 * i < used) a.limb[i] >>= 64 * (i + 1) - used;
  }
  // Runs of equal bits find carries that random bits never make.
  if (random() % 4 == 0) {
    for (auto& limb : a.limb)
      limb = limb != 0 && random() % 2 ? ~std::uint64_t{0} >> (random() % 64) : limb;
  }
  return a;
}

/// An independent rounding: the quotient's integer part at 2^-200, halved by comparison.
double rounded(const cpp_int& num, const cpp_int& den) {
  if (num == 0) return 0;
  int k = 0;
  cpp_int n = num, d = den;
  while (n < (d << 52)) n <<= 1, ++k;
  while (n >= (d << 53)) d <<= 1, --k;
  cpp_int q = n / d;
  const cpp_int twice = (n - q * d) * 2;
  if (twice > d || (twice == d && (q & 1) != 0)) ++q;
  return std::ldexp(q.convert_to<double>(), -k);
}

}  // namespace

TEST_CASE("wide integers add, subtract, multiply, shift and compare as integers do") {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20000; ++i) {
    auto a = random_wide<5>(random), b = random_wide<5>(random);
    if (a < b) std::swap(a, b);
    const cpp_int x = big(a), y = big(b), modulus = cpp_int(1) << 320;
    REQUIRE((a < b) == (x < y));
    REQUIRE(big(a - b) == x - y);
    REQUIRE(big(a + b) == (x + y) % modulus);
    REQUIRE(big(a * b) == x * y);
    const int shift = static_cast<int>(random() % 320);
    REQUIRE(big(a << shift) == (x << shift) % modulus);
    REQUIRE(big(a >> shift) == x >> shift);
    REQUIRE(a.bit_length() == (x == 0 ? 0 : static_cast<int>(msb(x)) + 1));
  }
}

TEST_CASE("quotients of wide integers are rounded once") {
  std::mt19937_64 random(2);
  for (int i = 0; i < 50000; ++i) {
    const auto num = random_wide<5>(random);
    const auto den = random_wide<5>(random);
    if (den == wide<5>{}) continue;
    const double got = quotient_to_double(num, den), expected = rounded(big(num), big(den));
    CAPTURE(i, got, expected);
    REQUIRE(got == expected);
  }
}

TEST_CASE("quotients at and beside the middle of two doubles are rounded once") {
  std::mt19937_64 random(3);
  for (int i = 0; i < 20000; ++i) {
    const std::uint64_t den = random() >> (random() % 60);
    if (den == 0) continue;
    const std::uint64_t middle = ((random() >> 11) | (std::uint64_t{1} << 52)) * 2 + 1;
    wide<4> num = narrowed<4>(wide<2>(middle) * wide<2>(den));
    const auto offset = random() % 3;
    if (offset == 0) num -= wide<4>(std::uint64_t{1});
    if (offset == 2) num += wide<4>(std::uint64_t{1});
    const double got = quotient_to_double(num, wide<4>(den));
    const double expected = rounded(big(num), cpp_int(den));
    CAPTURE(i, got, expected, offset);
    REQUIRE(got == expected);
  }
}
