// Intervals, enclosures, counts, samples and error-free transforms: each held against exact arithmetic.
#include <cmath>

#include "bitshade/arithmetic/counted.hpp"
#include "bitshade/arithmetic/enclosure.hpp"
#include "bitshade/arithmetic/error_free.hpp"
#include "bitshade/arithmetic/interval.hpp"
#include "bitshade/arithmetic/native.hpp"
#include "bitshade/arithmetic/policy.hpp"
#include "bitshade/arithmetic/samples.hpp"
#include "bitshade/interop/rational.hpp"
#include "support/catch.hpp"

using namespace bitshade;

namespace {

double number(std::uint64_t key, std::uint64_t i) {
  const std::uint64_t r = random_bits(key, i);
  return std::ldexp(static_cast<double>(static_cast<std::int64_t>(r)), static_cast<int>(r % 41) - 80);
}

template <class T>
bool encloses(const interval<T>& x, const exact_rational& truth) {
  return exact_rational(static_cast<double>(x.lower())) <= truth && truth <= exact_rational(static_cast<double>(x.upper()));
}

static_assert(std::is_same_v<native<float>, float>);
struct counting : policy<binary32> {
  using filter = counted<float>;
};
static_assert(numeric_policy<counting> && std::is_same_v<counting::shade, float> && sizeof(counting) == 1);

}  // namespace

TEST_CASE("intervals enclose the exact result, with the nearest bounds") {
  std::size_t wide = 0;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const double a = number(1, i), b = number(2, i);
    const exact_rational x(a), y(b);
    const interval<double> p(a), q(b);
    bool good = encloses(p + q, x + y) && encloses(p - q, x - y) && encloses(p * q, x * y) && encloses(p / q, x / y);
    const interval<real<binary16>> h(a), k(b);
    // A number that half does not hold is enclosed as well, and so are its results.
    if (std::fabs(a) < 100 && std::fabs(b) < 100)
      good = good && encloses(h, x) && encloses(k, y) && encloses(h + k, x + y) && encloses(h * k, x * y);
    wide += std::nextafter((p / q).lower(), 1e300) < (p / q).upper();
    INFO(std::hexfloat << a << ' ' << b);
    CHECK(good);
  }
  CHECK(wide == 0);
  const interval<double> z(-1, 2);
  CHECK(std::isinf((interval<double>(1) / z).upper()));
  CHECK((z * z).lower() == -2);
  CHECK(abs(z).lower() == 0);
  // Two ends without a bound have no quotient; numbers between come near 0 and go beyond every bound.
  const double endless = std::numeric_limits<double>::infinity();
  const interval<double> left = interval<double>(-endless, 5) / interval<double>(-endless, -2);
  CHECK(left.lower() == -2.5);
  CHECK(left.upper() == endless);
  const interval<double> right = interval<double>(1, endless) / interval<double>(2, endless);
  CHECK(right.lower() == 0);
  CHECK(right.upper() == endless);
  // Nothing of these has a root or a logarithm: no bound is NaN.
  CHECK(sqrt(interval<double>(-2, -1)).upper() == 0);
  CHECK(log(interval<double>(-2, -1)).upper() == -endless);
}

TEST_CASE("comparisons of intervals have three answers") {
  const interval<double> a(0, 1), b(2, 3), c(0.5, 2.5);
  CHECK((a < b) == truth::yes);
  CHECK((b < a) == truth::no);
  CHECK((a < c) == truth::maybe);
  CHECK((a == b) == truth::no);
  CHECK((a == a) == truth::maybe);
  CHECK((interval<double>(1) == interval<double>(1)) == truth::yes);
  CHECK((!(a < c)) == truth::maybe);
  const interval<double> either = select(a < c, a, b);
  CHECK(either.lower() == 0);
  CHECK(either.upper() == 3);
}

