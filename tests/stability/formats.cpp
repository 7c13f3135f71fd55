// The hard cases of storage, 18 to 20, 39 and 40, in every format that they concern.
#include <cmath>
#include <string>
#include <vector>

#include "bitshade/arithmetic/real_limits.hpp"
#include "bitshade/arithmetic/real_math.hpp"
#include "bitshade/formats/name.hpp"
#include "bitshade/formats/random.hpp"
#include "bitshade/formats/round_to.hpp"
#include "support/catch.hpp"
#include "support/mpfr_oracle.hpp"

using namespace bitshade;
using half = real<binary16>;

namespace {

std::vector<encoding> named(std::initializer_list<const char*> names) {
  std::vector<encoding> list;
  for (const char* name : names) list.push_back(parse_encoding(name).value());
  return list;
}
/// Floats of every size, with the largest and the smallest exponents.
std::vector<encoding> floats() {
  return named({"binary16", "bfloat16", "tf32", "binary32", "fp8_e5m2", "fp8_e4m3", "e2m13", "e2m1", "e7m8", "e9m6",
                "e11m4", "e8m30", "binary64"});
}
/// Formats of equal steps that store depths.
std::vector<encoding> steps() {
  return named({"unorm8", "unorm16", "unorm24", "unorm32", "snorm8", "snorm16", "fixed4.12", "fixed1.15", "ufixed0.16",
                "ufixed2.30"});
}
double one_in(const encoding& e) {
  return static_cast<double>(is_norm(e) ? steps_to_one(e) : std::uint64_t{1} << e.fraction_bits);
}
/// (-1)^negative n 2^exponent, whatever binary64 holds.
std::uint64_t exactly(const encoding& e, bool negative, std::uint64_t n, int exponent, const rules& r = {}) {
  return encode_scaled(e, negative, n, exponent, false, r, 0);
}

}  // namespace

TEST_CASE("hard case 18: squares of small depths in a float are subnormal, then 0; in half below 2^-7 and 2^-12.5") {
  rules flush;
  flush.subnormal = subnormals::flush_output;
  for (const encoding& e : floats()) {
    // x = 2^-k (1 + 2^-m), squared in units of 2^-2(k + m): an odd number of bits too many for a float is no matter.
    const auto square = [&](std::uint64_t n, int exponent, const rules& r) {
      return exactly(e, false, n * n, 2 * exponent, r);
    };
    const int normal = -min_exponent(e), k = (normal + 1) / 2;  // the least k whose 2^-2k is subnormal, or normal at its edge
    INFO(name_of(e));
    const bool edge = 2 * k == normal;
    CHECK((square(1, -k, {}) == min_normal_bits(e)) == edge);
    CHECK(square(1, -(k + (edge ? 1 : 0)), {}) < min_normal_bits(e));
    CHECK(square(1, -(k + (edge ? 1 : 0)), flush) == 0);
    CHECK(square(1, -k + (edge ? 0 : 1), flush) >= min_normal_bits(e));
    // 2^(ulp - 1) is a tie between 0 and the smallest number, and 0 is even: its root is the border.
    const int tie = min_ulp_exponent(e) - 1;
    CHECK(exactly(e, false, 1, tie) == 0);
    const auto root = static_cast<std::uint64_t>(std::floor(std::sqrt(std::ldexp(1.0, 40 + (tie & 1)))));
    const int exponent = (tie - 40 - (tie & 1)) / 2;
    CHECK(square(root, exponent, {}) == 0);
    CHECK(square(root + 1, exponent, {}) == 1);
  }
  CHECK(encode(binary16::value, 0x1p-14) == min_normal_bits(binary16::value));
  CHECK(encode(binary16::value, 0x1.ff8p-8 * 0x1.ff8p-8) < min_normal_bits(binary16::value));
  CHECK(encode(binary16::value, 0x1.6a1p-13 * 0x1.6a1p-13) == 1);
  CHECK(encode(binary16::value, 0x1.6ap-13 * 0x1.6ap-13) == 0);
}

