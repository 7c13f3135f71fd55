// Enclosures hold the truth: random expressions against MPFR at four times their precision.
#include "bitshade/arithmetic/ball.hpp"

#include <mpfr.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "bitshade/shadow/certified.hpp"
#include "support/catch.hpp"

using namespace bitshade;

namespace {

/// A number of MPFR with 2,000 bits.
class truth {
 public:
  truth(double x = 0) { mpfr_init2(v, 2000), mpfr_set_d(v, x, MPFR_RNDN); }
  truth(const truth& o) { mpfr_init2(v, 2000), mpfr_set(v, o.v, MPFR_RNDN); }
  truth& operator=(const truth& o) {
    mpfr_set(v, o.v, MPFR_RNDN);
    return *this;
  }
  ~truth() { mpfr_clear(v); }
  mpfr_t v;
};

template <std::size_t Limbs>
truth middle_of(const ball<Limbs>& b) {
  truth r;
  for (std::size_t i = Limbs; i-- > 0;) {
    mpfr_mul_2si(r.v, r.v, 64, MPFR_RNDN);
    mpfr_add_ui(r.v, r.v, b.mantissa().limb[i], MPFR_RNDN);
  }
  mpfr_mul_2si(r.v, r.v, b.exponent(), MPFR_RNDN);
  if (b.negative()) mpfr_neg(r.v, r.v, MPFR_RNDN);
  return r;
}

/// |truth - middle| <= radius, up to MPFR's own 2^-1990.
template <std::size_t Limbs>
bool holds(const ball<Limbs>& b, const truth& x) {
  truth d = middle_of(b);
  mpfr_sub(d.v, d.v, x.v, MPFR_RNDN);
  mpfr_abs(d.v, d.v, MPFR_RNDN);
  truth slack = x;
  mpfr_abs(slack.v, slack.v, MPFR_RNDN);
  mpfr_mul_2si(slack.v, slack.v, -1980, MPFR_RNDN);
  mpfr_add_d(slack.v, slack.v, b.radius(), MPFR_RNDU);
  return mpfr_cmp(d.v, slack.v) <= 0;
}

std::string hex(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%a", x);
  return text;
}

struct pair_of_both_sizes {
  ball<3> small;
  ball<8> large;
  truth real;
};

class random_numbers {
 public:
  std::uint64_t bits() {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return state_ >> 33 | state_ << 31;
  }
  double operator()(double from, double to) {
    return from + (to - from) * static_cast<double>(bits() & 0xffffffff) * 0x1p-32;
  }

 private:
  std::uint64_t state_ = 9;
};

}  // namespace

TEST_CASE("random expressions over + - x / and roots stay inside their enclosures") {
  random_numbers next;
  std::vector<pair_of_both_sizes> pool;
  for (int i = 0; i < 12; ++i) {
    const double x = next(-2, 2) * std::ldexp(1.0, static_cast<int>(next.bits() % 60) - 30);
    pool.push_back({x, x, x});
  }
  int narrow = 0;
  for (int step = 0; step < 6000; ++step) {
    const auto &a = pool[next.bits() % pool.size()], &b = pool[next.bits() % pool.size()];
    pair_of_both_sizes r = a;
    const auto op = next.bits() % 6;
    if (op == 0)
      r.small = a.small + b.small, r.large = a.large + b.large,
      mpfr_add(r.real.v, a.real.v, b.real.v, MPFR_RNDN);
    if (op == 1)
      r.small = a.small - b.small, r.large = a.large - b.large,
      mpfr_sub(r.real.v, a.real.v, b.real.v, MPFR_RNDN);
    if (op == 2)
      r.small = a.small * b.small, r.large = a.large * b.large,
      mpfr_mul(r.real.v, a.real.v, b.real.v, MPFR_RNDN);
    if (op == 3)
      r.small = a.small / b.small, r.large = a.large / b.large,
      mpfr_div(r.real.v, a.real.v, b.real.v, MPFR_RNDN);
    if (op == 4)
      r.small = sqrt(a.small * a.small + b.small * b.small),
      r.large = sqrt(a.large * a.large + b.large * b.large),
      mpfr_hypot(r.real.v, a.real.v, b.real.v, MPFR_RNDN);
    if (op == 5)
      r.small = a.small - b.small * (a.small / b.small),
      r.large = a.large - b.large * (a.large / b.large), mpfr_set_zero(r.real.v, 1);
    if (!mpfr_number_p(r.real.v)) continue;
    CAPTURE(step, op, hex(r.small.nearest()), hex(r.small.radius()), hex(r.large.radius()));
    REQUIRE(holds(r.small, r.real));
    REQUIRE(holds(r.large, r.real));
    const double size = std::fabs(mpfr_get_d(r.real.v, MPFR_RNDN));
    // An enclosure that only grows would hold anything: keep those that still say something.
    const bool useful = size > 1e-100 && size < 1e100 && r.small.radius() < size * 1e-20;
    if (op == 5 || !useful) {
      const double x = next(-3, 3);
      r = {x, x, x};
    } else {
      ++narrow;
      if (const auto got = decided(r.small)) REQUIRE(*got == mpfr_get_d(r.real.v, MPFR_RNDN));
    }
    pool[next.bits() % pool.size()] = r;
  }
  CHECK(narrow > 3000);
}

