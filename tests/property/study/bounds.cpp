// The bounds of study/ against exact arithmetic: never violated, and how nearly attained.
#include <rapidcheck.h>

#include <cstdint>
#include <vector>

#include "bitshade/interop/rational.hpp"
#include "bitshade/study/bounds_visibility.hpp"
#include "bitshade/study/precision.hpp"
#include "claims/adversarial.hpp"
#include "support/catch.hpp"

using namespace bitshade;

namespace {

using number = rational;
using boost::multiprecision::cpp_int;

enum class direction { nearest, toward_zero };

/// x >= 0 on a grid of `steps` steps in [0,1].
number on_grid(const number& x, std::int64_t steps, direction way = direction::nearest) {
  const number scaled = way == direction::nearest ? x * steps + number(1, 2) : x * steps;
  const cpp_int code = numerator(scaled) / denominator(scaled);
  return number(code, steps);
}

struct moments {
  number first, second;
  number variance() const { return second - first * first; }
};

/// Texels with integer weights.
struct footprint {
  std::vector<std::uint32_t> depth;  // units of 2^-24
  std::vector<unsigned> weight;

  number at(std::size_t i) const { return number(depth[i], 1 << 24); }
  number sum() const {
    number s = 0;
    for (const unsigned w : weight) s += w;
    return s;
  }
  template <class First, class Second>
  moments mean(First first, Second second) const {
    moments m{0, 0};
    for (std::size_t i = 0; i < depth.size(); ++i) {
      m.first += first(at(i)) * weight[i];
      m.second += second(at(i)) * weight[i];
    }
    return {m.first / sum(), m.second / sum()};
  }
  moments exact() const {
    return mean([](const number& x) { return x; }, [](const number& x) { return number(x * x); });
  }
};

footprint any_footprint() {
  const auto count = *rc::gen::inRange<std::size_t>(1, 9);
  return {*rc::gen::container<std::vector<std::uint32_t>>(
              count, rc::gen::weightedOneOf<std::uint32_t>(
                         {{3, rc::gen::inRange<std::uint32_t>(0, (1 << 24) + 1)},
                          {1, rc::gen::inRange<std::uint32_t>((1 << 24) - 2000, (1 << 24) + 1)},
                          {1, rc::gen::inRange<std::uint32_t>(0, 2000)}})),
          *rc::gen::container<std::vector<unsigned>>(count, rc::gen::inRange(1u, 17u))};
}

std::int64_t any_steps() { return (std::int64_t{1} << *rc::gen::inRange(2, 21)) - 1; }

number clamped(const number& v, const number& floor) { return v < floor ? floor : v; }

number chebyshev(const number& mean, const number& v, const number& t) {
  const number d = t - mean;
  return d > 0 ? number(v / (v + d * d)) : number(1);
}

template <class F>
bool held(const char* what, F property) {
  return rc::check(what, property);  // prints the seed; RC_PARAMS repeats it
}

}  // namespace

TEST_CASE("rounding to nearest moves the variance within its bound, store by store") {
  CHECK(held("variance_error", [] {
    const footprint texels = any_footprint();
    const std::int64_t steps = any_steps();
    const int extra = *rc::gen::inRange(0, 4);
    const moments truth = texels.exact();
    moments got = texels.mean([&](const number& x) { return on_grid(x, steps); },
                              [&](const number& x) { return on_grid(x * x, steps); });
    for (int k = 0; k < extra; ++k) {  // stored again, then averaged with itself elsewhere
      got = {on_grid(got.first, steps), on_grid(got.second, steps)};
    }
    const number e = moment_error(number(1, steps), extra + 1);
    const auto bound = variance_error(e, truth.first);
    const number error = got.variance() - truth.variance();
    RC_ASSERT(-error <= bound.down);
    RC_ASSERT(error <= bound.up);
  }));
}

TEST_CASE("truncation moves the variance within its bound") {
  CHECK(held("variance_error_truncated", [] {
    const footprint texels = any_footprint();
    const std::int64_t steps = any_steps();
    const auto cut = [&](const number& x) { return on_grid(x, steps, direction::toward_zero); };
    const moments truth = texels.exact();
    moments got = texels.mean(cut, [&](const number& x) { return cut(x * x); });
    got = {cut(got.first), cut(got.second)};
    const auto bound = variance_error_truncated(number(1, steps), 2, truth.first);
    const number error = got.variance() - truth.variance();
    RC_ASSERT(-error <= bound.down);
    RC_ASSERT(error <= bound.up);
  }));
}

TEST_CASE("centred storage and the square of the stored moment keep their bounds") {
  CHECK(held("variance_error_centred", [] {
    const footprint texels = any_footprint();
    const std::int64_t steps = any_steps();
    const moments truth = texels.exact();
    const auto centred = [](const number& x) { return number((2 * x - 1) * (2 * x - 1)); };
    const moments got = texels.mean([&](const number& x) { return on_grid(x, steps); },
                                    [&](const number& x) { return on_grid(centred(x), steps); });
    const number y = 2 * got.first - 1;
    const number error = (got.second - y * y) / 4 - truth.variance();
    const number bound = variance_error_centred(moment_error(number(1, steps), 1), truth.first);
    RC_ASSERT(error <= bound);
    RC_ASSERT(-error <= bound);
  }));
  CHECK(held("variance_error_square_of_stored", [] {
    const footprint texels = any_footprint();
    const std::int64_t steps = any_steps();
    const moments truth = texels.exact();
    const auto stored = [&](const number& x) { return on_grid(x, steps); };
    const moments got =
        texels.mean(stored, [&](const number& x) { return on_grid(stored(x) * stored(x), steps); });
    const number error = got.variance() - truth.variance();
    // The bound is affine in sigma: |error| - q/2 - q^2/4 <= sigma q, compared by squares.
    const number q(1, steps);
    const number rest = abs(error) - variance_error_square_of_stored(q, number(0));
    if (truth.variance() == 0) {
      RC_ASSERT(rest <= 0);
    } else if (rest > q * q / 4) {
      RC_ASSERT((rest - q * q / 4) * (rest - q * q / 4) <= truth.variance() * q * q);
    }
  }));
}

