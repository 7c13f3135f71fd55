// The hard cases of storage and rounding, by their numbers in the stability suite.
#include <xmmintrin.h>

#include <cfenv>
#include <clocale>
#include <cmath>

#include "bitshade/arithmetic/environment.hpp"
#include "bitshade/arithmetic/real_limits.hpp"
#include "bitshade/arithmetic/real_math.hpp"
#include "bitshade/formats/hexadecimal.hpp"
#include "bitshade/formats/random.hpp"
#include "bitshade/formats/round_to.hpp"
#include "bitshade/formats/text.hpp"
#include "support/catch.hpp"
#include "support/operation_oracle.hpp"

using namespace bitshade;
using half = real<binary16>;

TEST_CASE("hard case 18: squares of small depths in half are subnormal below 2^-7, and 0 below 2^-12.5") {
  rules flush;
  flush.subnormal = subnormals::flush_output;
  const auto square = [](double x, const rules& r) { return encode(binary16::value, x * x, r); };
  CHECK(square(0x1p-7, {}) == min_normal_bits(binary16::value));
  CHECK(square(0x1.ff8p-8, {}) < min_normal_bits(binary16::value));
  CHECK(square(0x1.ff8p-8, flush) == 0);
  CHECK(square(0x1p-7, flush) != 0);
  // 2^-25 is a tie between 0 and the smallest number, and 0 is even: x = 2^-12.5 is the border.
  CHECK(encode(binary16::value, 0x1p-25) == 0);
  CHECK(square(0x1.6a1p-13, {}) == 1);
  CHECK(square(0x1.6ap-13, {}) == 0);
}

TEST_CASE("hard case 19: unorm16 holds x^2 of 2^-8 in one code, and of 181/65535 in none") {
  const auto square = [](double x) { return encode(unorm16::value, x * x); };
  CHECK(square(0x1p-8) == 1);
  CHECK(square(181.0 / 65535) == 0);
  CHECK(square(182.0 / 65535) == 1);
  for (int c = 0; c <= 181; ++c) CHECK(square(c / 65535.0) == 0);
}

TEST_CASE("hard case 20: truncating a store is biased, rounding to nearest is not") {
  double bias[2] = {0, 0};
  constexpr int n = 200000;
  for (std::uint64_t i = 0; i < n; ++i) {
    const double x = static_cast<double>(random_bits(20, i) >> 11) * 0x1p-53;
    bias[0] += round_to(unorm16::value, x) - x;
    bias[1] += round_to(unorm16::value, x, rules{rounding::toward_zero}) - x;
  }
  // In steps: nearest 0 +- 0.29/sqrt(n), truncated -1/2. Five standard deviations are 0.0033.
  CHECK(std::abs(bias[0] / n * 65535) < 0.0033);
  CHECK(std::abs(bias[1] / n * 65535 + 0.5) < 0.0033);
}

TEST_CASE("hard case 38: nothing is rounded twice, by fma or in formats wider than half the carrier") {
  // a b + c lies 2^-40 above a tie of half: by way of float the last bit goes missing and the tie wins.
  const half a(1 + 0x1p-10), b(0x1p-11), c(1);
  const float wrong = static_cast<float>(static_cast<double>(a) * static_cast<double>(b) + 1.0);
  CHECK(fma(a, b, c).bits() == 0x3c01);
  CHECK(wrong == 1.0f + 0x1p-11f + 0x1p-21f);
  const half tiny(0x1p-24), one(1 + 0x1p-10), odd(0x1.554p-1);
  oracle::calculator truth(binary16::value);
  truth.compute(oracle::operation::fma, odd.bits(), tiny.bits(), one.bits());
  CHECK(fma(odd, tiny, one).bits() == truth.bits({}));
  // binary<11, 30> has the carrier's exponents and more than half of its bits.
  using wide = binary<11, 30>;
  oracle::calculator wide_truth(wide::value);
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const std::uint64_t x = random_bits(1, i) & low_bits(42), y = random_bits(2, i) & low_bits(42);
    wide_truth.compute(oracle::operation::divide, x, y);
    const auto got = (real<wide>::from_bits(x) / real<wide>::from_bits(y)).bits();
    INFO(oracle::hex(x) << " / " << oracle::hex(y) << ": got " << oracle::hex(got));
    CHECK(got == wide_truth.bits({}));
  }
}

