// Hard cases 1 to 4, 6 to 8, 10 to 12, 14, 17 to 20, 36 and 41: moments, layers and Chebyshev's
// bound where formats are at their worst.
#include <bit>
#include <cmath>
#include <limits>

#include "bitshade/arithmetic/real.hpp"
#include "bitshade/formats/decode.hpp"
#include "bitshade/formats/round_to.hpp"
#include "bitshade/interop/rational.hpp"
#include "bitshade/shadow/chebyshev.hpp"
#include "bitshade/shadow/layers.hpp"
#include "bitshade/shadow/moments.hpp"
#include "support/catch.hpp"

using namespace bitshade;

namespace {

/// Calls body with one number of every arithmetic that light is computed in.
template <class Body>
void in_every_arithmetic(Body body) {
  body(float{});
  body(double{});
  body(real<binary16>{});
  body(real<bfloat16>{});
  body(real<tf32>{});
  body(exact_rational{});
}

double number(const auto& x) { return static_cast<double>(x); }

constexpr encoding unorm16_code = unorm_encoding(16);
constexpr double q16 = 1.0 / 65535;
/// D at mu = 1 with one rounding: 3/2 q + q^2/4.
constexpr double noise16 = 1.5 * q16 + q16 * q16 / 4;

}  // namespace

TEST_CASE("hard cases 1 and 2: t at mu and one step past it, without any variance") {
  in_every_arithmetic([](auto zero) {
    using T = decltype(zero);
    for (const double mu : {0.0, 0x1p-14, 0.25, 0.5, 1 - 0x1p-7}) {
      for (const double floor : {0.0, 0x1p-20, 1e-5}) {
        const mean_variance<T> at{static_cast<T>(mu), static_cast<T>(0)};
        CHECK(number(chebyshev(at, static_cast<T>(mu), static_cast<T>(floor))) == 1);
        const T next = static_cast<T>(mu + 0x1p-7);
        const double p = number(chebyshev(at, next, static_cast<T>(floor)));
        CAPTURE(mu, floor, p);
        CHECK((p >= 0 && p < 1));
        if (floor == 0) CHECK(p == 0);
        if (floor > 0) CHECK(p > 0);
      }
    }
  });
}

TEST_CASE("hard case 3: a lit plane at every depth between codes has no acne once floor >= D") {
  int without = 0;
  for (int code = 0; code < 65535; ++code) {
    // The worst receiver: just under the middle between two codes, where the stored depth is lower.
    const double x = (code + 0.4999) * q16;
    const double m1 = round_to(unorm16_code, x), m2 = round_to(unorm16_code, x * x);
    const auto at = mean_and_variance(m1, m2);
    const double p = chebyshev(at, x, noise16);
    // t - mu <= q/2 and v >= D = 1.5 q leave 1 - p <= (q/2)^2 / (1.5 q) = q/6.
    if (!(p >= 1 - q16 / 6)) {
      CAPTURE(code, p);
      FAIL("acne");
    }
    without += chebyshev(at, x, 0.0) < 1 - 1.0 / 255 ? 1 : 0;
  }
  CHECK(without > 65535 / 10);  // without the floor there is plenty
}

TEST_CASE("hard case 4: about half of a plane's variances are negative in unorm16, and floored") {
  int negative = 0;
  for (int i = 0; i < 65536; ++i) {
    const double x = (i + 0.37) / 65537;
    const auto at = mean_and_variance(static_cast<float>(round_to(unorm16_code, x)),
                                      static_cast<float>(round_to(unorm16_code, x * x)));
    if (at.variance >= 0) continue;
    ++negative;
    const float t = at.mean + 0.01F, d = t - at.mean, floor = 1e-5F;
    CHECK(chebyshev(at, t, floor) == floor / (floor + d * d));
    CHECK(chebyshev(at, t, 0.0F) == 0);
  }
  CHECK(negative > 65536 * 2 / 5);
  CHECK(negative < 65536 * 3 / 5);
}