TEST_CASE("weights that sum to 1 + o shift the variance by exactly the closed form") {
  CHECK(held("unnormalised_shift", [] {
    const footprint texels = any_footprint();
    const moments truth = texels.exact();
    const number o(*rc::gen::inRange(-50, 51), 1000);
    const number first = (1 + o) * truth.first, second = (1 + o) * truth.second;
    RC_ASSERT(second - first * first - truth.variance() ==
              unnormalised_shift(o, truth.first, truth.variance()));
  }));
}

TEST_CASE("a floored visibility stays within its bound for every receiver") {
  CHECK(held("visibility_error", [] {
    const footprint texels = any_footprint();
    const std::int64_t steps = any_steps();
    const number t(*rc::gen::inRange(0, (1 << 16) + 1), 1 << 16);
    const int floor_bits = *rc::gen::inRange(2, 24);
    const number floor(1, 1 << floor_bits);
    const moments truth = texels.exact();
    const moments got = texels.mean([&](const number& x) { return on_grid(x, steps); },
                                    [&](const number& x) { return on_grid(x * x, steps); });
    const double e = moment_error(1.0 / static_cast<double>(steps), 1);
    const double noise = variance_error(e, static_cast<double>(truth.first)).width() *
                         bitshade::detail::outward;
    const number bound(visibility_error(noise, e, static_cast<double>(floor)));
    const number error = chebyshev(got.first, clamped(got.variance(), floor), t) -
                         chebyshev(truth.first, clamped(truth.variance(), floor), t);
    RC_ASSERT(abs(error) <= bound);
  }));
}

TEST_CASE("floating moments of a warp keep their bound") {
  CHECK(held("variance_error_floating", [] {
    const footprint texels = any_footprint();
    const int p = *rc::gen::inRange(4, 20);
    const number u(1, std::int64_t{1} << p);
    // Any relative errors within u, the extreme ones first.
    const auto relative = [&] { return number(*rc::gen::inRange(-8, 9), 8) * u; };
    const moments truth = texels.exact();
    const number first = truth.first * (1 + relative()), second = truth.second * (1 + relative());
    number largest = 0;
    for (std::size_t i = 0; i < texels.depth.size(); ++i) {
      if (largest < texels.at(i)) largest = texels.at(i);
    }
    const number error = second - first * first - truth.variance();
    RC_ASSERT(abs(error) <= variance_error_floating(u, largest));
  }));
}

TEST_CASE("the variance bound is tight: adversarial texels reach 97 % of it on both sides") {
  for (const int bits : {12, 16, 20}) {
    const std::int64_t steps = (std::int64_t{1} << bits) - 1;
    for (const double mean : {0.3, 0.97}) {
      for (const auto side :
           {claims::worst::variance_too_small, claims::worst::variance_too_large}) {
        const number x(claims::worst_texel(static_cast<double>(steps), mean, 0.02, side, 4000));
        const number error = on_grid(x * x, steps) - on_grid(x, steps) * on_grid(x, steps);
        const auto bound = variance_error(moment_error(number(1, steps), 1), x);
        const bool low = side == claims::worst::variance_too_small;
        const auto share =
            static_cast<double>(low ? number(-error / bound.down) : number(error / bound.up));
        CAPTURE(bits, mean, low, share);
        CHECK(share <= 1);
        CHECK(share >= 0.97);
      }
    }
  }
}

TEST_CASE("the visibility bound is tight: an adversarial pair reaches 95 % of it") {
  for (const int bits : {14, 16, 20}) {
    const std::int64_t steps = (std::int64_t{1} << bits) - 1;
    const double e = moment_error(1.0 / static_cast<double>(steps), 1);
    const double mean = 0.9;
    const double noise = variance_error(e, mean).width() * bitshade::detail::outward;
    for (const double ratio : {0.1, 1.0, 3.0}) {
      const double deviation = std::sqrt(noise / ratio + noise);
      const auto pair = claims::worst_footprint(static_cast<double>(steps), mean, deviation,
                                                deviation / 4, claims::worst::variance_too_small,
                                                4000);
      const number a(pair.a), b(pair.b);
      const number m1 = (a + b) / 2, v = (a * a + b * b) / 2 - m1 * m1;
      const number s1 = (on_grid(a, steps) + on_grid(b, steps)) / 2;
      const number s2 = (on_grid(a * a, steps) + on_grid(b * b, steps)) / 2;
      const number floor = s2 - s1 * s1;  // the stored variance, so that all its error counts
      REQUIRE(floor > 0);
      const auto f = static_cast<double>(floor);
      // d^2 = sqrt(v v'): where the two curves are furthest apart.
      const double d = std::sqrt(std::sqrt(f * static_cast<double>(v)));
      const number t = m1 + number(d);
      const auto error = static_cast<double>(
          number(abs(chebyshev(s1, floor, t) - chebyshev(m1, clamped(v, floor), t))));
      const double share = error / visibility_error_of_variance(noise / f);
      CAPTURE(bits, ratio, f / noise, share);
      CHECK(share >= 0.95);
      CHECK(error <= visibility_error(noise, e, f));
    }
  }
}
