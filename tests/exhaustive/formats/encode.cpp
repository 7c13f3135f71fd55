// Every code of every 16-bit format, and what lies between neighbours, against MPFR: all directions and policies.
#include <cmath>
#include <limits>

#include "bitshade/formats/decode.hpp"
#include "bitshade/formats/name.hpp"
#include "support/catch.hpp"
#include "support/mpfr_oracle.hpp"

using namespace bitshade;

namespace {

constexpr rounding directions[] = {rounding::nearest_even, rounding::nearest_away, rounding::toward_zero,
                                   rounding::up,           rounding::down,         rounding::to_odd};
constexpr overflow overflows[] = {overflow::infinity, overflow::saturate, overflow::ieee};

struct tally {
  std::size_t wrong = 0, seen = 0;
  std::string first;
};

void compare(const encoding& e, oracle::rounder& truth, double x, tally& t) {
  oracle::number exact(64);
  mpfr_set_d(exact, x, MPFR_RNDN);
  truth.set(exact);
  for (const rounding d : directions) {
    for (const overflow o : overflows) {
      for (const bool flush : {false, true}) {
        rules r;
        r.direction = d;
        r.overflow = o;
        r.nan = nan_payload::canonical;
        if (flush) r.subnormal = subnormals::flush_output;
        const std::uint64_t got = encode(e, x, r), want = truth.bits(d, flush, o);
        ++t.seen;
        if (got == want) continue;
        if (t.wrong++ == 0)
          t.first = "encode(" + name_of(e) + ", " + oracle::hex(std::bit_cast<std::uint64_t>(x)) + "), direction " +
                    std::to_string(int(d)) + ", overflow " + std::to_string(int(o)) + (flush ? ", flush" : "") +
                    ": got " + oracle::hex(got) + ", MPFR has " + oracle::hex(want);
      }
    }
  }
}

/// Every code's value, the middle to its neighbour, and both neighbours of that middle in binary64.
tally sweep(const encoding& e) {
  tally t;
  oracle::rounder truth(e);
  oracle::number here(128), next(128);
  const std::uint64_t half = e.has_sign ? sign_bit(e) : std::uint64_t{1} << e.width;
  const double infinity = std::numeric_limits<double>::infinity();
  for (std::uint64_t code = 0; code < half; ++code) {
    oracle::value(here, e, code);
    if (mpfr_number_p(here) == 0) continue;
    const double x = mpfr_get_d(here, MPFR_RNDN);
    // Beyond the largest number its own step goes on.
    double step = mpfr_get_d(here, MPFR_RNDN);
    if (code < max_bits(e)) {
      oracle::value(next, e, code + 1);
      step = mpfr_get_d(next, MPFR_RNDN) - x;
    } else if (code != 0) {
      oracle::value(next, e, code - 1);
      step = x - mpfr_get_d(next, MPFR_RNDN);
    }
    const double middle = x + step / 2;
    const double near[] = {x, middle, std::nextafter(middle, 0.0), std::nextafter(middle, infinity)};
    for (const double y : near) {
      compare(e, truth, y, t);
      compare(e, truth, -y, t);
    }
  }
  const double ends[] = {infinity, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::max(),
                         std::numeric_limits<double>::denorm_min()};
  for (const double y : ends) {
    compare(e, truth, y, t);
    compare(e, truth, -y, t);
  }
  return t;
}

void expect_none_wrong(const encoding& e) {
  const tally t = sweep(e);
  INFO(name_of(e) << ": " << t.wrong << " of " << t.seen << " wrong; the first: " << t.first);
  CHECK(t.seen > 36);
  CHECK(t.wrong == 0);
}

}  // namespace

TEST_CASE("encode agrees with MPFR on every 16-bit binary format") {
  for (int exponent = 2; exponent <= 11; ++exponent) expect_none_wrong(binary_encoding(exponent, 15 - exponent));
}

TEST_CASE("encode agrees with MPFR on every 8-bit and packed format") {
  for (int exponent = 2; exponent <= 6; ++exponent) expect_none_wrong(binary_encoding(exponent, 7 - exponent));
  expect_none_wrong(e4m3_encoding());
  expect_none_wrong(unsigned_binary_encoding(5, 6));
  expect_none_wrong(unsigned_binary_encoding(5, 5));
}

TEST_CASE("encode agrees with MPFR on norms and fixed point of 8 and 16 bits") {
  for (const int n : {1, 2, 8, 16}) expect_none_wrong(unorm_encoding(n));
  for (const int n : {2, 8, 16}) expect_none_wrong(snorm_encoding(n));
  expect_none_wrong(fixed_encoding(4, 12));
  expect_none_wrong(fixed_encoding(1, 7));
  expect_none_wrong(ufixed_encoding(0, 16));
  expect_none_wrong(ufixed_encoding(16, 0));
}

TEST_CASE("decode gives the binary64 nearest to every code's value, and encode takes it back") {
  oracle::number exact(320);
  for (const char* name : {"binary16", "bfloat16", "e2m13", "e11m4", "fp8_e4m3", "fp8_e5m2", "ue5m6", "unorm1", "unorm8",
                           "unorm16", "snorm2", "snorm8", "snorm16", "fixed4.12", "ufixed16.0"}) {
    const encoding e = parse_encoding(name).value();
    std::size_t wrong = 0;
    for (std::uint64_t code = 0; code <= low_bits(e.width); ++code) {
      oracle::value(exact, e, code);
      const double want = mpfr_get_d(exact, MPFR_RNDN), got = decode(e, code);
      const bool same = std::isnan(want) ? std::isnan(got)
                                         : std::bit_cast<std::uint64_t>(got) == std::bit_cast<std::uint64_t>(want);
      const bool lowest = e.kind == family::snorm && code == sign_bit(e);
      const bool back = encode(e, got) == (lowest ? code + 1 : code) || std::isnan(want);
      if ((!same || !back) && wrong++ == 0) INFO(name << ' ' << oracle::hex(code) << " decodes to " << got);
    }
    INFO(name);
    CHECK(wrong == 0);
  }
}
