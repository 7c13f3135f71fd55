#include "bulk/make_plan.hpp"

#include <bit>

#include "bitshade/formats/random.hpp"
#include "bitshade/formats/round_to.hpp"

namespace bitshade::bulk {
namespace {

constexpr std::uint64_t golden = 0x9e3779b97f4a7c15u;

/// The magnitude that a code stands for, as the lanes' bits; the code's sign does not matter.
std::uint64_t lane_bits(const encoding& e, std::uint64_t code, bool single) {
  const double x = decode(e, code);
  if (single) return std::bit_cast<std::uint32_t>(static_cast<float>(x)) & 0x7fffffffu;
  return std::bit_cast<std::uint64_t>(x) & low_bits(63);
}

bulk_kernels::lane_numbers numbers(const encoding& e, const bulk_kernels::plan& p, bool single) {
  bulk_kernels::lane_numbers n{};
  for (int s = 0; s < 2; ++s) n.overflow[s] = lane_bits(e, p.overflow_code[s], single);
  n.infinite = lane_bits(e, p.infinite_code, single);
  n.largest = lane_bits(e, p.max_code, single);
  n.min_normal = lane_bits(e, p.min_normal_code, single);
  // Half a unit more still rounds back, if the tie goes to an even largest number.
  const int unit = (single ? 23 : 52) - e.fraction_bits;
  n.limit = n.largest;
  if (unit > 0) n.limit += (std::uint64_t{1} << (unit - 1)) - (p.max_code & 1);
  return n;
}

}  // namespace

bulk_kernels::plan make_plan(const encoding& e, const rules& r, std::uint64_t seed, std::uint64_t first_counter) {
  bulk_kernels::plan p{};
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
  p.random_start = mix64(seed + golden) + golden * first_counter;
  if (e.kind == family::binary) {
    p.bias = bias(e);
    for (int s = 0; s < 2; ++s) p.overflow_code[s] = overflow_bits(e, s != 0, r, false) & ~p.sign;
    p.infinite_code = overflow_bits(e, false, r, true);
    p.single = numbers(e, p, true);
    p.wide = numbers(e, p, false);
    p.plain = e.has_sign && !p.flush_values && !p.canonical_nan && p.overflow_code[0] == p.overflow_code[1] &&
              p.overflow_code[0] == p.infinite_code &&
              // Without infinities a kernel treats overflow and NaN alike.
              (e.special == specials::ieee || p.infinite_code == p.nan_code);
    return p;
  }
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
  p.single_step = static_cast<float>(1 / p.scale);
  return p;
}

void advance(bulk_kernels::plan& p, std::uint64_t offset) {
  p.counter += offset;
  p.random_start += golden * offset;
}

}  // namespace bitshade::bulk
