// The figures that docs/theory.md quotes, computed.
#include "bitshade/study/bounds.hpp"
#include "bitshade/study/bounds_visibility.hpp"
#include "bitshade/study/precision.hpp"
#include "support/catch.hpp"

using namespace bitshade;

namespace {

constexpr bool near(double a, double b, double relative) {
  return (a < b ? b - a : a - b) <= relative * (b < 0 ? -b : b);
}
constexpr double noise(double step, double mu) {
  return variance_error(moment_error(step, 1), mu).width();
}
/// 2^bits by squaring a root: bits to a thousandth, without a logarithm.
constexpr bool between_bits(double steps, double low, double high) {
  const auto power = [](double b) {
    double value = 1, root = 2;
    for (; b >= 1; b -= 1) value *= 2;
    for (int i = 0; i < 30; ++i) {
      root = bitshade::detail::square_root(root);
      b *= 2;
      if (b >= 1) value *= root, b -= 1;
    }
    return value;
  };
  return steps + 1 >= power(low) && steps + 1 <= power(high);
}

constexpr precision_question question(double deviation, int roundings = 1, double width = 1) {
  precision_question q;
  q.floor_deviation = deviation;
  q.roundings = roundings;
  q.width = width;
  return q;
}

}  // namespace

// Section 1: 1.5 q at mu = 1; unorm16, half and binary32 on [1/2, 1].
static_assert(near(noise(1.0 / 65535, 1), 2.29e-5, 0.01));
static_assert(near(noise(0x1p-11, 1), 7.33e-4, 0.001));
static_assert(near(noise(0x1p-24, 1), 8.94e-8, 0.001));
static_assert(near(noise(1e-6, 1) / variance_error_centred(moment_error(1e-6, 1), 1.0), 2.4, 1e-5));
static_assert(variance_error_square_of_stored(1.0, 0.0) == 0.5);
static_assert(variance_error_truncated(0.125, 1, 0.5).up == 2 * 0.5 * 0.125 - 0.125 * 0.125);
// Section 6.
static_assert(near(visibility_error_of_variance(1), 0.1716, 0.001));
static_assert(near(1 / tolerated_noise_ratio(1.0 / 255), 63.25, 1e-3));
static_assert(near(visibility_error_of_variance(tolerated_noise_ratio(1.0 / 255)), 1.0 / 255, 1e-12));
static_assert(unfloored_error(1e-5, 0.0) == 1);
static_assert(near(narrowest_layer(1, 1.0 / 255), 15.94, 1e-3));
static_assert(near(floor_residue(0.0001, narrowest_layer(0.01, 1.0 / 255)), 1.0 / 255, 1e-12));
static_assert(two_occluder_bleeding(0.5, 0.2, 0.2) == 0.25 * 0.2 * 0.2 / (0.25 * 0.2 * 0.2 + 0.3 * 0.3) ||
              near(two_occluder_bleeding(0.5, 0.2, 0.2), 0.1, 1e-12));
// Section 4.
static_assert(near(variance_error_floating(0x1p-11, 1.0), 1.465e-3, 0.001));
static_assert(near(variance_error_floating(0x1p-24, 1.0), 1.79e-7, 0.01));
// Section 9.
static_assert(between_bits(steps_needed(question(0.03)), 16.6, 16.8));
static_assert(between_bits(steps_needed(question(0.01)), 19.8, 19.9));
static_assert(between_bits(steps_needed(question(0.003)), 23.2, 23.4));
static_assert(near(steps_needed(question(0.01, 4)) / steps_needed(question(0.01)), 4, 1e-3));
static_assert(near(steps_needed(question(0.01)) / steps_needed(question(0.01, 1, 0.125)), 64, 1e-3));
static_assert(between_bits(steps_needed_with_full_overlap(1.0 / 255, 1), 16.55, 16.57));
static_assert(summed_area_extra_bits(2048, 2048) == 22);

TEST_CASE("compile-time and run-time bounds agree to the bit") {
  for (const double deviation : {0.03, 0.01, 0.003}) {
    const volatile double at_run_time = deviation;
    const auto q = question(at_run_time);
    CHECK(q.floor_deviation == deviation);
  }
  constexpr double fixed = steps_needed(question(0.01));
  const volatile double deviation = 0.01;
  CHECK(steps_needed(question(deviation)) == fixed);
  constexpr double root = bitshade::detail::square_root(2.0);
  CHECK(root * root <= 2.0000000000000009);
  CHECK(std::abs(root - std::sqrt(2.0)) <= 0x1p-52);
}
