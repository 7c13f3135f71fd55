// Code that has never heard of bitshade, and formats and policies that bitshade has never heard of.
#define FMT_HEADER_ONLY
#include <boost/math/tools/roots.hpp>
#include <complex>
#include <numeric>
#include <vector>

#include "bitshade/arithmetic/interval.hpp"
#include "bitshade/arithmetic/policy.hpp"
#include "bitshade/arithmetic/real_limits.hpp"
#include "bitshade/arithmetic/real_math.hpp"
#include "bitshade/arithmetic/real_text.hpp"
#include "bitshade/interop/fmt.hpp"
#include "bitshade/interop/rational.hpp"
#include "support/catch.hpp"

using namespace bitshade;

namespace stranger {

/// A template written for float: Horner, and a mean and variance in one pass.
template <class T>
T horner(const std::vector<T>& c, T x) {
  T sum = 0;
  for (auto i = c.rbegin(); i != c.rend(); ++i) sum = sum * x + *i;
  return sum;
}
template <class T>
std::pair<T, T> welford(const std::vector<T>& v) {
  T mean = 0, m2 = 0;
  int n = 0;
  for (const T& x : v) {
    ++n;
    const T d = x - mean;
    mean += d / T(n);
    m2 += d * (x - mean);
  }
  return {mean, m2 / T(n)};
}

/// A format of his own: a tag with an encoding and a type for its bits.
struct minifloat {
  static constexpr encoding value = unsigned_binary_encoding(4, 4);
  using bits_type = unsigned char;
};

/// A policy of his own, without a base class.
struct plan {
  using store = minifloat;
  using blur_store = unrounded;
  using mip_store = unorm8;
  using sat_store = unrounded;
  using metric = double;
  using warp = real<binary16>;
  using square = float;
  using resolve = float;
  using blur = float;
  using mip = float;
  using sat = double;
  using load = float;
  using filter = real<minifloat>;
  using lod = float;
  using probe = float;
  using receive = float;
  using variance = float;
  using shade = interval<double>;
  using transition = float;
  using lloyd = double;
};
static_assert(numeric_policy<plan>);
static_assert(!numeric_policy<minifloat>);

}  // namespace stranger

TEST_CASE("a stranger's template takes real, exact and interval") {
  using half = real<binary16>;
  CHECK(stranger::horner<half>({1, 2, 3}, half(2)) == half(17));
  CHECK(stranger::horner<exact_rational>({1, 2, 3}, exact_rational(1) / exact_rational(3)) == exact_rational(2));
  CHECK(stranger::horner<interval<double>>({1.0, 2.0, 3.0}, 0.1).contains(1.23));
  const auto [mean, variance] = stranger::welford<half>({1, 2, 3, 4});
  CHECK(mean == half(2.5));
  CHECK(variance == half(1.25));
  const std::vector<half> halves(4, half(0.5));
  CHECK(std::accumulate(halves.begin(), halves.end(), half(1)) == half(3));
}

TEST_CASE("a stranger's format rounds like any other") {
  using mini = real<stranger::minifloat>;
  CHECK(mini(0.1).bits() == encode(stranger::minifloat::value, 0.1));
  CHECK(mini(1) - mini(2) == mini(0));  // no sign: clamps
  CHECK(mini(3) * mini(5) == mini(15));
  CHECK(std::numeric_limits<mini>::digits == 5);
}

TEST_CASE("std::complex of real") {
  using half = real<binary16>;
  using complex = std::complex<half>;
  const complex a(half(1), half(2)), b(half(3), half(-1));
  CHECK(a * b == complex(half(5), half(5)));
  CHECK((a / b).real() == half(0.1));
  CHECK(std::norm(a) == half(5));
  CHECK(std::conj(a).imag() == half(-2));
  CHECK(std::abs(complex(half(3), half(4))) == half(5));
}

TEST_CASE("Boost.Math finds roots in emulated formats") {
  using single = real<binary32>;
  const auto f = [](single x) { return x * x - single(2); };
  const auto [low, high] = boost::math::tools::bisect(f, single(1), single(2), boost::math::tools::eps_tolerance<single>(22));
  CHECK(low <= sqrt(single(2)));
  CHECK(sqrt(single(2)) <= high);
  CHECK(high - low < single(1e-6));
}

TEST_CASE("fmt formats real as a double, and as a float what that holds") {
  // A float's shortest text is enough to tell it from every other.
  CHECK(fmt::format("{} {:.3e} {:a}", real<binary32>(0.1), real<binary32>(0.1), real<binary32>(0.1)) ==
        fmt::format("{} {:.3e} {:a}", 0.1f, 0.1f, 0.1f));
  CHECK(fmt::format("{} {}", real<binary64>(0.1), real<unorm8>(0.2)) == "0.1 0.2");
  CHECK(fmt::format("{:.3f} {}", real<binary16>(0.1), real<binary16>(2)) == "0.100 2");
}
