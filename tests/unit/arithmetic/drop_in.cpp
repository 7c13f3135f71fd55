// What code written for float asks of a number besides arithmetic: order, constants, the rest of <cmath>.
#include <bit>
#include <cmath>
#include <compare>
#include <concepts>
#include <limits>
#include <numbers>
#include <sstream>

#include "bitshade/arithmetic/counted_math.hpp"
#include "bitshade/arithmetic/real_limits.hpp"
#include "bitshade/arithmetic/real_math.hpp"
#include "bitshade/arithmetic/real_text.hpp"
#include "bitshade/formats/random.hpp"
#include "support/catch.hpp"

using namespace bitshade;

namespace {

using half = real<binary16>;
using single = real<binary32>;

/// Compared member by member, as C++20 has it.
template <class T>
struct depth_range {
  T near, far;
  auto operator<=>(const depth_range&) const = default;
};

static_assert(std::three_way_comparable<half, std::partial_ordering> && std::three_way_comparable<counted<half>>);
static_assert(depth_range<half>{1, 2} < depth_range<half>{1, 3});
static_assert(std::is_eq(half(0) <=> half(-0.0)) && (half(1) <=> 2) < 0);
static_assert((std::numeric_limits<half>::quiet_NaN() <=> half(1)) == std::partial_ordering::unordered);

// At compile time as well.
static_assert(lround(half(2.5)) == 3 && llrint(half(2.5)) == 2 && hypot(half(2), half(3), half(6)) == half(7));
static_assert(fpclassify(half(0x1p-24)) == FP_SUBNORMAL && isless(half(1), 2) && pow(2, half(3)) == half(8));

float any_float(std::uint64_t key, std::uint64_t i) {
  if (i % 2 == 0) return static_cast<float>(static_cast<int>(random_bits(key, i) % 4001) - 2000) / 8;
  return std::bit_cast<float>(static_cast<std::uint32_t>(random_bits(key, i)));
}

template <class Ours, class Native>
bool same_constants() {
  const auto same = [](Ours a, Native b) { return static_cast<Native>(a) == b; };
  return same(std::numbers::e_v<Ours>, std::numbers::e_v<Native>) &&
         same(std::numbers::log2e_v<Ours>, std::numbers::log2e_v<Native>) &&
         same(std::numbers::log10e_v<Ours>, std::numbers::log10e_v<Native>) &&
         same(std::numbers::pi_v<Ours>, std::numbers::pi_v<Native>) &&
         same(std::numbers::inv_pi_v<Ours>, std::numbers::inv_pi_v<Native>) &&
         same(std::numbers::inv_sqrtpi_v<Ours>, std::numbers::inv_sqrtpi_v<Native>) &&
         same(std::numbers::ln2_v<Ours>, std::numbers::ln2_v<Native>) &&
         same(std::numbers::ln10_v<Ours>, std::numbers::ln10_v<Native>) &&
         same(std::numbers::sqrt2_v<Ours>, std::numbers::sqrt2_v<Native>) &&
         same(std::numbers::sqrt3_v<Ours>, std::numbers::sqrt3_v<Native>) &&
         same(std::numbers::inv_sqrt3_v<Ours>, std::numbers::inv_sqrt3_v<Native>) &&
         same(std::numbers::egamma_v<Ours>, std::numbers::egamma_v<Native>) &&
         same(std::numbers::phi_v<Ours>, std::numbers::phi_v<Native>);
}

}  // namespace

