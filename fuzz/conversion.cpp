// A format, rules and a number, all of them arbitrary: encode and decode against MPFR.
//
//   byte 0, 1  bits of exponent and fraction, or of a norm or fixed point
//   byte 2     direction, overflow and subnormals, one of 84
//   byte 3     the family (0: binary), and how many random bits
//   4 to 11    the number; 12 to 19, if there, the random bits
#include <mpfr.h>

#include <bit>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "bitshade/formats/name.hpp"
#include "bitshade/formats/round_to.hpp"
#include "support/mpfr_oracle.hpp"

using namespace bitshade;

namespace {

encoding format_of(unsigned kind, int a, int b) {
  switch (kind) {
    case 1: return unsigned_binary_encoding(2 + a % 10, 1 + b % 52);
    case 2: return e4m3_encoding();
    case 3: return unorm_encoding(1 + a % 32);
    case 4: return snorm_encoding(2 + a % 31);
    case 5: return ufixed_encoding(1 + a % 32, b % 33);
    case 6: return fixed_encoding(1 + a % 32, 1 + b % 32);
    default: return binary_encoding(2 + a % 10, 1 + b % 52);
  }
}

[[noreturn]] void differ(const char* what, const encoding& e, const rules& r, double x, std::uint64_t got,
                         std::uint64_t want) {
  std::fprintf(stderr, "%s of %a in %s, direction %d, overflow %d, subnormals %d: got 0x%llx, MPFR has 0x%llx\n", what, x,
               name_of(e).c_str(), int(r.direction), int(r.overflow), int(r.subnormal),
               static_cast<unsigned long long>(got), static_cast<unsigned long long>(want));
  std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 12) return 0;
  const encoding e = format_of(data[3] % 8u, data[0], data[1]);
  rules r;
  r.direction = static_cast<rounding>(data[2] % 7);
  r.overflow = static_cast<overflow>(data[2] / 7 % 3);
  r.subnormal = static_cast<subnormals>(data[2] / 21 % 4);
  r.nan = nan_payload::canonical;
  r.random_bits = 64 - data[3] / 8;
  double x = 0;
  std::uint64_t random = 0;
  std::memcpy(&x, data + 4, 8);
  if (size >= 20) std::memcpy(&random, data + 12, 8);

  oracle::number exact(64), value(320);
  mpfr_set_d(exact, x, MPFR_RNDN);
  oracle::rounder truth(e);
  truth.set(exact);
  truth.round(r.direction, random, r.random_bits);
  const std::uint64_t bits = encode(e, x, r, random), want = truth.bits(flushes_output(r.subnormal), r.overflow);
  if (bits != want) differ("encode", e, r, x, bits, want);

  const double back = decode(e, bits);
  oracle::value(value, e, bits);
  const double nearest = mpfr_get_d(value, MPFR_RNDN);
  if (mpfr_nan_p(value) != 0) {
    if (back == back) std::abort();
    return 0;
  }
  if (std::bit_cast<std::uint64_t>(back) != std::bit_cast<std::uint64_t>(nearest))
    differ("decode", e, r, x, std::bit_cast<std::uint64_t>(back), std::bit_cast<std::uint64_t>(nearest));
  // Numbers that a binary64 holds come back to the nearest: the others are ratios and 64-bit integers.
  if (e.width <= 53 && encode(e, back) != bits) differ("encode of decode", e, r, back, encode(e, back), bits);
  const double read = decode(e, bits, r);
  const bool subnormal = e.kind == family::binary && (bits & ~sign_bit(e)) < min_normal_bits(e);
  if (read != (subnormal && flushes_input(r.subnormal) ? 0 : nearest)) std::abort();
  return 0;
}
