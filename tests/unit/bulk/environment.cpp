// Hard case 42, and the promises of the interface: environment, threads, aliasing, errors.
#include "support/catch.hpp"

#include <cfenv>
#include <numeric>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include "support/bulk_cases.hpp"

namespace {

using namespace bitshade;
using bulk_cases::bits_of;

const rules stochastic{.direction = rounding::stochastic};

TEST_CASE("bulk ignores the caller's rounding direction and flush-to-zero, and puts them back") {
  const encoding formats[] = {binary16::value, bfloat16::value, binary_encoding(11, 4), unorm_encoding(16),
                              unorm_encoding(24), fixed_encoding(4, 12), binary32::value, binary_encoding(8, 26)};
  for (const encoding& e : formats) {
    const auto in = bulk_cases::inputs<float>(e, 200, 200);
    for (const auto set : bulk_cases::sets()) {
      for (int d = 0; d < 7; ++d) {
        const rules r{.direction = static_cast<rounding>(d)};
        const bulk::execution how{.set = set};
        std::vector<float> quiet(in.size()), hostile(in.size());
        bulk::round(e, r, in, quiet, how);
        for (const int direction : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
          std::fesetround(direction);
#if defined(__SSE2__)
          constexpr unsigned settings = 0xffc0;  // all but the exception flags
          const unsigned before = (_mm_getcsr() | 0x8040) & settings;  // flush to zero, denormals are zero
          _mm_setcsr(before);
#endif
          bulk::round(e, r, in, hostile, how);
#if defined(__SSE2__)
          const unsigned after = _mm_getcsr() & settings;
          _mm_setcsr(0x1f80);
          CHECK(after == before);
#endif
          CHECK(std::fegetround() == direction);
          std::fesetround(FE_TONEAREST);
          std::size_t j = 0;
          while (j + 1 < in.size() && bits_of(quiet[j]) == bits_of(hostile[j])) ++j;
          INFO(bulk_cases::describe(e, r, set) << std::hex << " in=0x" << bits_of(in[j]));
          CHECK(bits_of(hostile[j]) == bits_of(quiet[j]));
        }
      }
    }
  }
}

TEST_CASE("bulk gives the same bits for any number of threads, chunk and in place") {
  std::vector<float> in(100003);
  for (std::size_t j = 0; j < in.size(); ++j) in[j] = static_cast<float>(random_bits(1, j)) * 0x1p-64f;
  for (const encoding& e : {binary16::value, unorm_encoding(16)}) {
    std::vector<float> one(in.size()), other(in.size());
    bulk::round(e, stochastic, in, one, {.seed = 3});
    for (const unsigned threads : {2u, 3u, 16u}) {
      bulk::round(e, stochastic, in, other, {.seed = 3, .threads = threads});
      CHECK(other == one);
    }
    const std::size_t cut = 777;
    bulk::round(e, stochastic, std::span(in).first(cut), std::span(other).first(cut), {.seed = 3});
    bulk::round(e, stochastic, std::span(in).subspan(cut), std::span(other).subspan(cut),
                {.seed = 3, .first_counter = cut});
    CHECK(other == one);
    other = in;
    bulk::round(e, stochastic, other, other, {.seed = 3});
    CHECK(other == one);
    bulk::round(e, stochastic, in, other, {.seed = 4});
    CHECK(other != one);
  }
}

TEST_CASE("bulk's stochastic rounding is unbiased") {
  // 2^20 draws of a value a quarter of the way up: the mean's standard deviation is 0.433 / 2^10 units.
  std::vector<float> in(1 << 20, 1.0f + 0.25f / 1024), out(in.size());
  bulk::round(binary16::value, stochastic, in, out, {.seed = 11});
  const double ups = std::accumulate(out.begin(), out.end(), 0.0, [](double s, float x) { return s + (x > 1 ? 1 : 0); });
  const double share = ups / static_cast<double>(in.size());
  CHECK(std::abs(share - 0.25) < 5 * 0.433 / 1024);
}

TEST_CASE("bulk asks random bits beyond those that a vector has at hand") {
  // A share f of the smallest step, just below 2^-23: only numbers whose first 23 random bits are ones go up, and the
  // bits behind them decide. About two of 2^24 do.
  constexpr double f = 0x1.f8p-24;
  constexpr std::size_t count = 1 << 24, chunk = 1 << 18;
  for (const encoding& e : {binary16::value, fp8_e4m3::value, unorm_encoding(16), snorm_encoding(16)}) {
    const float x = static_cast<float>(-f * decode(e, 1)), y = e.has_sign ? x : -x;
    const float up = static_cast<float>(e.has_sign ? -decode(e, 1) : decode(e, 1));
    const std::vector<float> in(chunk, y);
    for (const auto set : bulk_cases::sets()) {
      if (set == bulk::instruction_set::scalar || set == bulk::instruction_set::baseline) continue;
      std::vector<float> out(chunk);
      int ups = 0;
      for (std::uint64_t first = 0; first < count; first += chunk) {
        bulk::round(e, stochastic, in, out, {.seed = 5, .first_counter = first, .set = set});
        for (std::size_t j = 0; j < chunk; ++j) {
          const std::uint64_t bits = rounding_bits(5, first + j);
          if (bits >> 41 != 0x7fffff && out[j] == 0) continue;
          const auto expected = static_cast<float>(round_to(e, y, stochastic, bits));
          INFO(bulk_cases::describe(e, stochastic, set) << " counter=" << first + j << std::hex << " random=0x" << bits
                                                        << " expected=0x" << bits_of(expected) << " got=0x"
                                                        << bits_of(out[j]));
          CHECK(bits_of(out[j]) == bits_of(expected));
          ups += expected == up ? 1 : 0;
        }
      }
      CHECK(ups > 0);
    }
  }
}

TEST_CASE("bulk refuses what cannot be meant") {
  std::vector<float> three(3), four(4);
  std::vector<std::uint8_t> codes(3);
  CHECK_THROWS_AS(bulk::round(binary16::value, {}, three, four), std::invalid_argument);
  CHECK_THROWS_AS(bulk::round(encoding{}, {}, three, three), std::invalid_argument);
  CHECK_THROWS_AS(bulk::encode(binary16::value, {}, three, codes), std::invalid_argument);
  CHECK_THROWS_AS(bulk::decode(unorm_encoding(9), {}, codes, three), std::invalid_argument);
  CHECK_THROWS_AS(bulk::round(binary16::value, {.random_bits = 0}, three, three), std::invalid_argument);
  CHECK_NOTHROW(bulk::round(binary16::value, {}, std::span<const float>{}, std::span<float>{}));
}

}  // namespace
