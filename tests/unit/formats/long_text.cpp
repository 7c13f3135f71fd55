// Numbers of many digits: borders written out in full, and what lies a digit beside them, against MPFR.
#include <string>

#include "bitshade/formats/name.hpp"
#include "bitshade/formats/random.hpp"
#include "bitshade/formats/text.hpp"
#include "support/catch.hpp"
#include "support/mpfr_oracle.hpp"

using namespace bitshade;

namespace {

/// All digits of a positive number, and the exponent of the first.
struct decimal {
  std::string digits;
  long exponent = 0;

  explicit decimal(mpfr_srcptr x) {
    mpfr_exp_t e = 0;
    char* raw = mpfr_get_str(nullptr, &e, 10, 1300, x, MPFR_RNDN);
    digits = raw;
    mpfr_free_str(raw);
    digits.erase(digits.find_last_not_of('0') + 1);
    exponent = static_cast<long>(e) - 1;
  }
  std::string followed_by(const std::string& more) const {
    return digits.substr(0, 1) + '.' + digits.substr(1) + more + 'e' + std::to_string(exponent);
  }
  /// The number one less in its last digit, and nines.
  std::string approached_by(std::size_t nines) const {
    decimal less = *this;
    less.digits.back() = static_cast<char>(less.digits.back() - 1);
    return less.followed_by(std::string(nines, '9'));
  }
};

/// A number that lies beside a border, if at all, by less than any format can tell.
void check_beside(const encoding& e, mpfr_srcptr border, const std::string& text, int side, std::uint64_t random) {
  oracle::number x(4000), step(8);
  mpfr_set(x, border, MPFR_RNDN);
  mpfr_set_ui_2exp(step, 1, mpfr_get_exp(border) - 3900, MPFR_RNDN);
  if (side > 0) mpfr_add(x, x, step, MPFR_RNDN);
  if (side < 0) mpfr_sub(x, x, step, MPFR_RNDN);
  oracle::rounder truth(e);
  truth.set(x);
  for (int d = 0; d < 7; ++d) {
    rules r;
    r.direction = static_cast<rounding>(d);
    truth.round(r.direction, random);
    const std::uint64_t want = truth.bits(false, r.overflow), got = encode(e, parse_number(text).value(), r, random);
    if (got == want) continue;
    FAIL_CHECK(name_of(e) << ", direction " << d << ", side " << side << ", " << text.size() << " characters, "
                          << text.substr(0, 40) << "...: got " << oracle::hex(got) << ", MPFR has " << oracle::hex(want));
  }
}

}  // namespace

TEST_CASE("a digit beside a border decides, whatever the format and however far away it stands") {
  oracle::number here(128), next(128), border(128);
  for (const char* name : {"binary64", "binary32", "binary16", "e11m1", "e2m52", "fp8_e4m3", "fixed1.63", "ufixed0.16"}) {
    const encoding e = parse_encoding(name).value();
    for (const std::uint64_t code : {std::uint64_t{1}, std::uint64_t{2}, min_normal_bits(e) - 1, min_normal_bits(e),
                                     min_normal_bits(e) + 1, max_bits(e) / 2, max_bits(e) - 1}) {
      if (code == 0 || code >= max_bits(e)) continue;
      oracle::value(here, e, code);
      oracle::value(next, e, code + 1);
      mpfr_add(border, here, next, MPFR_RNDN);
      mpfr_div_2ui(border, border, 1, MPFR_RNDN);
      // The tie, the number itself, and the farthest border that 64 random bits make.
      oracle::number fine(200);
      mpfr_sub(fine, next, here, MPFR_RNDN);
      mpfr_div_2ui(fine, fine, 64, MPFR_RNDN);
      mpfr_add(fine, here, fine, MPFR_RNDN);
      for (mpfr_srcptr x : {mpfr_srcptr(border), mpfr_srcptr(here), mpfr_srcptr(fine)}) {
        const decimal text(x);
        const std::uint64_t random = ~std::uint64_t{0} - (code & 1);
        check_beside(e, x, text.followed_by(""), 0, random);
        check_beside(e, x, text.followed_by(std::string(60, '0') + '1'), 1, random);
        check_beside(e, x, text.followed_by(std::string(1500, '0') + '1'), 1, random);
        check_beside(e, x, text.approached_by(1500), -1, random);
      }
    }
  }
}

TEST_CASE("long decimals of a norm's border, which no decimal hits, fall on the right side") {
  oracle::number code(6000);
  for (const char* name : {"unorm16", "unorm32", "snorm8"}) {
    const encoding e = parse_encoding(name).value();
    // 5000 digits of (k + 1/2) / (2^N - 1), cut off: just below.
    mpfr_set_ui(code, 2 * (static_cast<unsigned long>(max_bits(e)) / 3) + 1, MPFR_RNDN);
    mpfr_div_ui(code, code, 2 * static_cast<unsigned long>(max_bits(e)), MPFR_RNDN);
    mpfr_exp_t exponent = 0;
    char* raw = mpfr_get_str(nullptr, &exponent, 10, 1700, code, MPFR_RNDZ);
    const std::string below = "0." + std::string(static_cast<std::size_t>(-exponent), '0') + raw;
    mpfr_free_str(raw);
    const std::string above = below.substr(0, below.size() - 1) + "99";  // no border's last digit is followed by nines
    INFO(name << ' ' << below.substr(0, 40));
    CHECK(encode(e, parse_number(below).value()) == max_bits(e) / 3);
    CHECK(encode(e, parse_number(above).value()) == max_bits(e) / 3 + 1);
  }
}

TEST_CASE("ratios of long numbers are as exact as short ones") {
  const std::string many(3000, '7');
  const auto half = [](const std::string& text, rounding d) {
    return encode(binary16::value, parse_number(text).value(), rules{d});
  };
  for (const auto d : {rounding::nearest_even, rounding::up, rounding::down, rounding::to_odd, rounding::toward_zero}) {
    CHECK(half(many + '/' + many, d) == 0x3c00);
    CHECK(half("0x" + many + "/0x" + many, d) == 0x3c00);
    CHECK(half("3" + std::string(3000, '0') + "/1e3000", d) == 0x4200);
  }
  CHECK(half(many + "1/" + many + "0", rounding::up) == 0x3c01);
  CHECK(half(many + "1/" + many + "0", rounding::down) == 0x3c00);
  CHECK(half(many + "0/" + many + "1", rounding::up) == 0x3c00);
  CHECK(half(many + "0/" + many + "1", rounding::down) == 0x3bff);
  CHECK(half("0x" + many + ".8p-12000/1", rounding::nearest_even) == half("0x." + many + "8", rounding::nearest_even));
}

TEST_CASE("a hundred times the digits take a hundred times as long, not ten thousand times") {
  // Time is not asserted; work is: with an effort that grows with the square this test would take minutes.
  for (const char* name : {"binary64", "unorm16"}) {
    const encoding e = parse_encoding(name).value();
    for (const std::string& text : {"0." + std::string(3'000'000, '3'), "0x0." + std::string(3'000'000, '5')}) {
      const std::uint64_t got = encode(e, parse_number(text).value());
      CHECK(got == encode(e, parse_number("1/3").value()));
    }
  }
}
