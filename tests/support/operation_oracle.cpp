#include "support/operation_oracle.hpp"

#include <algorithm>

#include "bitshade/arithmetic/operations.hpp"

namespace oracle {

using bitshade::encoding;
using bitshade::family;

namespace {

bool normalised(const encoding& e) { return e.kind == family::unorm || e.kind == family::snorm; }

/// A norm's code as an integer; the value otherwise. `one` is what stands for 1.
void load(mpfr_ptr x, const encoding& e, std::uint64_t bits) {
  if (!normalised(e)) return value(x, e, bits);
  const encoding whole = e.kind == family::snorm ? bitshade::fixed_encoding(e.width, 0) : bitshade::ufixed_encoding(e.width, 0);
  value(x, whole, bits);
  if (e.kind == family::snorm && mpfr_cmp_si(x, -static_cast<long>(bitshade::max_bits(e))) < 0)
    mpfr_set_si(x, -static_cast<long>(bitshade::max_bits(e)), MPFR_RNDN);
}

}  // namespace

void calculator::compute(operation op, std::uint64_t a, std::uint64_t b, std::uint64_t c) {
  load(a_, e_, a);
  load(b_, e_, b);
  load(c_, e_, c);
  zero_of_unlike_signs_ = false;
  if (normalised(e_)) return compute_steps(op);
  mpfr_set_prec(exact_, 320);
  mpfr_ptr result = wide_;
  switch (op) {
    case operation::add: mpfr_add(wide_, a_, b_, MPFR_RNDZ); break;
    case operation::subtract: mpfr_sub(wide_, a_, b_, MPFR_RNDZ); break;
    case operation::multiply: mpfr_mul(wide_, a_, b_, MPFR_RNDZ); break;
    case operation::divide: make_odd(result = exact_, mpfr_div(exact_, a_, b_, MPFR_RNDZ)); break;
    case operation::square_root: make_odd(result = exact_, mpfr_sqrt(exact_, a_, MPFR_RNDZ)); break;
    case operation::fma: mpfr_fma(wide_, a_, b_, c_, MPFR_RNDZ); break;
  }
  const bool sum = op == operation::add || op == operation::subtract || op == operation::fma;
  if (sum && mpfr_zero_p(result) != 0 && mpfr_number_p(a_) != 0) {
    // MPFR's zero of a sum is +0 toward zero; only where both terms are -0 is -0 right in every direction.
    number first(128), second(64);
    mpfr_set(first, a_, MPFR_RNDN);
    if (op == operation::fma) mpfr_mul(first, a_, b_, MPFR_RNDN);
    mpfr_set(second, op == operation::fma ? c_ : b_, MPFR_RNDN);
    if (op == operation::subtract) mpfr_neg(second, second, MPFR_RNDN);
    zero_of_unlike_signs_ = (mpfr_signbit(first) != 0) != (mpfr_signbit(second) != 0);
  }
  rounder_.set(result);
}

/// a, b and c count steps of 1 / one; so does the result.
void calculator::compute_steps(operation op) {
  const auto one = static_cast<unsigned long>(bitshade::max_bits(e_));
  mpfr_set_prec(exact_, 320);
  switch (op) {
    case operation::add: mpfr_add(exact_, a_, b_, MPFR_RNDZ); break;
    case operation::subtract: mpfr_sub(exact_, a_, b_, MPFR_RNDZ); break;
    case operation::multiply:
      mpfr_mul(wide_, a_, b_, MPFR_RNDZ);
      make_odd(exact_, mpfr_div_ui(exact_, wide_, one, MPFR_RNDZ));
      break;
    case operation::divide:
      mpfr_mul_ui(wide_, a_, one, MPFR_RNDZ);
      make_odd(exact_, mpfr_div(exact_, wide_, b_, MPFR_RNDZ));
      break;
    case operation::square_root:
      mpfr_mul_ui(wide_, a_, one, MPFR_RNDZ);
      make_odd(exact_, mpfr_sqrt(exact_, wide_, MPFR_RNDZ));
      break;
    case operation::fma:
      mpfr_mul_ui(c_, c_, one, MPFR_RNDZ);
      mpfr_fma(wide_, a_, b_, c_, MPFR_RNDZ);
      make_odd(exact_, mpfr_div_ui(exact_, wide_, one, MPFR_RNDZ));
      break;
  }
  rounder_.set_steps(exact_);
}

std::uint64_t calculator::bits(const bitshade::rules& r) {
  const std::uint64_t bits = rounder_.bits(r.direction, bitshade::flushes_output(r.subnormal), r.overflow);
  if (zero_of_unlike_signs_ && e_.kind == family::binary && r.direction == bitshade::rounding::down)
    return bits | bitshade::sign_bit(e_);
  return bits;
}

std::uint64_t computed(operation op, const encoding& e, std::uint64_t a, std::uint64_t b, std::uint64_t c,
                       const bitshade::rules& r) {
  switch (op) {
    case operation::add: return bitshade::add(e, a, b, r);
    case operation::subtract: return bitshade::subtract(e, a, b, r);
    case operation::multiply: return bitshade::multiply(e, a, b, r);
    case operation::divide: return bitshade::divide(e, a, b, r);
    case operation::square_root: return bitshade::square_root(e, a, r);
    case operation::fma: return bitshade::fused_multiply_add(e, a, b, c, r);
  }
  return 0;
}

std::vector<std::uint64_t> boundary_codes(const encoding& e) {
  std::vector<std::uint64_t> codes;
  const auto around = [&](std::uint64_t c) {
    for (const std::uint64_t x : {c - 1, c, c + 1}) codes.push_back(x & bitshade::low_bits(e.width));
  };
  around(0);
  around(bitshade::min_normal_bits(e));
  around(bitshade::max_bits(e));
  around(bitshade::max_bits(e) / 2);
  around(bitshade::low_bits(e.fraction_bits) / 2);
  if (e.kind == family::binary) {
    around(bitshade::nan_bits(e));
    for (const int power : {-1, 0, 1, e.fraction_bits, -e.fraction_bits, bitshade::bias(e) / 2, -bitshade::bias(e) / 2})
      around(bitshade::encode(e, std::bit_cast<double>(static_cast<std::uint64_t>(1023 + power) << 52)));
  }
  const std::size_t positive = codes.size();
  if (e.has_sign) {
    for (std::size_t i = 0; i < positive; ++i) codes.push_back(codes[i] ^ bitshade::sign_bit(e));
  }
  std::sort(codes.begin(), codes.end());
  codes.erase(std::unique(codes.begin(), codes.end()), codes.end());
  return codes;
}

}  // namespace oracle