TEST_CASE("exact operations stay exact, and comparisons say what is known") {
  using number = ball<4>;
  CHECK((number(0.1) * number(0.1)).radius() == 0);
  CHECK((number(3) / number(4)).radius() == 0);
  CHECK((number(1) / number(3)).radius() > 0);
  CHECK(sqrt(number(2.25)).radius() == 0);
  CHECK(decided(sqrt(number(2.25))) == 1.5);
  CHECK((number(0.3) - number(0.3) < number(0)) == known::no);
  CHECK((number(0.3) == number(0.3)) == known::yes);
  const number third = number(1) / number(3);
  CHECK((third + third + third == number(1)) == known::unknown);
  CHECK((third < number(0.5)) == known::yes);
  CHECK((third >= number(0.5)) == known::no);
  CHECK(decided(third) == 1.0 / 3);
  const number both = select(known::unknown, number(1), number(3));
  CHECK((both < number(3.5)) == known::yes);
  CHECK((both > number(0.5)) == known::unknown);  // an enclosure around 1 of radius 2
  CHECK_FALSE(decided(both));
  CHECK_FALSE(decided(number(1) / (third - third)));
  CHECK_FALSE(decided(number::anything() * number(0)));
  CHECK(decided(number(-0.0)) == 0);
  CHECK(decided(number(-1e300)) == -1e300);
  CHECK(decided(number(0x1p-1074)) == 0);  // below 2^-1000, as documented
}

TEST_CASE("e^x, cos and sin enclose MPFR's, tightly") {
  random_numbers next;
  const auto check = [](const auto& got, const truth& real, double size) {
    REQUIRE(holds(got, real));
    // Radii below 2^-1000 are not told from it; e^90 < 2^130 multiplies that.
    const double smallest = std::ldexp(1.0, std::max(24 - static_cast<int>(got.bits), -980));
    REQUIRE(got.radius() <= std::max(size, 1.0) * smallest);
  };
  for (int i = 0; i < 400; ++i) {
    const double x = i == 0 ? 0 : next(-90, 90) * (i % 3 == 0 ? 1e-3 : 1);
    truth e(x);
    mpfr_exp(e.v, e.v, MPFR_RNDN);
    CAPTURE(i, x);
    check(exponential(ball<3>(x)), e, std::exp(x));
    check(exponential(ball<8>(x)), e, std::exp(x));
    check(exponential(ball<16>(x)), e, std::exp(x));
    const int n = 2 * (i % 16) + 1;
    const double y = static_cast<float>(next(0, 1));
    truth angle(y), sine, cosine;
    mpfr_mul_si(angle.v, angle.v, n, MPFR_RNDN);
    truth pi;
    mpfr_const_pi(pi.v, MPFR_RNDN);
    mpfr_mul(angle.v, angle.v, pi.v, MPFR_RNDN);
    mpfr_sin_cos(sine.v, cosine.v, angle.v, MPFR_RNDN);
    const auto small = half_turns(ball<3>(y), n);
    const auto large = half_turns(ball<8>(y), n);
    check(small.sine, sine, 1);
    check(small.cosine, cosine, 1);
    check(large.sine, sine, 1);
    check(large.cosine, cosine, 1);
    truth inverse(1);
    mpfr_div(inverse.v, inverse.v, pi.v, MPFR_RNDN);
    mpfr_div_si(inverse.v, inverse.v, n, MPFR_RNDN);
    check(inverse_half_turns(ball<8>(0), n), inverse, 1);
  }
  const auto zero = half_turns(ball<3>(0.5), 2);
  CHECK(decided(zero.sine) == 0);
  CHECK(decided(zero.cosine) == -1);
}
