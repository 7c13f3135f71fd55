// Hard cases 1 to 7, 12 to 14, 16, 17, 30 and 32 in every format that they concern: numbers stored
// in the format, arithmetic in binary64, so that what is seen is the format's own.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "bitshade/formats/limits.hpp"
#include "bitshade/shadow/chebyshev.hpp"
#include "bitshade/shadow/evsm.hpp"
#include "bitshade/shadow/lloyd.hpp"
#include "bitshade/shadow/lloyd_pyramid.hpp"
#include "bitshade/shadow/moments.hpp"
#include "bitshade/study/bounds.hpp"
#include "bitshade/texture/blur.hpp"
#include "io/error.hpp"
#include "run/pipeline.hpp"
#include "scene/scene.hpp"
#include "support/catch.hpp"
#include "support/half_step.hpp"
#include "support/process.hpp"
#include "support/roundings.hpp"
#include "support/temporary_folder.hpp"
#include "unit/run/frames.hpp"

using namespace bitshade;
using test::format_named;
using test::half_step;
using test::hard_formats;

namespace {

/// The largest error of a plane's variance after one rounding of each moment: theory section 1, and
/// 4 for binary formats, whose steps shrink with the numbers.
double noise_of(const encoding& e, double mu) {
  const double half = half_step(e);
  if (e.kind != family::binary) return variance_error(half, mu).width();
  return variance_error_floating(std::ldexp(1.0, -e.fraction_bits - 1), mu);
}

mean_variance<double> stored(const encoding& e, double x) {
  return mean_and_variance(round_to(e, x), round_to(e, x * x));
}

cell run(const frame& scene, const configuration& how) {
  return run_pipeline(scene, how, make_plan(scene, how));
}

}  // namespace

TEST_CASE("hard cases 1 and 2 in every format: t at a stored depth, and one step past it") {
  for (const auto name : hard_formats) {
    const encoding e = format_named(name);
    for (const double depth : {0.0, 0.125, 0.3, 0.75, 1.0}) {
      const double mu = round_to(e, depth), next = mu + 2 * half_step(e);
      const mean_variance<double> at{mu, 0};
      CAPTURE(std::string(name), mu);
      for (const double floor : {0.0, 1e-12, 1e-5}) {
        CHECK(chebyshev(at, mu, floor) == 1);
        const double d = next - mu, p = chebyshev(at, next, floor);
        CHECK(p == floor / (floor + d * d));
        CHECK((p >= 0 && p < 1));
      }
    }
  }
}

TEST_CASE("hard case 2: a floor under the format's noise is reported, and one over it is not") {
  const auto scene = test::small_frame(16, 12, 60, 5);
  for (const auto name : hard_formats) {
    configuration how;
    how.format = name;
    how.min_variance = 1e-12;
    const auto got = run(scene, how);
    CAPTURE(std::string(name));
    REQUIRE(got.notes.size() == 1);
    CHECK(got.notes[0].find("the floor 1e-12 is under ") == 0);
    CHECK(got.notes[0].find("the noise of " + how.format) != std::string::npos);
    how.noise_floor = true;
    CHECK(run(scene, how).notes.empty());
    how.noise_floor = false;
    how.min_variance = 1;
    CHECK((run(scene, how).notes.empty() || how.format == "unorm8" || how.format == "bfloat16"));
  }
}

TEST_CASE("hard case 3 in every format: lit planes have no acne once the floor is D") {
  for (const auto name : hard_formats) {
    const encoding e = format_named(name);
    int without = 0;
    for (int i = 0; i < 20000; ++i) {
      const double x = (i + 0.618) / 20001, floor = noise_of(e, 1);
      const auto at = stored(e, x);
      const double d = std::max(0.0, x - at.mean), p = chebyshev(at, x, floor);
      CAPTURE(std::string(name), x, p);
      REQUIRE(d <= half_step(e));
      // v / (v + d^2) grows with v and falls with d; here and there a square, a sum and a quotient.
      REQUIRE(p >= floor / (floor + half_step(e) * half_step(e)) - test::roundings(3 + 3));
      without += chebyshev(at, x, 0.0) < 1 - 1.0 / 255 ? 1 : 0;
    }
    CAPTURE(std::string(name), without);
    CHECK(without > 20000 / 20);  // without it there is plenty
  }
}

TEST_CASE("hard case 4 in every format: negative variances of a plane are many, and floored") {
  for (const auto name : hard_formats) {
    const encoding e = format_named(name);
    int negative = 0;
    for (int i = 0; i < 20000; ++i) {
      const auto at = stored(e, (i + 0.37) / 20001);
      if (at.variance >= 0) continue;
      ++negative;
      const double t = at.mean + 0.01, d = t - at.mean;
      CHECK(chebyshev(at, t, 1e-5) == 1e-5 / (1e-5 + d * d));
      CHECK(chebyshev(at, t, 0.0) == 0);
    }
    CAPTURE(std::string(name), negative);
    CHECK(negative > 20000 * 2 / 5);
    CHECK(negative < 20000 * 3 / 5);
  }
}

