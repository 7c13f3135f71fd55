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

TEST_CASE("flipping any bit of a counter flips the leading bits of its random bits half of the time") {
  for (int bit = 0; bit < 26; ++bit) {
    for (int k = 41; k < 64; ++k) {  // the leading 23: what the kernels draw
      int flips = 0;
      for (std::uint64_t t = 0; t < 256; ++t) {
        const std::uint64_t c = random_bits(9, t) >> 24;
        flips += static_cast<int>((rounding_bits(5, c) ^ rounding_bits(5, c ^ std::uint64_t{1} << bit)) >> k & 1);
      }
      INFO("counter bit " << bit << ", random bit " << k << ", flips " << flips);
      CHECK(std::abs(flips - 128) < 48);  // six standard deviations
    }
  }
}

}  // namespace
