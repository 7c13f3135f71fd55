#include "report/colours.hpp"

#include <cmath>
#include <limits>

#include "report/maps.hpp"
#include "support/catch.hpp"

using namespace bitshade;

TEST_CASE("Oklab and back keeps every colour of the categories and the palette", "[report]") {
  for (const rgb c : categories()) CHECK(from_oklab(to_oklab(c)) == c);
  for (const rgb c : error_palette()) CHECK(from_oklab(to_oklab(c)) == c);
}

TEST_CASE("the error palette is even in lightness and told apart without red and green",
          "[report]") {
  const auto at = [](int step) {
    return to_oklab(error_palette()[static_cast<std::size_t>(error_steps + step)]);
  };
  CHECK(at(0).lightness > 0.95);
  for (int step = 1; step <= error_steps; ++step) {
    CAPTURE(step);
    // Lightness falls on both sides, alike to within what 8 bits and the gamut leave.
    CHECK(at(step).lightness <= at(step - 1).lightness + 1e-3);
    CHECK(at(-step).lightness <= at(1 - step).lightness + 1e-3);
    CHECK(std::fabs(at(step).lightness - at(-step).lightness) < 0.05);
    // The sides lie on different sides of the blue-yellow axis.
    if (step > 8) {
      CHECK(at(step).b > 0.01);
      CHECK(at(-step).b < -0.01);
    }
  }
}

TEST_CASE("an error's index is odd about zero, monotonic and ends at the scale's ends",
          "[report]") {
  CHECK(error_index(0) == error_steps);
  CHECK(error_index(0.99e-4) == error_steps);
  CHECK(error_index(1.0) == 2 * error_steps);
  CHECK(error_index(-1.0) == 0);
  CHECK(error_index(1e300) == 2 * error_steps);
  CHECK(error_index(std::numeric_limits<double>::quiet_NaN()) == ink_index);
  int before = error_steps;
  for (double e = 1e-5; e < 2; e *= 1.01) {
    CAPTURE(e);
    CHECK(error_index(e) >= before);
    CHECK(error_index(e) + error_index(-e) == 2 * error_steps);
    before = error_index(e);
  }
}

TEST_CASE("an error map carries its legend and encodes as PNG", "[report]") {
  const std::vector<double> value(600 * 4, 0.5), truth(600 * 4, 0.25);
  const picture p = error_map(value, truth, 600, 4);
  CHECK(p.height == 4 + legend_height);
  CHECK(p.bytes[0] == error_index(0.25));
  CHECK(encode_png(p).starts_with("\x89PNG"));
  CHECK(encode_png(p) == encode_png(p));
}