TEST_CASE("square roots and exponentials of exact numbers are enclosed as closely as asked") {
  for (const int bits : {10, 60, 200}) {
    for (const double d : {2.0, 0x1p-40, 3e20, 1e-9, 9.0}) {
      const exact_rational x(d);
      const auto r = sqrt_enclosure(x, bits);
      CHECK((r.lower() * r.lower() <= x && x <= r.upper() * r.upper()));
      CHECK(r.upper() - r.lower() <= detail::power_of_half<rational>(bits));
    }
  }
  for (const double d : {1.0, -3.0, 0.001, 5.54, 42.0}) {
    const auto close = exp_enclosure(exact_rational(d), 90), coarse = exp_enclosure(exact_rational(d), 30);
    CHECK((coarse.lower() <= close.lower() && close.upper() <= coarse.upper()));
    CHECK(close.upper() - close.lower() <= detail::power_of_half<rational>(90) * (exact_rational(1) + close.upper()));
    // elementary::exp is the other, independent way: correctly rounded to binary64 it may leave the bounds by an ulp.
    const double e = decode(binary64::value, round_result(binary64::value, elementary::exp(d), {}));
    CHECK((exact_rational(std::nextafter(e, 0)) <= close.lower() && close.upper() <= exact_rational(std::nextafter(e, 1e300))));
  }
}

TEST_CASE("error-free transforms leave nothing out") {
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const double a = number(3, i), b = number(4, i);
    const auto s = two_sum(a, b), p = two_product(a, b);
    INFO(std::hexfloat << a << ' ' << b);
    CHECK(exact_rational(s.value) + exact_rational(s.error) == exact_rational(a) + exact_rational(b));
    CHECK(exact_rational(p.value) + exact_rational(p.error) == exact_rational(a) * exact_rational(b));
  }
}

TEST_CASE("counts say what the operations did, and to which stage") {
  operation_counts filter, shade;
  const counted<real<binary16>> a(real<binary16>(1), &filter), b(real<binary16>(0x1p-11), &filter);
  const auto sum = a + b;  // a tie: rounds
  CHECK(filter == operation_counts{1, 1, 0, 0, 0});
  const auto zero = sum - a;  // cancels, exactly
  CHECK(filter == operation_counts{2, 1, 1, 0, 0});
  const auto big = counted<real<binary16>>(real<binary16>(60000), &shade) * sum.at(&shade) * real<binary16>(2);
  CHECK(shade == operation_counts{2, 1, 0, 1, 0});
  const auto small = a * real<binary16>(0x1p-20);
  CHECK(filter == operation_counts{3, 1, 1, 0, 1});
  CHECK((zero.value() == real<binary16>(0) && small.value() == real<binary16>(0x1p-20) && !(big.value() - big.value() == real<binary16>(0))));
  const counted<float> alone(1.5f);
  CHECK((alone * alone).where() == nullptr);
}

TEST_CASE("samples of stochastic arithmetic see what cancellation costs") {
  using s = samples<binary32, 16>;
  const s a(1.0 / 3, 1), b(0.1 * 0x1p-20, 1);
  CHECK(a.significant_bits() > 20);
  const s lost = (a + b) - a;  // what is left of b is 3.2 units of a's last place
  CHECK(lost.significant_bits() < 8);
  CHECK(std::abs(lost.mean() - 0.1 * 0x1p-20) < 0x1p-25);
  const s again = (s(1.0 / 3, 1) + s(0.1 * 0x1p-20, 1)) - s(1.0 / 3, 1);
  for (std::size_t i = 0; i < 16; ++i) CHECK(again.sample(i) == lost.sample(i));
  CHECK((s(2) * s(3)).significant_bits() == 24);
}

TEST_CASE("stochastic rounding goes up as often as the fraction says") {
  rules r{rounding::stochastic};
  const double x = 1 + 0.3 * 0x1p-10;
  int up = 0;
  for (std::uint64_t i = 0; i < 100000; ++i) up += encode(binary16::value, x, r, random_bits(42, i)) == 0x3c01;
  // Binomial with p = 0.3: five standard deviations are 725.
  CHECK(std::abs(up - 30000) < 725);
  r.random_bits = 1;  // one bit sees 0.3 as 0, so that it never goes up
  for (std::uint64_t i = 0; i < 100; ++i) CHECK(encode(binary16::value, x, r, random_bits(42, i)) == 0x3c00);
}