TEST_CASE("hard case 6: near mu = 1 the variance errs by 1.5 q, centred storage by 5/8 q") {
  double plain = 0, centred = 0;
  for (int i = 0; i < 400000; ++i) {
    const double x = 1 - i * 0x1p-24;
    const auto keep = [](double v) { return round_to(unorm16_code, v); };
    const auto a = mean_and_variance(keep(x), keep(x * x));
    const auto b = mean_and_centred_variance(keep(x), keep(4 * ((x - 0.5) * (x - 0.5))));
    plain = std::max(plain, std::fabs(a.variance));
    centred = std::max(centred, std::fabs(b.variance));
  }
  CAPTURE(plain / q16, centred / q16);
  CHECK(plain <= noise16 * (1 + 1e-9));
  // A point lies within 2^-9 q of every tie of x; there x^2 has the phase (m + 1/2)^2 q of a code,
  // whose steps are below 2 * 0.024 for these depths: within 0.024 + 2^-8 of a tie for one of them.
  CHECK(plain > (0.5 - 0.024 - 0x1p-8) * q16 + 2 * 0.976 * (0.5 - 0x1p-9) * q16);
  CHECK(centred <= (0.625 * q16 + q16 * q16 / 4) * (1 + 1e-9));
  CHECK(centred < plain / 2);
}

TEST_CASE("hard case 7: near : far = 1 : 100,000 hides what a fitted range shows") {
  const auto light_behind = [](double near, double far) {
    const auto depth = [&](double z) { return (z - near) / (far - near); };
    const auto keep = [](double v) { return round_to(unorm16_code, v); };
    const double x = depth(2.0), t = depth(2.5);
    return chebyshev(mean_and_variance(keep(x), keep(x * x)), t, 1e-5);
  };
  const double wide = light_behind(1, 100000), fitted = light_behind(1, 4);
  CHECK((wide >= 0 && wide <= 1));
  CHECK(wide > 0.99);  // a whole unit of distance is a fraction of one code
  CHECK(fitted < 0.001);
}

TEST_CASE("hard case 8: a layer of next to no width stays finite, and its floor at most 1") {
  in_every_arithmetic([](auto zero) {
    using T = decltype(zero);
    for (const double near : {0.0, 0.5, 1 - 0x1p-12}) {
      for (const double width : {0x1p-24, 0x1p-12}) {
        // Half and bfloat16 cannot tell such bounds apart; what they give is still a number.
        const interval layer{near, near + width};
        for (const double min_variance : {0.0, 1e-5, 1.0}) {
          const T floor = layer_floor<T>(min_variance, layer);
          CHECK((number(floor) >= 0 && number(floor) <= 1));
          if constexpr (std::is_same_v<T, float> || std::is_same_v<T, double> || is_exact<T>) {
            const T below = warp(static_cast<T>(near), layer);
            const T above = warp(static_cast<T>(near + width), layer);
            CHECK(number(below) == 0);
            CHECK(number(above) == 1);
            const double p = number(chebyshev<T>({below, zero - zero}, above, floor));
            CHECK((p >= 0 && p <= 0.5));
          }
        }
      }
    }
  });
  // In the limit the warp is a step: everything up to the split is 0, everything past it 1.
  const interval step{0.5, 0.5 + split_grid};
  for (const float x : {0.0F, 0.3F, 0.5F}) CHECK(warp(x, step) == 0);
  for (const float x : {0.5F + 0x1p-23F, 0.7F, 1.0F}) CHECK(warp(x, step) == 1);
}

