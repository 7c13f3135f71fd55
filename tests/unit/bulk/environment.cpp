// Hard case 42, and the promises of the interface: environment, threads, aliasing, errors.
#include "support/catch.hpp"

#include <numeric>

#include "support/bulk_cases.hpp"
#include "support/hostile_environment.hpp"

namespace {

using namespace bitshade;
using bulk_cases::bits_of;

const rules stochastic{.direction = rounding::stochastic};

/// Runs work(out) in peace and in every hostile environment, and compares the bits.
template <class Out, class Work>
void same_when_hostile(std::size_t n, Work work) {
  std::vector<Out> quiet(n), troubled(n);
  work(quiet);
  for (const int direction : hostile::directions) {
    const bool kept = hostile::keeps_environment(direction, [&] { work(troubled); });
    CHECK(kept);
    std::size_t j = 0;
    while (j + 1 < n && bits_of(quiet[j]) == bits_of(troubled[j])) ++j;
    INFO("element " << j << std::hex << ": 0x" << bits_of(troubled[j]) << " instead of 0x" << bits_of(quiet[j]));
    CHECK(bits_of(troubled[j]) == bits_of(quiet[j]));
  }
}

template <class Code, class T>
void codes_when_hostile(const encoding& e, const rules& r, const bulk::execution& how, const std::vector<T>& in) {
  const std::size_t n = in.size();
  same_when_hostile<Code>(n, [&](auto& out) { bulk::encode(e, r, in, std::span<Code>(out), how); });
  std::vector<Code> codes(n);
  bulk::encode(e, r, in, std::span<Code>(codes), how);
  same_when_hostile<T>(n, [&](auto& out) { bulk::decode(e, r, std::span<const Code>(codes), std::span<T>(out), how); });
}

TEST_CASE("bulk ignores the caller's rounding direction and flush-to-zero, and puts them back") {
  const encoding formats[] = {binary16::value, bfloat16::value, binary_encoding(11, 4), unorm_encoding(16),
                              unorm_encoding(24), fixed_encoding(4, 12), binary32::value, binary_encoding(8, 26)};
  for (const encoding& e : formats) {
    const auto in = bulk_cases::inputs<float>(e, 200, 200);
    const auto wide = bulk_cases::inputs<double>(e, 200, 200);
    for (const auto set : bulk_cases::sets()) {
      for (int d = 0; d < 7; ++d) {
        const rules r{.direction = static_cast<rounding>(d)};
        const bulk::execution how{.set = set};
        INFO(bulk_cases::describe(e, r, set));
        same_when_hostile<float>(in.size(), [&](auto& out) { bulk::round(e, r, in, std::span<float>(out), how); });
        same_when_hostile<double>(wide.size(), [&](auto& out) { bulk::round(e, r, wide, std::span<double>(out), how); });
        codes_when_hostile<std::uint64_t>(e, r, how, wide);
        if (e.width <= 32) codes_when_hostile<std::uint32_t>(e, r, how, in);
        if (e.width <= 16) codes_when_hostile<std::uint16_t>(e, r, how, in);
      }
    }
  }
  const auto in = bulk_cases::inputs<float>(fp8_e5m2::value, 200, 200);
  for (const auto set : bulk_cases::sets()) codes_when_hostile<std::uint8_t>(fp8_e5m2::value, {}, {.set = set}, in);
}

TEST_CASE("bulk arithmetic ignores them as well") {
  std::vector<std::uint16_t> a(5000), b(a.size()), c(a.size());
  for (std::size_t j = 0; j < a.size(); ++j) {
    const std::uint64_t r = random_bits(8, j);
    a[j] = static_cast<std::uint16_t>(r), b[j] = static_cast<std::uint16_t>(r >> 16), c[j] = static_cast<std::uint16_t>(r >> 32);
  }
  for (const auto set : bulk_cases::sets()) {
    const bulk::execution how{.set = set};
    INFO(bulk_cases::name_of(set));
    const auto check = [&](auto operation) { same_when_hostile<std::uint16_t>(a.size(), operation); };
    check([&](auto& out) { bulk::add(a, b, out, how); });
    check([&](auto& out) { bulk::subtract(a, b, out, how); });
    check([&](auto& out) { bulk::multiply(a, b, out, how); });
    check([&](auto& out) { bulk::divide(a, b, out, how); });
    check([&](auto& out) { bulk::sqrt(a, out, how); });
    check([&](auto& out) { bulk::fma(a, b, c, out, how); });
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

TEST_CASE("bulk decides as the definition does where the last random bits decide") {
  // Numbers whose share of the smallest step lies within some ulp of the one at which their counter's bits go up.
  std::vector<std::uint64_t> counters;
  for (std::uint64_t j = 0; counters.size() < 3; ++j) {
    if (rounding_bits(5, j) >> 41 == 0x7fffff) counters.push_back(j);
  }
  for (const encoding& e : {binary16::value, fp8_e4m3::value, unorm_encoding(16), snorm_encoding(16), fixed_encoding(4, 12)}) {
    for (const auto set : bulk_cases::sets()) {
      if (set == bulk::instruction_set::scalar) continue;
      for (const std::uint64_t counter : counters) {
        const double share = std::ldexp(static_cast<double>(0 - rounding_bits(5, counter)), -64);
        bool went_up = false, stayed = false;
        for (int ulps = -3; ulps <= 3; ++ulps) {
          const auto nearest = static_cast<float>(share * decode(e, 1));
          const float y = std::bit_cast<float>(static_cast<std::uint32_t>(static_cast<int>(bits_of(nearest)) + ulps));
          const std::vector<float> in(64, y);
          std::vector<float> out(in.size());
          bulk::round(e, stochastic, in, out, {.seed = 5, .first_counter = counter - 13, .set = set});
          const auto expected = static_cast<float>(round_to(e, y, stochastic, rounding_bits(5, counter)));
          INFO(bulk_cases::describe(e, stochastic, set) << " counter=" << counter << std::hex << " in=0x" << bits_of(y)
                                                        << " expected=0x" << bits_of(expected) << " got=0x"
                                                        << bits_of(out[13]));
          CHECK(bits_of(out[13]) == bits_of(expected));
          (expected > 0 ? went_up : stayed) = true;
        }
        CHECK((went_up && stayed));
      }
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