TEST_CASE("hard case 19: equal steps lose the squares of small depths; unorm16 all up to 181/65535") {
  for (const encoding& e : steps()) {
    // c^2 / one in steps is 0 while c^2 < one / 2, an even tie included.
    const double one = one_in(e);
    auto c = static_cast<std::uint64_t>(std::sqrt(one / 2));
    while (static_cast<double>(c + 1) * static_cast<double>(c + 1) <= one / 2) ++c;
    INFO(name_of(e) << ": up to code " << c);
    CHECK(multiply(e, c, c) == 0);
    CHECK(multiply(e, c + 1, c + 1) == 1);
    for (std::uint64_t below = 0; below < c; below += c / 64 + 1) CHECK(multiply(e, below, below) == 0);
  }
  const auto square = [](double x) { return encode(unorm16::value, x * x); };
  CHECK(square(0x1p-8) == 1);
  for (int c = 0; c <= 181; ++c) CHECK(square(c / 65535.0) == 0);
  CHECK(square(182.0 / 65535) == 1);
}

TEST_CASE("hard case 20: truncating a store is biased by half a step in every format, rounding to nearest is not") {
  std::vector<encoding> formats = steps();
  for (const encoding& e : named({"binary16", "bfloat16", "binary32", "fp8_e5m2", "fp8_e4m3", "e9m6"})) formats.push_back(e);
  for (const encoding& e : formats) {
    double bias[2] = {0, 0};
    constexpr int n = 20000;
    for (std::uint64_t i = 0; i < n; ++i) {
      const double x = static_cast<double>(random_bits(20, i) >> 11) * 0x1p-53;
      // A float's step is that of x's binade.
      const double step = e.kind == family::binary ? std::ldexp(1.0, std::max(std::ilogb(x), min_exponent(e)) - e.fraction_bits)
                                                   : 1 / one_in(e);
      bias[0] += (round_to(e, x) - x) / step;
      bias[1] += (round_to(e, x, rules{rounding::toward_zero}) - x) / step;
    }
    // In steps: nearest 0 +- 0.29/sqrt(n), truncated -1/2. Five standard deviations are 0.0103.
    INFO(name_of(e) << ": " << bias[0] / n << " and " << bias[1] / n << " steps");
    CHECK(std::abs(bias[0] / n) < 0.0103);
    CHECK(std::abs(bias[1] / n + 0.5) < 0.0103);
  }
}