TEST_CASE("remquo, lround, fpclassify, ilogb ... of real are the C library's") {
  std::uint64_t wrong = 0;
  for (std::uint64_t i = 0; i < 60000; ++i) {
    const float x = any_float(1, i), y = any_float(2, i);
    const single a(x), b(y);
    int n = 0, m = 0;
    const single rest = remquo(a, b, &n);
    const float native = std::remquo(x, y, &m);
    bool good = std::isnan(native) ? isnan(rest)
                                   : static_cast<float>(rest) == native && signbit(rest) == std::signbit(native) &&
                                         std::abs(n) % 8 == std::abs(m) % 8 && (m == 0 || (n < 0) == (m < 0));
    if (std::fabs(x) < 0x1p62f)
      good = good && lround(a) == std::lround(x) && llround(a) == std::llround(x) && lrint(a) == std::lrint(x) &&
             llrint(a) == std::llrint(x);
    good = good && fpclassify(a) == std::fpclassify(x) && ilogb(a) == std::ilogb(x) &&
           isgreater(a, b) == std::isgreater(x, y) && isgreaterequal(a, b) == std::isgreaterequal(x, y) &&
           isless(a, b) == std::isless(x, y) && islessequal(a, b) == std::islessequal(x, y) &&
           islessgreater(a, b) == std::islessgreater(x, y) && isunordered(a, b) == std::isunordered(x, y);
    if (!good && wrong++ == 0) {
      INFO(std::hexfloat << x << ' ' << y << ": remquo " << static_cast<float>(rest) << ' ' << n << ", native " << native << ' ' << m);
      CHECK(good);
    }
  }
  CHECK(wrong == 0);
  CHECK(ilogb(half(0)) == FP_ILOGB0);
  CHECK(ilogb(std::numeric_limits<half>::quiet_NaN()) == FP_ILOGBNAN);
  CHECK(scalbln(half(3), -2L) == half(0.75));
  CHECK(isinf(hypot(half(-HUGE_VAL), std::numeric_limits<half>::quiet_NaN(), half(1))));
  CHECK(hypot(single(1), single(0x1p-11), single(0x1.8p-11)) == single(std::sqrt(1 + 0x1p-22 + 0x1.2p-21)));
}

TEST_CASE("either operand of a function may be a float or an int") {
  CHECK(pow(2, half(0.5)) == sqrt(half(2)));
  CHECK(atan2(1.0f, half(1)) == atan2(half(1), half(1)));
  CHECK(hypot(3, half(4)) == half(5));
  CHECK(fmod(7.5, half(2)) == half(1.5));
  CHECK(remainder(7, half(4)) == half(-1));
  CHECK(fmin(0, half(1)) + fmax(2.0f, half(1)) + fdim(3, half(1)) == half(4));
  CHECK(copysign(1, half(-2)) == half(-1));
}

TEST_CASE("std::numbers has its constants, rounded once") {
  CHECK(same_constants<real<binary32>, float>());
  CHECK(same_constants<real<binary64>, double>());
  CHECK(std::numbers::pi_v<half>.bits() == 0x4248);
  CHECK(std::numbers::pi_v<real<binary16, rules{rounding::up}>>.bits() == 0x4249);
  CHECK(std::numbers::inv_pi_v<real<unorm8>>.bits() == 81);
}

TEST_CASE("what two's complement cannot negate is clamped by abs as by -") {
  using q = real<fixed<4, 12>>;
  CHECK(abs(q(-8)) == -q(-8));
  CHECK(static_cast<double>(abs(q(-8))) == 8 - 0x1p-12);
  CHECK(abs(q(-7.5)) == q(7.5));
}

TEST_CASE("a stream that holds no number leaves 0, as it does in a float") {
  std::istringstream in("abc");
  half x(7);
  CHECK(!(in >> x));
  CHECK(x == half(0));
}

TEST_CASE("counted counts ++ and --, and orders") {
  operation_counts n;
  counted<half> x(half(1), &n);
  CHECK(x++ == half(1));
  CHECK(--(++x) == half(2));
  CHECK(n.operations == 3);
  CHECK(std::is_lt(x <=> counted<half>(3)));
  CHECK(hypot(x, 3, 6) == half(7));
  int quotient = 0;
  CHECK(remquo(counted<half>(7), 4, &quotient) == half(-1));
  CHECK(quotient == 2);
  CHECK(lround(x) + llrint(x) + (fpclassify(x) == FP_NORMAL) == 5);
  CHECK(n.operations == 4);
}