TEST_CASE("hard cases 5 and 32 in every format: Lloyd's samples of stored moments are finite") {
  for (const auto name : hard_formats) {
    const encoding e = format_named(name);
    for (int i = 0; i <= 5000; ++i) {
      const double x = i / 5000.0, m1 = round_to(e, x), m2 = round_to(e, x * x);
      const auto s = lloyd_sample_of(m1, m2);
      CAPTURE(std::string(name), x, s.value, s.weight);
      REQUIRE((s.value >= m1 && s.value <= 1));
      REQUIRE((s.weight >= 0 && s.weight <= weight_limits{}.high));
    }
  }
}

TEST_CASE("hard case 6 in every format: the variance's error near mu = 1 attains its bound") {
  for (const auto name : hard_formats) {
    const encoding e = format_named(name);
    double plain = 0, centred = 0;
    const double half = half_step(e);
    // Half way between codes, and next to it: (m + 1/2) steps below 1, m up to 1 / sqrt(step), so
    // that x^2 = 1 - (2m + 1) steps + (m + 1/2)^2 step steps meets every phase between two codes.
    const int codes = static_cast<int>(std::ceil(1 / std::sqrt(2 * half))) + 1;
    for (int i = 0; i < 60000 + 2 * codes; ++i) {
      const double middle = 1 - (2 * ((i - 60000) / 2) + 1) * half;
      const double x = i < 60000 ? 1 - i * (0.1 / 60000) : middle + (i % 2 == 0 ? 1 : -1) * 0x1p-40;
      const auto b =
          mean_and_centred_variance(round_to(e, x), round_to(e, 4 * ((x - 0.5) * (x - 0.5))));
      plain = std::max(plain, std::fabs(stored(e, x).variance));
      centred = std::max(centred, std::fabs(b.variance));
    }
    CAPTURE(std::string(name), plain / half, centred / half);
    CHECK(plain <= noise_of(e, 1) * (1 + 1e-9));
    // Nearly 3: phases of x^2 are at most (2 codes + 2) steps of a step apart, so that one lies
    // within half of that of a tie; mu is at least 1 - (2 codes + 1) half; x lies 2^-40 from a tie,
    // which moves x^2 by 2^-39.
    const double square = (1 - 4 * (codes + 1) * half) * half - 0x1p-39;
    CHECK(plain > square + 2 * (1 - (2 * codes + 1) * half) * (half - 0x1p-40));
    CHECK(centred <= variance_error_centred(half, 1.0) * (1 + 1e-9));
    CHECK(centred < plain * 0.6);
  }
}

TEST_CASE("hard case 7 in every format: 1 : 100,000 stays bounded, and a fitted range sees more") {
  for (const auto name : hard_formats) {
    const encoding e = format_named(name);
    const auto light_behind = [&](double near, double far) {
      const auto depth = [&](double z) { return (z - near) / (far - near); };
      return chebyshev(stored(e, depth(2.0)), depth(2.5), 1e-5);
    };
    CAPTURE(std::string(name));
    CHECK((light_behind(1, 100000) >= 0 && light_behind(1, 100000) <= 1));
    CHECK(light_behind(1, 100000) > 0.99);
    // Where the fitted variance's own noise is small beside d^2, the shadow is there.
    const double d = 0.5 / 3, noise = noise_of(e, 1.0 / 3);
    CHECK(light_behind(1, 4) <=
          (noise + 1e-5) / (noise + 1e-5 + (d - half_step(e)) * (d - half_step(e))));
    CHECK(light_behind(1, 4) < 0.3);
  }
}

TEST_CASE(
    "hard cases 12 and 14 in every format: outside depths are clamped, clear texels are lit") {
  auto wild = test::small_frame(16, 12, 80, 3), tame = wild;
  for (std::size_t i = 0; i < wild.depth.texels.size(); i += 3) {
    wild.depth.texels[i] = i % 2 == 0 ? -3.0F : 7.0F;
    tame.depth.texels[i] = i % 2 == 0 ? 0.0F : 1.0F;
  }
  for (std::size_t i = 0; i < wild.receivers.size(); i += 4) {
    wild.receivers[i].t = i % 8 == 0 ? -2.0F : 5.0F;
    tame.receivers[i].t = i % 8 == 0 ? 0.0F : 1.0F;
  }
  frame clear = tame;
  for (float& x : clear.depth.texels) x = 1;
  for (const std::string_view name :
       {"unorm8", "unorm16", "unorm24", "snorm16", "half", "bfloat16", "binary32", "exact"}) {
    configuration how;
    how.format = name;
    const auto a = run(wild, how), b = run(tame, how), lit = run(clear, how);
    for (std::size_t i = 0; i < a.visibility.size(); ++i) {
      if (wild.receivers[i].surface == 0) continue;
      CAPTURE(std::string(name), i);
      CHECK(a.visibility[i] == b.visibility[i]);
      CHECK(lit.visibility[i] == 1);
    }
  }
}

