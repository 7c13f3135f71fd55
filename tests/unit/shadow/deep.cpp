// Exact visibility functions against percentage-closer filtering; bleeding reduction's second form.
#include "bitshade/shadow/deep.hpp"

#include <cmath>
#include <vector>

#include "bitshade/interop/rational.hpp"
#include "bitshade/shadow/bleeding.hpp"
#include "bitshade/shadow/chebyshev.hpp"
#include "support/catch.hpp"

using namespace bitshade;

namespace {

using q = exact_rational;

struct region {
  std::vector<weighted_depth<q>> texels;
  /// Percentage-closer filtering: compare, then filter.
  q lit(const q& t) const {
    q share(0);
    for (const auto& texel : texels) {
      if (texel.depth >= t) share += texel.weight;
    }
    return share;
  }
};

region random_region(unsigned seed, int count) {
  region r;
  long long total = 0;
  std::vector<long long> weights;
  for (int i = 0; i < count; ++i) {
    seed = seed * 1664525u + 1013904223u;
    weights.push_back(1 + (seed >> 20) % 50);
    total += weights.back();
    r.texels.push_back({q(static_cast<int>((seed >> 8) % 17)) / q(16), q(0)});  // ties are common
  }
  for (std::size_t i = 0; i < weights.size(); ++i) {
    r.texels[i].weight = q(weights[i]) / q(total);
  }
  return r;
}

}  // namespace

TEST_CASE("a visibility function is percentage-closer filtering at every depth") {
  for (unsigned seed = 1; seed < 40; ++seed) {
    const region r = random_region(seed, 1 + static_cast<int>(seed) % 25);
    const auto function = visibility_of(r.texels);
    for (int i = -1; i <= 66; ++i) {
      const q t = q(i) / q(64);
      CAPTURE(seed, i);
      REQUIRE(function.light(t) == r.lit(t));
    }
    for (std::size_t i = 1; i < function.steps().size(); ++i) {
      REQUIRE(function.steps()[i - 1].depth < function.steps()[i].depth);
      REQUIRE(function.steps()[i - 1].light > function.steps()[i].light);
    }
    REQUIRE(function.steps().back().light == q(0));
  }
  CHECK(visibility_function<q>().light(q(1)) == q(1));
}

TEST_CASE("an opacity map is exact at its slices' middles") {
  const region r = random_region(77, 20);
  const auto function = visibility_of(r.texels);
  const auto map = opacity_map(function, 12);
  for (int i = 0; i < 12; ++i) {
    const q middle = (q(i) + q(0.5)) / q(12);
    CHECK(opacity_lookup<q>(map, middle) == r.lit(middle));
  }
  CHECK(opacity_lookup<q>(map, q(-1)) == map.front());
  CHECK(opacity_lookup<q>(map, q(1)) == map.back());
  CHECK(opacity_lookup<q>(map, q(5)) == map.back());
}

TEST_CASE("compression keeps within its tolerance and saves steps") {
  for (unsigned seed = 1; seed < 30; ++seed) {
    const region r = random_region(seed, 25);
    const auto function = visibility_of(r.texels);
    for (const q& tolerance : {q(0), q(1) / q(255), q(1) / q(10), q(1)}) {
      const auto less = compressed(function, tolerance);
      CHECK(less.steps().size() <= function.steps().size());
      for (int i = -1; i <= 66; ++i) {
        const q t = q(i) / q(64);
        CAPTURE(seed, i);
        REQUIRE(abs(less.light(t) - function.light(t)) <= tolerance);
      }
    }
    CHECK(compressed(function, q(1) / q(8)).steps().size() <= 5);  // light falls by 1 in all
    CHECK(compressed(function, q(1)).steps().empty());
  }
}

TEST_CASE("bleeding reduction: (11) and the power form keep 1, and never give more than 1") {
  for (int i = 0; i <= 1000; ++i) {
    const double p = i / 1000.0;
    const double power = reduce_bleeding_by_power(p);
    CHECK(power == Approx(std::min(1.0, std::pow(p, 1.3) + 0.65)).epsilon(1e-14));
    CHECK(std::fabs(power_of(p, 1.3) - std::pow(p, 1.3)) <= 0x1p-45 * std::pow(p, 1.3) + 0x1p-80);
    CHECK(reduce_bleeding_by_power(static_cast<float>(p)) <= 1);
    for (const double alpha : {0.0, 0.3, 0.6}) {
      CHECK(reduce_bleeding(p, alpha) == Approx(std::max(0.0, (p - alpha) / (1 - alpha))));
    }
  }
  CHECK(reduce_bleeding_by_power(0.0) == 0.65);
  CHECK(reduce_bleeding_by_power(1.0) == 1);
  CHECK(power_of(0.5, 2.0) == 0.25);
}