TEST_CASE("hard case 39: signed zeros, the ends of subnormals, and the largest number and half a step, in every float") {
  for (const encoding& e : floats()) {
    const std::uint64_t sign = sign_bit(e), least = min_normal_bits(e), most = max_bits(e);
    const std::uint64_t beyond = has_infinity(e) ? infinity_bits(e) : nan_bits(e);
    const int ulp = min_ulp_exponent(e);
    INFO(name_of(e));
    CHECK(encode(e, -0.0) == sign);
    CHECK(subtract(e, least, least) == 0);
    CHECK(subtract(e, least, least, rules{rounding::down}) == sign);
    CHECK(add(e, sign, sign) == sign);
    CHECK(add(e, sign, 0) == 0);
    CHECK(multiply(e, sign, least) == sign);
    CHECK(square_root(e, sign) == sign);
    // Half a step below the smallest normal number, in quarters of a step: a tie, and 2^(M+1) is even.
    CHECK(exactly(e, false, 4 * least - 1, ulp - 2) == least);
    CHECK(exactly(e, false, 4 * least - 2, ulp - 2) == least);
    CHECK(exactly(e, false, 4 * least - 3, ulp - 2) == least - 1);
    CHECK(exactly(e, true, 2, ulp - 2) == sign);
    CHECK(exactly(e, true, 3, ulp - 2) == (sign | 1));
    rules flush;
    flush.subnormal = subnormals::flush_output;
    CHECK(exactly(e, true, 4 * least - 2, ulp - 2, flush) == (sign | least));
    CHECK(exactly(e, true, 4 * least - 3, ulp - 2, flush) == sign);
    // The largest number's significand in quarters of its step.
    const std::uint64_t n = 4 * ((most & low_bits(e.fraction_bits)) | (std::uint64_t{1} << e.fraction_bits));
    const int top = static_cast<int>(most >> e.fraction_bits) - 1 + ulp - 2;
    const bool odd = (most & 1) != 0;  // a tie goes up from an odd one; OCP's 448 is even
    struct {
      std::uint64_t quarters;
      bool to_largest;
    } const cases[] = {{n + 1, true}, {n + 2, !odd}, {n + 3, false}};
    for (const auto& at : cases) {
      for (const bool negative : {false, true}) {
        const std::uint64_t s = negative ? sign : 0;
        const auto by = [&](rounding d, overflow o) {
          rules r;
          r.direction = d, r.overflow = o;
          return exactly(e, negative, at.quarters, top, r);
        };
        INFO(at.quarters - n << " quarters of a step beyond the largest" << (negative ? ", negative" : ""));
        for (const overflow o : {overflow::ieee, overflow::infinity})
          CHECK(by(rounding::nearest_even, o) == (s | (at.to_largest ? most : beyond)));
        CHECK(by(rounding::nearest_even, overflow::saturate) == (s | most));
        CHECK(by(rounding::nearest_away, overflow::ieee) == (s | (at.quarters < n + 2 ? most : beyond)));
        CHECK(by(rounding::toward_zero, overflow::infinity) == (s | most));  // rounded, it is not beyond
        CHECK(by(negative ? rounding::down : rounding::up, overflow::ieee) == (s | beyond));
        CHECK(by(negative ? rounding::up : rounding::down, overflow::ieee) == (s | most));
        // The neighbours are the largest number and the next step: to odd takes the odd one.
        CHECK(by(rounding::to_odd, overflow::infinity) == (s | (odd ? most : beyond)));
        CHECK(by(rounding::to_odd, overflow::ieee) == (s | most));
        // Twice the largest.
        const auto far = [&](rounding d, overflow o) {
          rules r;
          r.direction = d, r.overflow = o;
          return exactly(e, negative, n, top + 1, r);
        };
        CHECK(far(rounding::toward_zero, overflow::ieee) == (s | most));
        CHECK(far(rounding::toward_zero, overflow::infinity) == (s | beyond));
        CHECK(far(rounding::nearest_even, overflow::saturate) == (s | most));
      }
    }
  }
  CHECK((half(1) - half(1)).bits() == 0);
  CHECK((half(-0.0) + half(-0.0)).bits() == 0x8000);
  CHECK(sqrt(half(-0.0)).bits() == 0x8000);
  CHECK(encode(binary16::value, std::nextafter(65520.0, 0)) == 0x7bff);
  CHECK(encode(binary16::value, 65520) == 0x7c00);
  CHECK(encode(fp8_e4m3::value, 464) == 0x7e);
  CHECK(encode(fp8_e4m3::value, std::nextafter(464.0, 500.0)) == 0x7f);
}

TEST_CASE("hard case 40: snorm has two codes for -1; norms hold 0 and 1 but not one half") {
  for (int n = 2; n <= 32; ++n) {
    const encoding e = snorm_encoding(n);
    const std::uint64_t lowest = sign_bit(e);
    INFO(name_of(e));
    CHECK(decode(e, lowest) == -1);
    CHECK(decode(e, lowest + 1) == -1);
    CHECK(encode(e, -1) == lowest + 1);
    CHECK(encode(e, -2) == lowest + 1);
    CHECK(decode(e, encode(e, 1)) == 1);
    CHECK(encode(e, -0.0) == 0);
    CHECK((n == 2 || decode(e, encode(e, 0.5)) != 0.5));
    // Both codes mean -1 to every operation.
    for (const std::uint64_t other : {std::uint64_t{1}, max_bits(e), lowest, lowest + 1}) {
      CHECK(add(e, lowest, other) == add(e, lowest + 1, other));
      CHECK(multiply(e, lowest, other) == multiply(e, lowest + 1, other));
      CHECK(divide(e, lowest, other) == divide(e, lowest + 1, other));
    }
  }
  for (int n = 1; n <= 32; ++n) {
    const encoding e = unorm_encoding(n);
    INFO(name_of(e));
    CHECK(decode(e, encode(e, 0)) == 0);
    CHECK(decode(e, encode(e, 1)) == 1);
    CHECK(encode(e, 1) == low_bits(n));
    CHECK(decode(e, encode(e, 0.5)) != 0.5);
    // One half lies between two codes, a tie: the even one is the upper one.
    CHECK(encode(e, 0.5) == (n == 1 ? 0 : std::uint64_t{1} << (n - 1)));
    CHECK(encode(e, 0.5, rules{rounding::down}) == low_bits(n) / 2);
    CHECK(encode(e, 0.5, rules{rounding::up}) == low_bits(n) / 2 + 1);
  }
}
