// Integers and floating-point numbers of 128 bits, which are standard types where the compiler's extensions are on
// (-std=gnu++20, CMake's default).
#include <algorithm>
#include <limits>

#include "bitshade/arithmetic/ball.hpp"
#include "bitshade/arithmetic/interval.hpp"
#include "bitshade/arithmetic/real.hpp"
#include "support/catch.hpp"

#ifdef __STRICT_ANSI__
#error "this test needs the compiler's extensions"
#endif

using namespace bitshade;

namespace {

using half = real<binary16>;
using single = real<binary32>;
using twice = real<binary64>;

__extension__ typedef __int128 int128;
__extension__ typedef __float128 float128;

constexpr int128 two_to_100 = int128{1} << 100;
static_assert(std::integral<int128> && std::floating_point<float128>);

static_assert(twice(two_to_100) == twice(0x1p100));
static_assert(twice(-two_to_100) == twice(-0x1p100));
static_assert(twice(~uint128{0}) == twice(0x1p128));
static_assert(single(~uint128{0}) == std::bit_cast<float>(0x7f800000u));  // rounds up to 2^128
static_assert(half(two_to_100).bits() == 0x7c00 && half(-two_to_100).bits() == 0xfc00);
static_assert(twice(two_to_100 + (int128{1} << 47)) == twice(0x1p100));  // a tie, and even
static_assert(twice(two_to_100 + (int128{1} << 47) + 1) == twice(0x1.0000000000001p100));
static_assert(real<unorm8>(two_to_100) == real<unorm8>(1) && real<unorm8>(-two_to_100) == real<unorm8>(0));
static_assert(real<fixed<8, 8>>(-two_to_100) == real<fixed<8, 8>>(-128));

constexpr interval<double> around(two_to_100 + 1);
static_assert(around.lower() == 0x1p100 && around.upper() == 0x1.0000000000001p100);

}  // namespace

TEST_CASE("real rounds binary128 once, where two doubles would not hold it") {
  // 1 + 2^-11 is a tie of half; 2^-112 above it is not.
  const float128 above = float128{1} + static_cast<float128>(0x1p-11) + static_cast<float128>(0x1p-112);
  CHECK(half(above).bits() == 0x3c01);
  CHECK(half(-above).bits() == 0xbc01);
  // Beyond double's range, up and down.
  float128 big = static_cast<float128>(0x1p1000);
  big *= big;
  CHECK(twice(big) == std::numeric_limits<double>::infinity());
  CHECK(real<binary64, rules{rounding::toward_zero}>(big) == std::numeric_limits<double>::max());
  CHECK(real<binary64, rules{rounding::up}>(1 / big) == std::numeric_limits<double>::denorm_min());
  CHECK(twice(1 / big) == 0);
  // Between two subnormal doubles.
  const float128 least = static_cast<float128>(std::numeric_limits<double>::denorm_min());
  CHECK(twice(least + least / 2 + least / 4096) == twice(2 * 0x1p-1074));
  CHECK(twice(least + least / 2 - least / 4096) == twice(0x1p-1074));
  CHECK(twice(big - big) == 0);
  CHECK(half(big / (big - big)).bits() == 0x7c00);
}

TEST_CASE("real rounds long double once, the ends of its range included") {
  using limits = std::numeric_limits<long double>;
  CHECK(twice(limits::max()) == std::numeric_limits<double>::infinity());
  CHECK(real<binary64, rules{rounding::down}>(limits::max()) == std::numeric_limits<double>::max());
  CHECK(real<binary64, rules{rounding::up}>(limits::denorm_min()) == std::numeric_limits<double>::denorm_min());
  CHECK(real<binary64, rules{rounding::up}>(-limits::denorm_min()) == 0);
  CHECK(std::isnan(static_cast<double>(twice(limits::quiet_NaN()))));
}

/// Every power of two of T, subnormal ones included, by itself and with T's last bit beside it.
template <class T>
void unpacks_exactly(int most, int least, int digits) {
  T x = 1;
  for (int e = 0; e < most; ++e) x *= 2;
  for (int e = most; e >= least; --e, x /= 2) {
    const int last = std::max(least, e - digits + 1);
    T unit = x;
    for (int k = e; k > last; --k) unit /= 2;
    for (const bool with_last : {false, true}) {
      exact_result u = unpack_longer(with_last && e > last ? x + unit : x);
      // Its leading bit first, then what is left.
      INFO("2^" << e << (with_last ? " and the last bit" : ""));
      CHECK(u.exponent + bit_width(u.n) - 1 == e);
      u.n ^= uint128{1} << (bit_width(u.n) - 1);
      CHECK((with_last && e > last ? u.n == uint128{1} << (last - u.exponent) : u.n == 0));
    }
  }
  CHECK(x == 0);
}

TEST_CASE("every power of two of a longer floating-point number is taken as it is") {
  unpacks_exactly<long double>(16383, -16445, 64);
  unpacks_exactly<float128>(16383, -16494, 113);
}

TEST_CASE("ball takes every integer exactly") {
  const ball<3> a(two_to_100 + 1), b(std::int64_t{0x7fffffffffffffff});
  CHECK(a.radius() == 0);
  CHECK((a - ball<3>(0x1p100) == ball<3>(1)) == known::yes);
  CHECK((b + ball<3>(1) == ball<3>(0x1p63)) == known::yes);
  CHECK((ball<3>(std::numeric_limits<std::int64_t>::min()) == ball<3>(-0x1p63)) == known::yes);
}