TEST_CASE(
    "hard case 13: NaN, infinities and -0 in a map: refused with count and place, or masked") {
  const temporary_folder folder;
  image<float> depth(4, 3, 1, 0.5F);
  depth.at(2, 1) = std::nanf("");
  depth.at(3, 1) = INFINITY;
  depth.at(0, 2) = -INFINITY;
  depth.at(1, 2) = -0.0F;
  std::string bytes = "Pf\n4 3\n-1.0\n";  // rows from the bottom up
  for (int y = 2; y >= 0; --y) {
    const auto row = depth.row(y);
    bytes.append(reinterpret_cast<const char*>(row.data()), row.size() * sizeof(float));
  }
  test::write(folder / "broken.pfm", bytes);
  scene_options options;
  CHECK_THROWS_WITH(
      load_captured(folder / "broken.pfm", options),
      Catch::Contains("3 NaN or infinite depths among 12") && Catch::Contains("column 2, row 1"));
  options.mask_invalid = true;
  options.receivers = "0.75";
  const frame masked = load_captured(folder / "broken.pfm", options);
  CHECK(masked.depth.at(2, 1) == 1);  // never drawn
  CHECK_FALSE(std::signbit(masked.depth.at(1, 2)));
  for (const std::string_view name :
       {"unorm8", "unorm16", "unorm24", "snorm16", "half", "bfloat16", "binary32", "exact"}) {
    configuration how;
    how.format = name;
    const auto got = run(masked, how);
    for (std::size_t i = 0; i < got.visibility.size(); ++i) {
      if (masked.receivers[i].surface == 0) continue;
      CAPTURE(std::string(name), i);
      CHECK((got.visibility[i] >= 0 && got.visibility[i] <= 1));  // no filter spread a NaN
    }
  }
}

TEST_CASE("hard case 16 in every format: blur sums are made of products, none beyond its texels") {
  // Weights come before sums, so that no partial sum passes the largest texel: at the format's own
  // limit nothing overflows, where adding first and dividing afterwards would.
  const kernel blur = gaussian_kernel(25, 8);
  for (const auto name : hard_formats) {
    const encoding e = format_named(name);
    const double most = decode(e, max_bits(e));
    image<double> in(64, 1, 1, most);
    std::vector<double> out(64);
    blur_row_x<double>(in, blur, address::clamp, 0, out);
    double sum_first = 0;
    for (int k = 0; k < 25; ++k) sum_first += most;
    rules saturating;
    saturating.overflow = overflow::infinity;
    CAPTURE(std::string(name));
    for (const double x : out) CHECK(round_to(e, x, saturating) == most);
    if (e.kind == family::binary) CHECK(std::isinf(round_to(e, sum_first, saturating)));
  }
}

TEST_CASE("hard case 17 in every format: squares before or after the first moment is rounded") {
  for (const auto name : hard_formats) {
    const encoding e = format_named(name);
    double before = 0, after = 0, furthest = 0;
    for (int i = 0; i < 40000; ++i) {
      const double x = 0.5 + (i + 0.37) / 80001, kept = round_to(e, x);
      const double m2 = round_to(e, x * x), squared = round_to(e, kept * kept);
      before = std::max(before, std::fabs(m2 - kept * kept));
      after = std::max(after, std::fabs(squared - kept * kept));
      furthest = std::max(furthest, std::fabs(m2 - squared));
    }
    CAPTURE(std::string(name), before, after, furthest);
    CHECK(after <= half_step(e) * (1 + 1e-9));        // the square's own rounding alone
    CHECK(before > 2 * after);                        // and 2 mu times the first moment's on top
    // Up to two steps apart; two squares, two stored numbers and their difference in binary64.
    CHECK(furthest <= 2 * 2 * half_step(e) + test::roundings(5));
  }
}

TEST_CASE("hard case 30 in every format: sums that lose weight say so, and the splits stay") {
  image<lloyd_sample> map(64, 64, 1, {0.5, 0.0});
  map.at(10, 10) = {0.75, 1e-4};
  map.at(40, 50) = {0.25, 1e-4};
  for (const auto name : hard_formats) {
    const lloyd_pyramid field(map, format_named(name));
    const auto sums = field.between(0.6, 0.9);
    CAPTURE(std::string(name), sums.weight, sums.lost);
    CHECK((sums.weight > 0 || sums.lost));  // never lost in silence
    if (sums.weight > 0 && !sums.lost) CHECK(std::fabs(sums.mean() - 0.75) < 0.01);
    lloyd_relaxation relaxation({0.3, 0.7});
    for (int i = 0; i < 100; ++i) {
      relaxation.step(field);
      const auto& s = relaxation.interior();
      REQUIRE((s[0] >= 0 && s[0] <= s[1] && s[1] <= 1));
    }
  }
}
