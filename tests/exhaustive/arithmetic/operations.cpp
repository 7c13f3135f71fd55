// + - x / sqrt fma of every kind of format against MPFR: all boundary codes with each other, and a dense sample.
#include "bitshade/arithmetic/operations.hpp"

#include "bitshade/formats/name.hpp"
#include "bitshade/formats/random.hpp"
#include "support/catch.hpp"
#include "support/operation_oracle.hpp"

using namespace bitshade;
using oracle::operation;

namespace {

constexpr rounding directions[] = {rounding::nearest_even, rounding::nearest_away, rounding::toward_zero,
                                   rounding::up,           rounding::down,         rounding::to_odd};
constexpr overflow overflows[] = {overflow::ieee, overflow::infinity, overflow::saturate};

constexpr subnormals subnormal_policies[] = {subnormals::preserve, subnormals::flush_output, subnormals::flush_input,
                                             subnormals::flush_both};

/// A subnormal operand as a zero of its sign, where it is flushed.
std::uint64_t operand_of(const encoding& e, std::uint64_t bits, bool flush) {
  const bool subnormal = e.kind == family::binary && ((bits >> e.fraction_bits) & low_bits(e.exponent_bits)) == 0;
  return flush && subnormal ? bits & sign_bit(e) : bits;
}

struct checker {
  explicit checker(const encoding& format) : e(format), kept(format), flushed(format) {}

  /// One operation in the policy whose turn it is, or in twelve of them; 72 make the round.
  void check(operation op, std::uint64_t a, std::uint64_t b, std::uint64_t c, bool many) {
    kept.compute(op, a, b, c);
    const auto zeroed = [&](std::uint64_t bits) { return operand_of(e, bits, true); };
    const bool same = zeroed(a) == a && zeroed(b) == b && zeroed(c) == c;
    if (!same) flushed.compute(op, zeroed(a), zeroed(b), zeroed(c));
    for (int i = 0; i < (many ? 12 : 1); ++i) {
      const std::uint64_t k = turn++;
      rules r;
      r.direction = directions[k % 6];
      r.overflow = overflows[k / 6 % 3];
      r.subnormal = subnormal_policies[(k + k / 18) % 4];
      oracle::calculator& truth = same || !flushes_input(r.subnormal) ? kept : flushed;
      const std::uint64_t want = truth.bits(r), got = oracle::computed(op, e, a, b, c, r);
      ++seen;
      zeros += !same && flushes_input(r.subnormal);
      if (got == want || wrong++ != 0) continue;
      first = name_of(e) + ", operation " + std::to_string(int(op)) + " of " + oracle::hex(a) + ' ' + oracle::hex(b) +
              ' ' + oracle::hex(c) + ", direction " + std::to_string(int(r.direction)) + ", subnormals " +
              std::to_string(int(r.subnormal)) + ": got " + oracle::hex(got) + ", MPFR has " + oracle::hex(want);
    }
  }
  void finish() const {
    INFO(wrong << " of " << seen << " wrong; the first: " << first);
    CHECK(seen > 0);
    CHECK(wrong == 0);
  }

  encoding e;
  oracle::calculator kept, flushed;
  std::uint64_t turn = 0, seen = 0, wrong = 0, zeros = 0;
  std::string first;
};

constexpr operation binary_operations[] = {operation::add, operation::subtract, operation::multiply, operation::divide};

}  // namespace

TEST_CASE("all pairs of boundary codes agree with MPFR in every format") {
  for (const char* name : {"binary16", "bfloat16", "tf32", "binary32", "binary64", "e11m4", "e2m13", "e6m30", "ue5m6",
                           "unorm8", "unorm16", "unorm32", "snorm16", "fixed4.12", "ufixed0.16", "ufixed20.12"}) {
    checker c(parse_encoding(name).value());
    const auto codes = oracle::boundary_codes(c.e);
    for (const std::uint64_t a : codes) {
      c.check(operation::square_root, a, 0, 0, true);
      for (const std::uint64_t b : codes) {
        for (const operation op : binary_operations) c.check(op, a, b, 0, false);
        c.check(operation::fma, a, b, codes[c.turn % codes.size()], false);
      }
    }
    c.finish();
  }
}

TEST_CASE("every code of every 16-bit float is an operand as MPFR has it, flushed or not") {
  for (int exponent = 2; exponent <= 11; ++exponent) {
    for (const encoding& e : {binary_encoding(exponent, 15 - exponent), unsigned_binary_encoding(exponent, 16 - exponent)}) {
      checker c(e);
      const auto others = oracle::boundary_codes(e);
      for (std::uint64_t a = 0; a < 65536; ++a) {
        const std::uint64_t b = others[a % others.size()], z = others[a / 7 % others.size()];
        const operation op = static_cast<operation>(a % 11 % 6);
        if (a % 2 == 0) c.check(op, a, b, z, false);
        else c.check(op, b, a, z, false);
      }
      CHECK(c.zeros > (std::uint64_t{1} << e.fraction_bits) / 8);
      c.finish();
    }
  }
}

TEST_CASE("all pairs of 8-bit floats agree with MPFR") {
  for (const encoding& e : {e4m3_encoding(), binary_encoding(5, 2), binary_encoding(2, 5)}) {
    checker c(e);
    for (std::uint64_t a = 0; a < 256; ++a) {
      c.check(operation::square_root, a, 0, 0, true);
      for (std::uint64_t b = 0; b < 256; ++b) c.check(binary_operations[(a + b) % 4], a, b, 0, false);
    }
    c.finish();
  }
}

TEST_CASE("all square roots of binary16 agree with MPFR in every direction") {
  checker c(binary16::value);
  for (std::uint64_t a = 0; a < 65536; ++a) c.check(operation::square_root, a, 0, 0, true);
  c.finish();
}

TEST_CASE("random operations agree with MPFR") {
  for (const char* name : {"binary16", "bfloat16", "tf32", "binary32", "binary64", "e11m10", "e9m40", "unorm12", "snorm24",
                           "fixed8.24", "ufixed30.34"}) {
    checker c(parse_encoding(name).value());
    for (std::uint64_t i = 0; i < 40000; ++i) {
      const std::uint64_t a = random_bits(1, i) & low_bits(c.e.width);
      std::uint64_t b = random_bits(2, i) & low_bits(c.e.width), z = random_bits(3, i) & low_bits(c.e.width);
      // Every other time near each other, so that sums cancel and exponents meet.
      if (c.e.kind == family::binary && i % 2 == 0)
        b = (a ^ (b & (sign_bit(c.e) | low_bits(c.e.fraction_bits)))) & low_bits(c.e.width);
      if (i % 4 == 0) z = multiply(c.e, a, b) ^ sign_bit(c.e);
      c.check(binary_operations[i % 4], a, b, 0, false);
      c.check(operation::fma, a, b, z, false);
    }
    c.finish();
  }
}