TEST_CASE("hard cases 10 and 11: a tie belongs to the nearer layer, t = 1 to the last") {
  for (const int layers : {1, 2, 4, 8, 16, 3, 7, 14}) {
    const auto splits = uniform_splits(layers);
    REQUIRE(splits.size() == static_cast<std::size_t>(layers) + 1);
    for (int i = 1; i <= layers; ++i) {
      const double s = splits[static_cast<std::size_t>(i)];
      CHECK(layer_of(s, splits) == i - 1);
      CHECK(layer_of(static_cast<float>(s), splits) == i - 1);
      CHECK(layer_of(exact_rational(s), splits) == i - 1);
      if (i < layers) CHECK(layer_of(s + 0x1p-30, splits) == i);
      if ((layers & (layers - 1)) == 0) {
        CHECK(uniform_layer_of(s, layers) == i - 1);
        if (i < layers) CHECK(uniform_layer_of(s + 0x1p-30, layers) == i);
      }
    }
    for (const double t : {1.0, 1.5, 1e30}) {
      CHECK(layer_of(t, splits) == layers - 1);
      CHECK(uniform_layer_of(t, layers) == layers - 1);
    }
    for (const double t : {0.0, -0.0, -1.0}) {
      CHECK(layer_of(t, splits) == 0);
      CHECK(uniform_layer_of(t, layers) == 0);
    }
  }
}

TEST_CASE(
    "hard cases 12 and 14: depths outside [0,1] and the clear value keep moments consistent") {
  in_every_arithmetic([](auto zero) {
    using T = decltype(zero);
    for (const interval& layer : {interval{0, 1}, interval{0.25, 0.5}, interval{0.5, 1}}) {
      for (const double x : {-1e4, -1.0, -0.0, 0.0, 1.0, 1.5, 3e4}) {
        const T y = warp(clamp_depth(static_cast<T>(x)), layer);
        CHECK((number(y) == 0 || number(y) == 1));
        // One texel: M2 = M1^2, no variance at all.
        CHECK(number(mean_and_variance(y, y * y).variance) == 0);
      }
      // Never drawn: nothing lies before any receiver, the last one included.
      const T clear = warp(clamp_depth(static_cast<T>(1)), layer);
      for (const double t : {0.0, 0.3, 0.75, 1.0, 2.0}) {
        const T at = warp(clamp_depth(static_cast<T>(t)), layer);
        CHECK(number(chebyshev<T>({clear, zero - zero}, at, static_cast<T>(1e-5))) == 1);
      }
    }
  });
}

TEST_CASE("hard case 17: squaring before or after the first moment is rounded, for all halves") {
  const encoding half = binary16::value;
  double worst_before = 0, worst_after = 0, furthest = 0;
  for (std::uint64_t bits = 0x2000; bits < 0x3c00; ++bits) {  // from 2^-7, where squares are normal
    for (const double part : {0.25, 0.49, 0.5, 0.75}) {
      const double x = decode(half, bits) + part * (decode(half, bits + 1) - decode(half, bits));
      const double stored = round_to(half, x);
      const double before = round_to(half, x * x), after = round_to(half, stored * stored);
      const int exponent = std::ilogb(x * x) - 10;
      furthest = std::max(furthest, std::fabs(before - after) / std::ldexp(1.0, exponent));
      worst_before = std::max(worst_before, std::fabs(before - stored * stored));
      worst_after = std::max(worst_after, std::fabs(after - stored * stored));
    }
  }
  CAPTURE(furthest, worst_before, worst_after);
  CHECK(furthest >= 1);
  CHECK(furthest <= 2);
  CHECK(worst_after <= 0x1p-12);          // half a unit of M2 in [1/2, 1): 2^-12
  CHECK(worst_before > 2 * worst_after);  // and the first moment's own rounding, 2 mu 2^-12, on top
}

