// The generator of stochastic rounding: uniform, and no number of a stream tells of another or of another seed's.
#include "support/catch.hpp"

#include <cmath>
#include <vector>

#include "bitshade/formats/random.hpp"

namespace {

using namespace bitshade;

/// How many standard deviations the chi-square of the pairs (leading byte of a, leading byte of b) is from its mean.
template <class Other>
double deviation(std::uint64_t seed, Other other) {
  constexpr int draws = 1 << 20, cells = 1 << 16;
  std::vector<int> count(cells);
  for (std::uint64_t c = 0; c < draws; ++c) ++count[rounding_bits(seed, c) >> 56 << 8 | other(c) >> 56];
  double chi = 0;
  constexpr double mean = double{draws} / cells;
  for (const int n : count) chi += (n - mean) * (n - mean) / mean;
  return (chi - (cells - 1)) / std::sqrt(2.0 * (cells - 1));
}

TEST_CASE("random bits of rounding are independent at the distances at which vectors share work, and across seeds") {
  for (const std::uint64_t lag : {1, 8, 15, 16, 17, 32, 1024}) {
    const double d = deviation(77, [=](std::uint64_t c) { return rounding_bits(77, c + lag); });
    INFO("lag " << lag);
    CHECK(std::abs(d) < 5);
  }
  for (const std::uint64_t other : {0, 78}) {
    const double d = deviation(77, [=](std::uint64_t c) { return rounding_bits(other, c); });
    INFO("seed " << other);
    CHECK(std::abs(d) < 5);
  }
  // The measure sees dependence where there is some.
  CHECK(deviation(77, [](std::uint64_t c) { return rounding_bits(77, c); }) > 1000);
}

TEST_CASE("flipping any bit of a counter flips every random bit half of the time, distances of 2^63 included") {
  constexpr int draws = 1 << 17;
  for (int bit = 0; bit < 64; ++bit) {
    // Numbers 16 apart end their words in two ways: each is counted by itself.
    int flips[2][64] = {}, drawn[2] = {};
    for (std::uint64_t t = 0; t < draws; ++t) {
      const std::uint64_t c = random_bits(9, t), change = rounding_bits(5, c) ^ rounding_bits(5, c ^ std::uint64_t{1} << bit);
      const auto way = static_cast<std::size_t>(rounding_stream::is_second(c));
      drawn[way] += 1;
      for (int k = 0; k < 64; ++k) flips[way][k] += static_cast<int>(change >> k & 1);
    }
    for (int way = 0; way < 2; ++way) {
      for (int k = 0; k < 64; ++k) {
        const double bias = flips[way][k] / double(drawn[way]) - 0.5, deviation = 0.5 / std::sqrt(drawn[way]);
        // The leading 23 bits of either word are what kernels draw.
        const double allowed = k % 32 >= 9 ? 0 : rounding_stream::low_bits_bias;
        INFO("counter bit " << bit << ", random bit " << k << ", way " << way << ", bias " << bias);
        if (std::abs(bias) > allowed + 6 * deviation) FAIL_CHECK("biased");
      }
    }
  }
}

}  // namespace
