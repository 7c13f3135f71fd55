// Every code of every 16-bit format, and what lies between neighbours, against MPFR: all directions and policies.
#include <cmath>
#include <limits>

#include "bitshade/formats/round_to.hpp"
#include "bitshade/formats/name.hpp"
#include "bitshade/formats/random.hpp"
#include "support/catch.hpp"
#include "support/mpfr_oracle.hpp"

using namespace bitshade;

namespace {

constexpr overflow overflows[] = {overflow::infinity, overflow::saturate, overflow::ieee};

struct tally {
  std::size_t wrong = 0, seen = 0;
  std::string first;
};

void compare(const encoding& e, oracle::rounder& truth, double x, tally& t) {
  oracle::number exact(64);
  mpfr_set_d(exact, x, MPFR_RNDN);
  truth.set(exact);
  // Random bits that carry or not, whatever the fraction; their number varies with the value.
  const std::uint64_t pattern = std::bit_cast<std::uint64_t>(x), random = random_bits(1, pattern);
  const int count = 1 + static_cast<int>(random_bits(2, pattern) % 64);
  for (int d = 0; d < 7; ++d) {
    const auto direction = static_cast<rounding>(d);
    truth.round(direction, random, count);
    for (const overflow o : overflows) {
      for (const bool flush : {false, true}) {
        rules r;
        r.direction = direction;
        r.overflow = o;
        r.nan = nan_payload::canonical;
        r.random_bits = count;
        if (flush) r.subnormal = subnormals::flush_output;
        const std::uint64_t got = encode(e, x, r, random), want = truth.bits(flush, o);
        ++t.seen;
        if (got == want) continue;
        if (t.wrong++ == 0)
          t.first = "encode(" + name_of(e) + ", " + oracle::hex(pattern) + "), direction " + std::to_string(d) +
                    ", overflow " + std::to_string(int(o)) + (flush ? ", flush" : "") + ", " + std::to_string(count) +
                    " bits of " + oracle::hex(random) + ": got " + oracle::hex(got) + ", MPFR has " + oracle::hex(want);
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
  CHECK(t.seen > 42);
  CHECK(t.wrong == 0);
}

}  // namespace

TEST_CASE("encode agrees with MPFR on every 16-bit binary format") {
  for (int exponent = 2; exponent <= 11; ++exponent) {
    expect_none_wrong(binary_encoding(exponent, 15 - exponent));
    expect_none_wrong(unsigned_binary_encoding(exponent, 16 - exponent));
  }
}

TEST_CASE("encode agrees with MPFR on every 8-bit and packed format") {
  for (int exponent = 2; exponent <= 6; ++exponent) expect_none_wrong(binary_encoding(exponent, 7 - exponent));
  expect_none_wrong(e4m3_encoding());
  expect_none_wrong(unsigned_binary_encoding(5, 6));
  expect_none_wrong(unsigned_binary_encoding(5, 5));
}

TEST_CASE("encode agrees with MPFR on all norms of at most 16 bits") {
  for (int n = 1; n <= 16; ++n) expect_none_wrong(unorm_encoding(n));
  for (int n = 2; n <= 16; ++n) expect_none_wrong(snorm_encoding(n));
}

TEST_CASE("encode agrees with MPFR on all fixed-point formats of 8 and 16 bits") {
  for (const int width : {8, 16}) {
    for (int integer = 1; integer <= width; ++integer) expect_none_wrong(fixed_encoding(integer, width - integer));
    for (int integer = 0; integer <= width; ++integer) expect_none_wrong(ufixed_encoding(integer, width - integer));
  }
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

TEST_CASE("decode flushes the subnormal codes of every 16-bit float, and no others") {
  oracle::number exact(128);
  constexpr subnormals policies[] = {subnormals::preserve, subnormals::flush_output, subnormals::flush_input,
                                     subnormals::flush_both};
  for (int exponent = 2; exponent <= 11; ++exponent) {
    for (const encoding& e : {binary_encoding(exponent, 15 - exponent), unsigned_binary_encoding(exponent, 16 - exponent)}) {
      std::size_t wrong = 0, flushed = 0;
      std::string first;
      for (std::uint64_t code = 0; code < 65536; ++code) {
        oracle::value(exact, e, code);
        // Subnormal: nearer to 0 than 2 to the format's least exponent.
        const bool subnormal = mpfr_number_p(exact) != 0 && mpfr_zero_p(exact) == 0 &&
                               mpfr_get_exp(exact) - 1 < 2 - (1L << (exponent - 1));
        const double value = mpfr_get_d(exact, MPFR_RNDN);
        for (const subnormals policy : policies) {
          rules r;
          r.subnormal = policy;
          const bool zero = subnormal && flushes_input(policy);
          const double want = zero ? std::copysign(0.0, value) : value, got = decode(e, code, r);
          flushed += zero ? 1 : 0;
          // What is read as zero is encoded as zero again.
          const bool back = std::isnan(want) || round_to(e, want, r) == want || flushes_output(policy);
          const bool same = std::isnan(want) ? std::isnan(got)
                                             : std::bit_cast<std::uint64_t>(got) == std::bit_cast<std::uint64_t>(want);
          if ((!same || !back) && wrong++ == 0)
            first = oracle::hex(code) + ", subnormals " + std::to_string(int(policy)) + ": " + std::to_string(got);
        }
      }
      INFO(name_of(e) << ": " << wrong << " wrong, the first " << first);
      CHECK(wrong == 0);
      CHECK(flushed == (e.has_sign ? 4 : 2) * ((std::uint64_t{1} << e.fraction_bits) - 1));
    }
  }
}
