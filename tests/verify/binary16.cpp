// All 2^32 pairs of binary16 through + - x /, and all square roots: operations.hpp, real and the bulk kernels against
// the processor's own operations; a part of the pairs, and every root in every direction, against MPFR.
#include <array>
#include <vector>

#include "bitshade/arithmetic/bulk.hpp"
#include "bitshade/arithmetic/operations.hpp"
#include "bitshade/arithmetic/real.hpp"
#include "hardware.hpp"
#include "support/operation_oracle.hpp"
#include "tally.hpp"

using namespace bitshade;
using half = real<binary16>;

namespace {

struct operation {
  const char* name;
  oracle::operation mpfr;
  hardware::operation theirs;
  std::uint64_t (*define)(std::uint64_t, std::uint64_t, const rules&);
  half (*in_real)(half, half);
  void (*in_bulk)(bulk::half_codes, bulk::half_codes, std::span<std::uint16_t>, const bulk::execution&);
};

// Flattened: with the encoding known in all that they call, the definitions take half of the time.
constexpr encoding e = binary16::value;
using code = std::uint64_t;
[[gnu::flatten]] code define_add(code a, code b, const rules& r) { return add(e, a, b, r); }
[[gnu::flatten]] code define_subtract(code a, code b, const rules& r) { return subtract(e, a, b, r); }
[[gnu::flatten]] code define_multiply(code a, code b, const rules& r) { return multiply(e, a, b, r); }
[[gnu::flatten]] code define_divide(code a, code b, const rules& r) { return divide(e, a, b, r); }

const operation operations[] = {
    {"+", oracle::operation::add, hardware::add, define_add, [](half a, half b) { return a + b; }, bulk::add},
    {"-", oracle::operation::subtract, hardware::subtract, define_subtract, [](half a, half b) { return a - b; }, bulk::subtract},
    {"x", oracle::operation::multiply, hardware::multiply, define_multiply, [](half a, half b) { return a * b; }, bulk::multiply},
    {"/", oracle::operation::divide, hardware::divide, define_divide, [](half a, half b) { return a / b; }, bulk::divide},
};

/// Every `stride`-th second operand of each first one.
void all_pairs(const operation& op, std::uint64_t stride, verify::report& report) {
  verify::tally ours, mpfr;
  oracle::calculator truth(binary16::value);
  std::vector<std::uint16_t> first, b, want, got;
  for (std::uint32_t a = 0; a < 65536; ++a) {
    b.clear();
    for (std::uint64_t j = a % stride; j < 65536; j += stride) b.push_back(static_cast<std::uint16_t>(j));
    const std::size_t n = b.size();
    b.resize((n + 3) / 4 * 4);  // the hardware takes four at a time
    first.assign(b.size(), static_cast<std::uint16_t>(a));
    want.resize(b.size());
    got.resize(b.size());
    op.theirs(static_cast<std::uint16_t>(a), b.data(), want.data(), b.size());
    op.in_bulk(first, b, got, {});
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint64_t defined = op.define(a, b[i], {});
      const std::uint16_t carried = op.in_real(half::from_bits(static_cast<std::uint16_t>(a)), half::from_bits(b[i])).bits();
      ours.expect(defined == want[i] && carried == want[i] && got[i] == want[i],
                  "0x%04x %s 0x%04x: operations.hpp 0x%04x, real 0x%04x, bulk 0x%04x, the processor 0x%04x", a, op.name,
                  unsigned{b[i]}, static_cast<unsigned>(defined), unsigned{carried}, unsigned{got[i]}, unsigned{want[i]});
    }
    // A prime step, so that every code meets every exponent.
    constexpr std::size_t step = 4099;
    for (std::size_t i = a * 31 % step; i < n; i += step) {
      truth.compute(op.mpfr, a, b[i]);
      const std::uint64_t exact = truth.bits({});
      mpfr.expect(exact == want[i], "0x%04x %s 0x%04x: the processor 0x%04x, MPFR 0x%04x", a, op.name, unsigned{b[i]},
                  unsigned{want[i]}, static_cast<unsigned>(exact));
    }
  }
  report.line(std::string("binary16 ") + op.name + ": definition, real, bulk = processor", ours);
  report.line(std::string("binary16 ") + op.name + ": processor = MPFR, a part of them", mpfr);
}

/// Boundary codes with each other, in every direction: MPFR alone.
void boundary_pairs(verify::report& report) {
  const auto codes = oracle::boundary_codes(binary16::value);
  oracle::calculator truth(binary16::value);
  verify::tally t;
  for (const operation& op : operations) {
    for (const std::uint64_t a : codes) {
      for (const std::uint64_t b : codes) {
        truth.compute(op.mpfr, a, b);
        for (int d = 0; d < 6; ++d) {
          rules r;
          r.direction = static_cast<rounding>(d);
          const std::uint64_t got = op.define(a, b, r), want = truth.bits(r);
          t.expect(got == want, "0x%04x %s 0x%04x, direction %d: got 0x%04x, MPFR 0x%04x", static_cast<unsigned>(a),
                   op.name, static_cast<unsigned>(b), d, static_cast<unsigned>(got), static_cast<unsigned>(want));
        }
      }
    }
  }
  report.line("binary16: boundary pairs, six directions = MPFR", t);
}

void square_roots(verify::report& report) {
  oracle::calculator truth(binary16::value);
  verify::tally t;
  std::vector<std::uint16_t> in(65536), out(65536);
  for (std::uint32_t a = 0; a < 65536; ++a) in[a] = static_cast<std::uint16_t>(a);
  bulk::sqrt(in, out);
  for (std::uint32_t a = 0; a < 65536; ++a) {
    truth.compute(oracle::operation::square_root, a);
    for (int d = 0; d < 6; ++d) {
      rules r;
      r.direction = static_cast<rounding>(d);
      const std::uint64_t got = square_root(e, a, r), want = truth.bits(r);
      const bool carried = d != 0 || (sqrt(half::from_bits(in[a])).bits() == want && out[a] == want);
      t.expect(got == want && carried, "sqrt 0x%04x, direction %d: operations.hpp 0x%04x, MPFR 0x%04x", a, d,
               static_cast<unsigned>(got), static_cast<unsigned>(want));
    }
  }
  report.line("binary16 sqrt: all, six directions = MPFR", t);
}

}  // namespace

int main(int argc, char* argv[]) {
  const std::uint64_t stride = verify::every(argc, argv);
  if (stride == 0) return std::fputs("usage: verify_binary16 [--every N]\n", stderr), 2;
  verify::report report;
  square_roots(report);
  boundary_pairs(report);
  if (!hardware::has_f16c()) {
    std::puts("this processor has no F16C to compare all pairs with");
    return report.status() != 0 ? report.status() : verify::skipped;
  }
  // a - b is a + (-b): a part of the pairs suffices.
  for (const operation& op : operations) all_pairs(op, *op.name == '-' ? 16 * stride : stride, report);
  return report.status();
}
