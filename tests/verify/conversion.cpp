// All 2^32 numbers of binary32 to binary16: encode and the bulk kernels of every instruction set, in every direction.
// F16C is the oracle of four directions; what the other three are follows from its two neighbours.
#include <bit>
#include <cmath>
#include <vector>

#include "bitshade/arithmetic/bulk.hpp"
#include "bitshade/formats/encode.hpp"
#include "bitshade/formats/random.hpp"
#include "hardware.hpp"
#include "integer_half.hpp"
#include "tally.hpp"

using namespace bitshade;
using code = std::uint16_t;

namespace {

/// A finite code as a double, and the code beyond the largest as the next multiple of its step.
double value(unsigned magnitude) { return magnitude == 0x7c00 ? 65536.0 : static_cast<double>(integer_half::units(static_cast<code>(magnitude))) * 0x1p-24; }

/// The three directions that F16C lacks, from the neighbours toward and away from zero that it gives.
code derived(rounding d, float x, code toward, code away, std::uint64_t random) {
  const auto sign = static_cast<code>(toward & 0x8000);
  // A NaN or infinity, or exact.
  if (toward == away) return toward;
  const unsigned low = toward & 0x7fff, high = low + 1;
  const double step = value(high) - value(low), over = std::fabs(static_cast<double>(x)) - value(low);
  // Far beyond the largest number the grid has gone on: only there over may exceed the step.
  bool up = over >= step;
  if (!up && d == rounding::nearest_away) up = over >= step / 2;
  if (!up && d == rounding::to_odd) up = (low & 1) == 0;
  if (!up && d == rounding::stochastic) {
    // Of 2^64 random numbers, floor(2^64 f) carry.
    const auto carry = static_cast<integer_half::unsigned_wide>(over / step * 0x1p64);
    up = ((carry + random) >> 64) != 0;
  }
  if (d == rounding::to_odd) up = up && high <= 0x7bff;  // its overflow is the largest finite number
  return static_cast<code>(sign | (up ? high : low));
}

/// Flattened: with the encoding known in all that it calls, the definition takes half of the time.
[[gnu::flatten]] code define(float x, const rules& r, std::uint64_t random) {
  return static_cast<code>(encode(binary16::value, x, r, random));
}

constexpr const char* names[] = {"nearest-even", "nearest-away", "toward-zero", "up", "down", "to-odd", "stochastic"};

void convert_all(rounding d, std::uint64_t stride, verify::report& report) {
  constexpr std::size_t block = 65536;
  std::vector<float> in(block);
  std::vector<code> want(block), up(block), down(block), toward(block), got(block);
  const rules r{.direction = d};
  verify::tally definition, kernels;
  for (std::uint64_t first = 0; first < std::uint64_t{1} << 32; first += block * stride) {
    for (std::size_t i = 0; i < block; ++i)
      in[i] = std::bit_cast<float>(static_cast<std::uint32_t>(first + i * stride + (stride > 1 ? random_bits(3, first + i) % stride : 0)));
    switch (d) {
      case rounding::nearest_even: hardware::to_nearest_even(in.data(), want.data(), block); break;
      case rounding::toward_zero: hardware::toward_zero(in.data(), want.data(), block); break;
      case rounding::up: hardware::up(in.data(), want.data(), block); break;
      case rounding::down: hardware::down(in.data(), want.data(), block); break;
      default:
        hardware::toward_zero(in.data(), toward.data(), block);
        hardware::up(in.data(), up.data(), block);
        hardware::down(in.data(), down.data(), block);
        for (std::size_t i = 0; i < block; ++i)
          want[i] = derived(d, in[i], toward[i], (toward[i] & 0x8000) != 0 ? down[i] : up[i],
                            d == rounding::stochastic ? rounding_bits(0, first + i) : 0);
    }
    const auto compare = [&](verify::tally& t, const char* who) {
      for (std::size_t i = 0; i < block; ++i)
        t.expect(got[i] == want[i], "0x%08x: %s 0x%04x, F16C 0x%04x", std::bit_cast<std::uint32_t>(in[i]), who,
                 unsigned{got[i]}, unsigned{want[i]});
    };
    // The definition takes its time: to nearest even all numbers, in other directions every eighth block.
    if (d == rounding::nearest_even || first / block / stride % 8 == first / (block * stride * 8) % 8) {
      for (std::size_t i = 0; i < block; ++i)
        got[i] = define(in[i], r, d == rounding::stochastic ? rounding_bits(0, first + i) : 0);
      compare(definition, "encode");
    }
    for (const auto set : {bulk::instruction_set::baseline, bulk::instruction_set::avx2, bulk::instruction_set::avx512}) {
      if (!bulk::has(set)) continue;
      bulk::encode(binary16::value, r, in, std::span<code>(got), {.first_counter = first, .set = set});
      compare(kernels, set == bulk::instruction_set::baseline ? "SSE2" : set == bulk::instruction_set::avx2 ? "AVX2" : "AVX-512");
    }
  }
  const std::string what = std::string("binary32 to binary16, ") + names[static_cast<int>(d)];
  report.line(what + ": encode = F16C", definition);
  report.line("  its SIMD kernels = F16C", kernels);
}

}  // namespace

int main(int argc, char* argv[]) {
  const std::uint64_t stride = verify::every(argc, argv);
  if (stride == 0) return std::fputs("usage: verify_conversion [--every N]\n", stderr), 2;
  if (!hardware::has_f16c()) return std::puts("this processor has no F16C to compare with"), verify::skipped;
  verify::report report;
  for (int d = 0; d < 7; ++d) convert_all(static_cast<rounding>(d), stride, report);
  return report.status();
}
