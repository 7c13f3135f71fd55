// What counted counts, against the definition of each event.
#include "bitshade/arithmetic/counted_math.hpp"
#include "support/catch.hpp"

using namespace bitshade;

namespace {

/// What one function of counted numbers adds to fresh counts.
template <class T, class F>
constexpr operation_counts counts_of(F f, T a, T b = T(0)) {
  operation_counts n;
  f(counted<T>(a, &n), counted<T>(b));
  return n;
}

constexpr operation_counts exact{1, 0, 0, 0, 0}, rounded{1, 1, 0, 0, 0}, clamped{1, 0, 0, 1, 0};
constexpr operation_counts overflowed{1, 1, 0, 1, 0}, subnormal{1, 0, 0, 0, 1}, cancelled{1, 0, 1, 0, 0};

constexpr auto sum = [](auto a, auto b) { return a + b; };
constexpr auto difference = [](auto a, auto b) { return a - b; };
constexpr auto product = [](auto a, auto b) { return a * b; };
constexpr auto ratio = [](auto a, auto b) { return a / b; };

using half = real<binary16>;
using half_up = real<binary16, rules{rounding::up}>;
using half_flushed = real<binary16, rules{.subnormal = subnormals::flush_output}>;

// At compile time as well.
static_assert(counts_of<half>(sum, 1, 0x1p-11) == rounded);

}  // namespace

TEST_CASE("counted tells exact operations, roundings, overflows and subnormal results apart") {
  CHECK(counts_of<half>(sum, 1, 2) == exact);
  CHECK(counts_of<half>(sum, 1, 0x1p-11) == rounded);
  CHECK(counts_of<half>(product, 60000, 2) == overflowed);
  // Beyond the largest number, but not once it is rounded; up it is.
  CHECK(counts_of<half>(sum, 65504, 1) == rounded);
  CHECK(counts_of<half_up>(sum, half_up(65504), half_up(1)) == overflowed);
  CHECK(counts_of<half>(ratio, 1, 0) == exact);  // a pole, no overflow
  CHECK(counts_of<half>(ratio, 0x1p-14, 2) == subnormal);
  CHECK(counts_of<half_flushed>(ratio, half_flushed(0x1p-14), half_flushed(2)) == subnormal);
  CHECK(counts_of<half>(difference, 1, 1 - 0x1p-6) == cancelled);
  CHECK(counts_of<half>(difference, 1, 1) == cancelled);
  CHECK(counts_of<float>(product, 3e38f, 10) == overflowed);
  CHECK(counts_of<double>(ratio, 1, 3) == rounded);
}

TEST_CASE("counted records what norms and fixed-point formats clamp") {
  using u8 = real<unorm8>;
  using s8 = real<snorm<8>>;
  using q4 = real<fixed<4, 12>>;
  CHECK(counts_of<u8>(sum, 0.5, 0.25) == exact);
  CHECK(counts_of<u8>(sum, 1, u8::from_bits(1)) == clamped);
  CHECK(counts_of<u8>(difference, u8::from_bits(1), u8::from_bits(2)) == clamped);
  CHECK(counts_of<u8>(ratio, 1, 0.5) == overflowed);  // 255 / 128 steps, rounded and clamped
  CHECK(counts_of<s8>(difference, -1, s8::from_bits(1)) == clamped);
  CHECK(counts_of<q4>(sum, -8, -q4::from_bits(1)) == clamped);
  CHECK(counts_of<q4>(sum, -7, -1) == exact);  // -8 is there, 8 is not
  CHECK(counts_of<q4>(difference, 7, -1) == clamped);
  CHECK(counts_of<q4>(product, 3, 3) == clamped);
  CHECK(counts_of<q4>(product, q4::from_bits(1), 0.5) == rounded);
  CHECK(counts_of<u8>([](auto x, auto) { return exp(x); }, 0.5).overflows == 1);
  CHECK(counts_of<u8>([](auto x, auto) { return ldexp(x, 3); }, 0.5) == clamped);
  CHECK(counts_of<u8>([](auto x, auto) { return ldexp(x, 3); }, u8::from_bits(4)) == exact);
}

TEST_CASE("counted has fma and <cmath>, each one operation with real's result") {
  const half x(1.5), y(0.75);
  operation_counts n;
  const counted<half> a(x, &n), b(y);
  CHECK(fma(a, b, a).value() == fma(x, y, x));
  CHECK(n.operations == 1);
  CHECK(counts_of<half>([](auto u, auto v) { return fma(u, v, -u); }, 1 + 0x1p-10, 1) == cancelled);
  CHECK(counts_of<half>([](auto u, auto v) { return fma(u, v, u); }, 60000, 2) == overflowed);
  CHECK(counts_of<float>([](auto u, auto v) { return fma(u, v, u); }, 0.1f, 0.1f) == rounded);
  n = {};
#define SAME(call_counted, call_real) CHECK((call_counted).value() == (call_real))
  SAME(exp(a), exp(x));
  SAME(exp2(a), exp2(x));
  SAME(expm1(a), expm1(x));
  SAME(log(a), log(x));
  SAME(log2(a), log2(x));
  SAME(log10(a), log10(x));
  SAME(log1p(a), log1p(x));
  SAME(cbrt(a), cbrt(x));
  SAME(sin(a), sin(x));
  SAME(cos(a), cos(x));
  SAME(tan(a), tan(x));
  SAME(asin(b.at(&n)), asin(y));
  SAME(acos(b.at(&n)), acos(y));
  SAME(atan(a), atan(x));
  SAME(sinh(a), sinh(x));
  SAME(cosh(a), cosh(x));
  SAME(tanh(a), tanh(x));
  SAME(asinh(a), asinh(x));
  SAME(acosh(a), acosh(x));
  SAME(atanh(b.at(&n)), atanh(y));
  SAME(pow(a, b), pow(x, y));
  SAME(atan2(a, b), atan2(x, y));
  SAME(hypot(a, b), hypot(x, y));
  SAME(fmod(a, b), fmod(x, y));
  SAME(remainder(a, b), remainder(x, y));
  SAME(floor(a), floor(x));
  SAME(ceil(a), ceil(x));
  SAME(trunc(a), trunc(x));
  SAME(round(a), round(x));
  SAME(rint(a), rint(x));
  SAME(ldexp(a, 3), ldexp(x, 3));
  SAME(fdim(a, b), fdim(x, y));
  CHECK(n.operations == 32);
  const auto before = n;
  SAME(fmin(a, b), fmin(x, y));
  SAME(fmax(a, b), fmax(x, y));
  SAME(copysign(a, -b), copysign(x, -y));
  SAME(nextafter(a, b), nextafter(x, y));
  CHECK((!isnan(a) && isfinite(a) && isnormal(a) && !signbit(a) && ilogb(a) == 0));
  CHECK(n == before);  // choosing is no arithmetic
#undef SAME
}

TEST_CASE("counted numbers know T's limits") {
  CHECK(std::numeric_limits<counted<half>>::max().value() == half(65504));
  CHECK(std::numeric_limits<counted<half>>::digits == 11);
}