TEST_CASE("hard case 39: signed zeros, the ends of subnormals, and the largest number and half a step") {
  CHECK(encode(binary16::value, -0.0) == 0x8000);
  CHECK((half(1) - half(1)).bits() == 0);
  CHECK((half(-0.0) + half(-0.0)).bits() == 0x8000);
  CHECK((half(-0.0) * half(3)).bits() == 0x8000);
  CHECK(sqrt(half(-0.0)).bits() == 0x8000);
  CHECK(encode(binary16::value, 0x1.ff8p-15) == 0x03ff);
  CHECK(encode(binary16::value, 0x1.ffcp-15) == 0x0400);
  CHECK(encode(binary16::value, std::nextafter(0x1.ffcp-15, 0)) == 0x03ff);
  CHECK(encode(binary16::value, std::nextafter(65520.0, 0)) == 0x7bff);
  CHECK(encode(binary16::value, 65520) == 0x7c00);
  rules saturate, to_zero;
  saturate.overflow = overflow::saturate;
  to_zero.direction = rounding::toward_zero;
  CHECK(encode(binary16::value, -1e9, saturate) == 0xfbff);
  CHECK(encode(binary16::value, -1e9, to_zero) == 0xfbff);
  CHECK(encode(fp8_e4m3::value, 464) == 0x7e);
  CHECK(encode(fp8_e4m3::value, std::nextafter(464.0, 500.0)) == 0x7f);
}

TEST_CASE("hard case 40: snorm has two codes for -1; unorm holds 0 and 1 but not one half") {
  CHECK(decode(snorm16::value, 0x8000) == -1);
  CHECK(decode(snorm16::value, 0x8001) == -1);
  CHECK(encode(snorm16::value, -1) == 0x8001);
  for (int n = 1; n <= 32; ++n) {
    const encoding e = unorm_encoding(n);
    CHECK(decode(e, encode(e, 0)) == 0);
    CHECK(decode(e, encode(e, 1)) == 1);
    CHECK(decode(e, encode(e, 0.5)) != 0.5);
  }
}

TEST_CASE("hard case 41: (t - mu)^2 of adjacent half depths underflows, and no branchless bound may divide by it") {
  int zero = 0, adjacent = 0;
  for (std::uint16_t c = 0; c < 0x3c00; ++c) {
    const half mu = half::from_bits(c), t = half::from_bits(static_cast<std::uint16_t>(c + 1));
    const half d = t - mu, square = d * d;
    ++adjacent;
    zero += square == half(0);
    // A floor of the smallest number, or the comparison that decides first: neither is NaN.
    const half floor = std::numeric_limits<half>::denorm_min();
    CHECK(!isnan(floor / (floor + square)));
    const half decided = select(t <= mu, half(1), select(square == half(0), half(0), half(0) / (half(0) + square)));
    if (square != half(0)) CHECK(decided == half(0));
  }
  INFO(zero << " of " << adjacent);
  CHECK(zero * 2 > adjacent);
  CHECK(isnan(half(0) / half(0)));
}

TEST_CASE("hard case 42: the caller's environment changes nothing, and comes back") {
  struct answers {
    std::uint64_t encoded, subnormal, text, quotient, exponential, carried;
    bool operator==(const answers&) const = default;
  };
  volatile double third = 1.0 / 3;
  volatile float a = 0.1f, b = 0.3f;
  const auto work = [&] {
    const default_environment guard;
    return answers{encode(binary16::value, third),
                   encode(binary16::value, 0x1.8p-24),
                   encode(binary64::value, parse_number("0.1").value()),
                   divide(binary32::value, 0x3f800000, 0x40400000),
                   std::uint64_t{exp(half(1)).bits()},
                   std::uint64_t{(real<binary32>(a) * real<binary32>(b)).bits()}};
  };
  const answers calm = work();
  const unsigned control = _mm_getcsr();
  for (const int direction : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::fesetround(direction);
    _mm_setcsr(_mm_getcsr() | 0x8040);  // flush to zero, denormals are zero
    const answers hostile = work();
    const int kept = std::fegetround();
    const unsigned flags = _mm_getcsr() & 0x8040;
    // encode, parse and operations.hpp need no guard at all.
    const std::uint64_t bare = encode(binary16::value, third), small = encode(binary16::value, 0x1.8p-24);
    const std::uint64_t ratio = divide(binary32::value, 0x3f800000, 0x40400000);
    _mm_setcsr(control);
    std::fesetround(FE_TONEAREST);
    CHECK(hostile == calm);
    CHECK(kept == direction);
    CHECK(flags == 0x8040);
    CHECK(bare == calm.encoded);
    CHECK(small == calm.subnormal);
    CHECK(ratio == calm.quotient);
  }
  if (std::setlocale(LC_ALL, "de_DE.UTF-8") != nullptr || std::setlocale(LC_ALL, "fr_FR.UTF-8") != nullptr)
    CHECK(work() == calm);
  std::setlocale(LC_ALL, "C");
  CHECK(hexadecimal(0.1) == "0x1.999999999999ap-4");
}
