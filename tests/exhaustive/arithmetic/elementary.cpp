// exp, log, sin ... of real against MPFR: correctly rounded, in every direction.
#include "bitshade/arithmetic/real_math.hpp"

#include "bitshade/formats/name.hpp"
#include "bitshade/formats/random.hpp"
#include "support/catch.hpp"
#include "support/mpfr_oracle.hpp"

using namespace bitshade;

namespace {

struct function {
  const char* name;
  exact_result (*ours)(double);
  int (*theirs)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);
};

#define BITSHADE_PAIR(name) \
  function { #name, [](double x) { return elementary::name(x); }, [](mpfr_ptr y, mpfr_srcptr x, mpfr_rnd_t r) { return mpfr_##name(y, x, r); } }
const function functions[] = {
    BITSHADE_PAIR(exp),   BITSHADE_PAIR(exp2), BITSHADE_PAIR(expm1), BITSHADE_PAIR(log),   BITSHADE_PAIR(log2),
    BITSHADE_PAIR(log10), BITSHADE_PAIR(log1p), BITSHADE_PAIR(sin),   BITSHADE_PAIR(cos),   BITSHADE_PAIR(tan),
    BITSHADE_PAIR(asin),  BITSHADE_PAIR(acos), BITSHADE_PAIR(atan),  BITSHADE_PAIR(sinh),  BITSHADE_PAIR(cosh),
    BITSHADE_PAIR(tanh),  BITSHADE_PAIR(asinh), BITSHADE_PAIR(acosh), BITSHADE_PAIR(atanh),
    {"cbrt", [](double x) { return elementary::cbrt(x); },
     [](mpfr_ptr y, mpfr_srcptr x, mpfr_rnd_t r) { return mpfr_cbrt(y, x, r); }},
};
#undef BITSHADE_PAIR

constexpr rounding directions[] = {rounding::nearest_even, rounding::toward_zero, rounding::up, rounding::down};

struct tally {
  std::uint64_t seen = 0, wrong = 0;
  std::string first;

  void check(const char* name, const encoding& e, oracle::rounder& truth, const exact_result& ours, mpfr_srcptr exact,
             std::uint64_t a, std::uint64_t b, rounding d) {
    rules r;
    r.direction = d;
    truth.set(exact);
    const std::uint64_t got = round_result(e, ours, r), want = truth.bits(d, false, overflow::ieee);
    ++seen;
    if (got == want || wrong++ != 0) return;
    first = name_of(e) + ' ' + name + ' ' + oracle::hex(a) + ' ' + oracle::hex(b) + ", direction " +
            std::to_string(int(d)) + ": got " + oracle::hex(got) + ", MPFR has " + oracle::hex(want);
  }
  void finish() const {
    INFO(wrong << " of " << seen << " wrong; the first: " << first);
    CHECK(seen > 1000);
    CHECK(wrong == 0);
  }
};

/// Every `stride`-th code of a format through every function of one argument.
void sweep(const char* name, std::uint64_t stride) {
  const encoding e = parse_encoding(name).value();
  oracle::rounder truth(e);
  oracle::number x(64), y(200);
  tally t;
  for (const function& f : functions) {
    for (std::uint64_t i = 0; i < low_bits(e.width) / stride; ++i) {
      const std::uint64_t code = i * stride + stride / 2;
      oracle::value(x, e, code);
      mpfr_set_prec(y, 200);
      oracle::make_odd(y, f.theirs(y, x, MPFR_RNDZ));
      const double argument = decode(e, code);
      t.check(f.name, e, truth, f.ours(argument), y, code, 0, directions[i % 4]);
    }
  }
  t.finish();
}

}  // namespace

TEST_CASE("elementary functions are correctly rounded: a sample of each format") {
  sweep("binary16", 61);
  sweep("bfloat16", 61);
  sweep("binary32", 8388593);
  sweep("binary64", 0x00fedcba98765433);
}

TEST_CASE("elementary functions are correctly rounded: every argument of binary16", "[.long]") { sweep("binary16", 1); }

TEST_CASE("pow, atan2 and hypot are correctly rounded") {
  for (const char* name : {"binary16", "bfloat16", "binary32"}) {
    const encoding e = parse_encoding(name).value();
    oracle::rounder truth(e);
    oracle::number x(64), y(64), z(200);
    tally t;
    for (std::uint64_t i = 0; i < 6000; ++i) {
      // A third around 1, a third of small integers and their quarters, where powers are exact.
      const auto pick = [&](std::uint64_t key) {
        const std::uint64_t bits = random_bits(key, i);
        if (i % 3 == 0) return bits & low_bits(e.width);
        if (i % 3 == 1) return encode(e, 1.0) ^ (bits & low_bits(e.fraction_bits + 1));
        return encode(e, static_cast<double>(bits % 65) / 4 - (key == 2 ? 8 : 0));
      };
      const std::uint64_t a = pick(1), b = pick(2);
      oracle::value(x, e, a);
      oracle::value(y, e, b);
      const double p = decode(e, a), q = decode(e, b);
      const rounding d = directions[i % 4];
      mpfr_set_prec(z, 200);
      oracle::make_odd(z, mpfr_pow(z, x, y, MPFR_RNDZ));
      t.check("pow", e, truth, elementary::pow(p, q), z, a, b, d);
      mpfr_set_prec(z, 200);
      oracle::make_odd(z, mpfr_atan2(z, x, y, MPFR_RNDZ));
      t.check("atan2", e, truth, elementary::atan2(p, q), z, a, b, d);
    }
    t.finish();
  }
  using half = real<binary16>;
  oracle::rounder truth(binary16::value);
  oracle::number x(64), y(64), z(4000);
  std::uint64_t wrong = 0;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const auto a = static_cast<std::uint16_t>(random_bits(4, i)), b = static_cast<std::uint16_t>(random_bits(5, i));
    oracle::value(x, binary16::value, a);
    oracle::value(y, binary16::value, b);
    mpfr_set_prec(z, 200);
    oracle::make_odd(z, mpfr_hypot(z, x, y, MPFR_RNDZ));
    truth.set(z);
    wrong += hypot(half::from_bits(a), half::from_bits(b)).bits() !=
             truth.bits(rounding::nearest_even, false, overflow::ieee);
  }
  CHECK(wrong == 0);
}