TEST_CASE("hard cases 18 and 19: where squares turn subnormal or vanish") {
  const encoding half = binary16::value;
  rules flushed;
  flushed.subnormal = subnormals::flush_output;
  const double smallest_normal = 0x1p-14;
  CHECK(round_to(half, 0x1p-7 * 0x1p-7) == smallest_normal);
  const double below = 0x1p-7 - 0x1p-18;
  CHECK(round_to(half, below * below) < smallest_normal);
  CHECK(round_to(half, below * below) > 0);
  CHECK(round_to(half, below * below, flushed) == 0);
  const double vanishing = 0x1.6a09p-13;  // just under 2^-12.5
  CHECK(round_to(half, vanishing * vanishing) == 0);
  CHECK(round_to(half, 0x1.6a0ap-13 * 0x1.6a0ap-13) == 0x1p-24);
  CHECK(round_to(unorm16_code, 0x1p-16) == q16);
  CHECK(round_to(unorm16_code, 181.0 / 65535 * (181.0 / 65535)) == 0);
  CHECK(round_to(unorm16_code, 182.0 / 65535 * (182.0 / 65535)) == q16);
}

TEST_CASE("hard case 20: truncation at the store biases the light, to nearest does not") {
  rules truncated;
  truncated.direction = rounding::toward_zero;
  double nearest = 0, down = 0;
  int count = 0;
  for (int i = 1; i < 60000; ++i) {
    const double x = (i + 0.618) / 60001;
    const auto variance = [&](const rules& r) {
      return mean_and_variance(round_to(unorm16_code, x, r), round_to(unorm16_code, x * x, r))
          .variance;
    };
    nearest += variance({});
    down += variance(truncated);
    ++count;
  }
  CAPTURE(nearest / count / q16, down / count / q16);
  CHECK(std::fabs(nearest / count) < 0.02 * q16);
  CHECK(std::fabs(down / count) < 0.1 * q16);
  // E[2 mu e - e] = (2 mu - 1) q/2 over all depths: no bias on average, but far from none at mu
  // = 1.
  double near_one = 0;
  for (int i = 0; i < 10000; ++i) {
    const double x = 1 - (i + 0.618) * 0x1p-24 * 7;
    near_one += mean_and_variance(round_to(unorm16_code, x, truncated),
                                  round_to(unorm16_code, x * x, truncated))
                    .variance;
  }
  CHECK(near_one / 10000 > 0.3 * q16);
}

TEST_CASE("hard case 36: bleeding reduction up to alpha = 1 is no 0/0") {
  in_every_arithmetic([](auto zero) {
    using T = decltype(zero);
    for (const double alpha : {0.0, 0.3, 0.5, 0.999, 1 - 0x1p-24, 1 - 0x1p-53, 1.0}) {
      double before = -1;
      for (const double p : {0.0, 0x1p-20, 0.25, 0.5, 0.75, 1 - 0x1p-7, 1.0}) {
        const double reduced = number(reduce_bleeding(static_cast<T>(p), static_cast<T>(alpha)));
        CAPTURE(alpha, p, reduced);
        CHECK((reduced >= 0 && reduced <= 1));
        CHECK(reduced >= before);
        if (p == 1) CHECK(reduced == 1);
        if (alpha == 0) CHECK(reduced == number(static_cast<T>(p)));
        before = reduced;
      }
    }
    CHECK(number(zero) == 0);
  });
}

TEST_CASE("hard case 41: in half, squares of differences underflow and floors of 0 give no NaN") {
  using half = real<binary16>;
  int underflown = 0;
  for (std::uint16_t bits = 0; bits < 0x3c00; ++bits) {
    const half mu = half::from_bits(bits),
               t = half::from_bits(static_cast<std::uint16_t>(bits + 1));
    const half d = t - mu;
    underflown += static_cast<double>(d * d) == 0 ? 1 : 0;
    for (const half floor : {half(0), half(0x1p-24), half(1e-4)}) {
      const double p = static_cast<double>(chebyshev(mean_variance<half>{mu, half(0)}, t, floor));
      if (!(p >= 0 && p <= 1)) {
        CAPTURE(bits, p);
        FAIL("a visibility that is none");
      }
    }
  }
  CHECK(underflown > 0x3c00 * 3 / 4);
}
