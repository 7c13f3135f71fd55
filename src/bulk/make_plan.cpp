#include "bulk/make_plan.hpp"

#include "bitshade/formats/random.hpp"
#include "bitshade/formats/encode.hpp"
#include "bulk/float_environment.hpp"

namespace bitshade::bulk {
namespace {

/// Whether a direction goes away from zero where the magnitude is too large.
bool leaves(rounding d, bool negative) {
  switch (d) {
    case rounding::toward_zero:
    case rounding::to_odd: return false;
    case rounding::up: return !negative;
    case rounding::down: return negative;
    default: return true;
  }
}

/// Where the plan's first element finds its random bits.
void start_random(bulk_kernels::plan& p) {
  if (p.direction != rounding::stochastic) return;
  for (int k = 0; k < 2; ++k) {
    const auto stream = rounding_stream::of(p.seed, p.counter, 0, k != 0);
    p.random_start[k] = stream.start, p.random_middle[k] = stream.middle;
  }
  p.random_weyl = rounding_stream::weyl;
  for (int k = 0; k < 3; ++k) p.random_factors[k] = rounding_stream::mixers[k];
  p.random_step = rounding_stream::step_of(p.counter & ~std::uint64_t{31});
}

/// The numbers of an encoding, seen from lanes with F fraction bits and the given exponent bits. They are made with a
/// few integer operations, so that short spans are worth a call; tests hold the kernels against decode.
bulk_kernels::lane_numbers numbers(const encoding& e, const bulk_kernels::plan& p, int fraction, int exponent_bits) {
  bulk_kernels::lane_numbers n{};
  const std::uint64_t infinity = low_bits(exponent_bits) << fraction;
  n.magnitude = low_bits(exponent_bits + fraction);
  n.infinity = infinity;
  const int unit = fraction - e.fraction_bits;
  if (unit < 0) return n;  // no kernel of these lanes can take it
  const std::uint64_t quiet = infinity | std::uint64_t{1} << (fraction - 1);
  const int lane_bias = (1 << (exponent_bits - 1)) - 1;
  const auto bits_of = [&](std::uint64_t code) {
    if (code > p.max_code) return code == p.nan_code ? quiet : infinity;
    const std::int64_t field = static_cast<std::int64_t>(code >> e.fraction_bits) + lane_bias - p.bias;
    if (field <= 0) return std::uint64_t{0};
    const std::uint64_t bits = (static_cast<std::uint64_t>(field) << fraction) |
                               (code & low_bits(e.fraction_bits)) << unit;
    return bits < infinity ? bits : infinity;
  };
  for (int s = 0; s < 2; ++s) n.overflow[s] = bits_of(p.overflow_code[s]);
  n.infinite = bits_of(p.infinite_code);
  n.largest = bits_of(p.max_code);
  n.min_normal = bits_of(p.min_normal_code);
  // Half a unit more still rounds back, if the tie goes to an even largest number.
  n.limit = n.largest;
  if (unit > 0) n.limit += (std::uint64_t{1} << (unit - 1)) - (p.max_code & 1);
  const std::uint64_t beyond = e.special == specials::ieee ? infinity : quiet;
  n.natural_overflow = n.infinite == beyond;
  for (int s = 0; s < 2; ++s) {
    n.natural_overflow = n.natural_overflow && n.overflow[s] == (leaves(p.direction, s != 0) ? beyond : n.largest);
  }
  return n;
}

}  // namespace

void make_plan(bulk_kernels::plan& p, const encoding& e, const rules& r, std::uint64_t seed,
               std::uint64_t first_counter) {
  p.format = e;
  p.rule = r;
  p.kind = e.kind;
  p.special = e.special;
  p.direction = r.direction;
  p.norm = r.norm;
  p.exponent_bits = e.exponent_bits;
  p.fraction_bits = e.fraction_bits;
  p.width = e.width;
  p.random_bits = r.random_bits;
  p.has_sign = e.has_sign;
  p.flush_codes = flushes_output(r.subnormal);
  p.flush_loads = flushes_input(r.subnormal);
  p.flush_values = p.flush_codes || p.flush_loads;
  p.canonical_nan = r.nan == nan_payload::canonical;
  p.sign = sign_bit(e);
  p.max_code = max_bits(e);
  p.nan_code = nan_bits(e);
  p.min_normal_code = min_normal_bits(e);
  p.seed = seed;
  p.counter = first_counter;
  start_random(p);
  if (e.kind == family::binary) {
    p.bias = bias(e);
    for (int s = 0; s < 2; ++s) p.overflow_code[s] = overflow_bits(e, s != 0, r, false) & ~p.sign;
    p.infinite_code = overflow_bits(e, false, r, true);
    p.single = numbers(e, p, 23, 8);
    p.wide = numbers(e, p, 52, 11);
    p.keeps = e.has_sign && !p.flush_values && !p.canonical_nan;
    p.one_overflow = p.overflow_code[0] == p.overflow_code[1] && p.overflow_code[0] == p.infinite_code &&
                     (e.special == specials::ieee || p.infinite_code == p.nan_code);
    return;
  }
  const float_environment environment(float_environment::direction::nearest);
  const double last = static_cast<double>(p.max_code);
  p.scale = last;
  p.high = 1;
  p.low = e.kind == family::snorm ? -1 : 0;
  if (e.kind == family::fixed || e.kind == family::ufixed) {
    p.scale = static_cast<double>(std::uint64_t{1} << (e.fraction_bits < 63 ? e.fraction_bits : 63));
    if (e.fraction_bits == 64) p.scale *= 2;
    p.high = last / p.scale;
    p.low = e.kind == family::fixed ? -(last + 1) / p.scale : 0;
  }
  p.wide_step = 1 / p.scale;
  p.single_step = static_cast<float>(p.wide_step);
  const bool exact = p.norm == norm_decode::exact;
  p.single_rest = exact ? static_cast<float>(p.wide_step - double{p.single_step}) : 0;
}

void advance(bulk_kernels::plan& p, std::uint64_t offset) {
  p.counter += offset;
  start_random(p);
}

}  // namespace bitshade::bulk
