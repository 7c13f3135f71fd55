// A structured sample of 10^9 fused multiply-adds of binary16 against integers: operations.hpp in six directions, real
// and the bulk kernel to nearest even. The inputs crowd where roundings go wrong: ties, cancellation, both ends.
#include <array>
#include <vector>

#include "bitshade/arithmetic/bulk.hpp"
#include "bitshade/arithmetic/operations.hpp"
#include "bitshade/arithmetic/real.hpp"
#include "bitshade/formats/random.hpp"
#include "integer_half.hpp"
#include "support/operation_oracle.hpp"
#include "tally.hpp"

using namespace bitshade;
using half = real<binary16>;
using code = std::uint16_t;

namespace {

struct triple {
  code a, b, c;
};

code make(unsigned sign, int exponent, unsigned fraction) {
  const int field = exponent + 15;
  if (field <= 0) return static_cast<code>((sign << 15) | ((0x400u | (fraction & 0x3ff)) >> std::min(1 - field, 12)));
  return static_cast<code>((sign << 15) | (static_cast<unsigned>(std::min(field, 30)) << 10) | (fraction & 0x3ff));
}

/// The inverse of an odd number modulo 2^10: Newton's step doubles the bits that are right.
unsigned inverse(unsigned odd) {
  unsigned x = odd;
  for (int i = 0; i < 3; ++i) x *= 2 - odd * x;
  return x & 0x3ff;
}

constexpr std::array<const char*, 8> kinds{"any codes", "cancellation", "product near half an ulp of the sum",
                                           "product near a tie, small addend", "subnormal results", "overflow's edge",
                                           "boundary codes", "addend one code from the product"};

/// The i-th triple of a kind.
triple draw(std::size_t kind, std::uint64_t i, const std::vector<std::uint64_t>& boundary) {
  std::uint64_t r = random_bits(kind + 1, i);
  const auto take = [&r](int bits) {
    const auto x = static_cast<unsigned>(r & ((1u << bits) - 1));
    r >>= bits;
    return x;
  };
  const auto exponent = [&take](int low, int high) { return low + static_cast<int>(take(8) % static_cast<unsigned>(high - low + 1)); };
  const unsigned signs = take(3), other = (signs >> 1) & 1;
  switch (kind) {
    case 1:
    case 7: {
      const code a = make(signs & 1, exponent(-14, 8), take(10)), b = make(other, exponent(-10, 6), take(10));
      const code product = integer_half::fma(a, b, 0, rounding::toward_zero);
      // Minus the product, its low bits changed, or one code beside it.
      const unsigned change = kind == 1 ? take(4) : 0, step = kind == 7 ? take(2) : 1;
      return {a, b, static_cast<code>(((product ^ 0x8000) + step - 1) ^ change)};
    }
    case 2: {
      // c's last place is 2^(e - 10): a b is half of it, give or take a few units of the product's own last place.
      const int e = exponent(-3, 15), k = exponent(-8, 8);
      return {make(signs & 1, k, take(2)), make(other, e - 11 - k, take(1) ? take(2) : 0x3ffu - take(2)),
              make(signs >> 2, e, take(10))};
    }
    case 3: {
      const unsigned odd = 0x400 | take(10) | 1, near = 512 - 4 + take(3);
      const unsigned b = inverse(odd) * near & 0x3ff;
      const int k = exponent(-6, 6), l = exponent(-6, 6);
      return {make(signs & 1, k, odd), make(other, l, b), make(signs >> 2, k + l - 11 - exponent(0, 12), take(10))};
    }
    case 4: {
      const int k = exponent(-14, 0);
      return {make(signs & 1, k, take(10)), make(other, -16 - k - exponent(0, 10), take(10)),
              make(signs >> 2, -14 - exponent(0, 11), take(10))};
    }
    case 5: {
      const int k = exponent(1, 14);
      return {make(signs & 1, k, take(1) ? take(10) : 0x3ffu - take(3)), make(other, 15 - k, take(1) ? take(3) : 0x3ffu - take(3)),
              make(signs >> 2, exponent(0, 15), take(10))};
    }
    case 6: {
      const auto pick = [&] { return static_cast<code>(boundary[take(16) % boundary.size()]); };
      const code a = pick(), b = pick();
      return {a, b, pick()};
    }
    default: return {static_cast<code>(take(16)), static_cast<code>(take(16)), static_cast<code>(take(16))};
  }
}

/// Flattened: with the encoding known in all that it calls, the definition takes half of the time.
[[gnu::flatten]] std::uint64_t define(code a, code b, code c, const rules& r) {
  return fused_multiply_add(binary16::value, a, b, c, r);
}

void sample(std::size_t kind, std::uint64_t count, verify::report& report) {
  constexpr std::size_t block = 4096;
  const auto boundary = oracle::boundary_codes(binary16::value);
  oracle::calculator truth(binary16::value);
  verify::tally ours, mpfr;
  std::vector<code> a(block), b(block), c(block), got(block);
  for (std::uint64_t at = 0; at < count; at += block) {
    for (std::size_t i = 0; i < block; ++i) {
      const triple t = draw(kind, at + i, boundary);
      a[i] = t.a, b[i] = t.b, c[i] = t.c;
    }
    bulk::fma(a, b, c, got);
    for (std::size_t i = 0; i < block && at + i < count; ++i) {
      rules r;
      r.direction = static_cast<rounding>((at + i) % 6);
      const code nearest = integer_half::fma(a[i], b[i], c[i], rounding::nearest_even);
      const code want = r.direction == rounding::nearest_even ? nearest : integer_half::fma(a[i], b[i], c[i], r.direction);
      const std::uint64_t defined = define(a[i], b[i], c[i], r);
      const code carried = fma(half::from_bits(a[i]), half::from_bits(b[i]), half::from_bits(c[i])).bits();
      ours.expect(defined == want && carried == nearest && got[i] == nearest,
                  "0x%04x * 0x%04x + 0x%04x: operations.hpp, direction %d, 0x%04x for 0x%04x; real 0x%04x, bulk 0x%04x "
                  "for 0x%04x",
                  unsigned{a[i]}, unsigned{b[i]}, unsigned{c[i]}, int(r.direction), static_cast<unsigned>(defined),
                  unsigned{want}, unsigned{carried}, unsigned{got[i]}, unsigned{nearest});
      if ((at + i) % 4099 != 0) continue;
      truth.compute(oracle::operation::fma, a[i], b[i], c[i]);
      const std::uint64_t exact = truth.bits(r);
      mpfr.expect(exact == want, "0x%04x * 0x%04x + 0x%04x, direction %d: integers 0x%04x, MPFR 0x%04x", unsigned{a[i]},
                  unsigned{b[i]}, unsigned{c[i]}, int(r.direction), unsigned{want}, static_cast<unsigned>(exact));
    }
  }
  report.line(std::string("fma, ") + kinds[kind], ours);
  report.line("  the integers = MPFR, a part of them", mpfr);
}

}  // namespace

int main(int argc, char* argv[]) {
  const std::uint64_t stride = verify::every(argc, argv);
  if (stride == 0) return std::fputs("usage: verify_fma [--every N]\n", stderr), 2;
  verify::report report;
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) sample(kind, 125'000'000 / stride, report);
  return report.status();
}
