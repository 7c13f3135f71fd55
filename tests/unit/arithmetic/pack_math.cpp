// A template over packs gives, lane by lane, what it gives over scalars. Built once more for each wider instruction set.
#include "bitshade/arithmetic/pack_math.hpp"

#include "bitshade/formats/random.hpp"
#include "support/catch.hpp"

namespace {

using namespace bitshade;

/// A stranger's source: every function once.
template <class T>
T everything(int k, const T& x, const T& y) {
  switch (k) {
    case 0: return exp(-x * y) + exp2(x) + expm1(y);
    case 1: return log(x) * log2(y) - log10(x) / log1p(y);
    case 2: return pow(x, y) + pow(y, 2) + cbrt(x);
    case 3: return sin(x) * cos(y) + tan(x);
    case 4: return asin(x) + acos(y) + atan(x) + atan2(x, y);
    case 5: return sinh(x) + cosh(y) + tanh(x);
    case 6: return asinh(x) + acosh(y) + atanh(x);
    case 7: return floor(x) + ceil(y) + trunc(x) + round(y) + rint(x) + nearbyint(y);
    case 8: return fmod(y, x) + remainder(x, y) + hypot(x, y);
    case 9: return fmin(x, y) + fmax(x, 1) - fdim(x, y) + copysign(x, -y);
    case 10: return nextafter(x, y) + logb(x) + ldexp(y, 3);
    case 11: return fma(x, y, x);
    default: return sqrt(abs(x));
  }
}

template <class T>
auto word_of(T x) {
  return std::bit_cast<std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>>(x);
}

template <class Many, class One, class P, class Load>
void check(const char* what, Load load) {
  using T = typename P::scalar;
  constexpr int n = P::lanes;
  for (std::uint64_t j = 0; j < 64; j += n) {
    T a[n], b[n];
    for (int k = 0; k < n; ++k) {
      const auto u = [&](std::uint64_t key) {
        return static_cast<double>(random_bits(key, j + static_cast<std::uint64_t>(k)) >> 11) * 0x1p-53;
      };
      // Mostly in [-1, 4), with infinities and NaN among them.
      a[k] = static_cast<T>(One(5 * u(1) - 1)), b[k] = static_cast<T>(One(5 * u(2) - 1));
      if (u(3) < 0.05) a[k] = static_cast<T>(HUGE_VAL);
      if (u(3) > 0.95) b[k] = static_cast<T>(std::nan(""));
    }
    for (int f = 0; f < 13; ++f) {
      const auto got = everything<Many>(f, load(a), load(b));
      for (int k = 0; k < n; ++k) {
        const T expected = static_cast<T>(everything<One>(f, One(a[k]), One(b[k])));
        T lane;
        if constexpr (requires { got.carrier(); }) lane = got.carrier()[k];
        else lane = got[k];
        INFO(what << ", functions " << f << std::hex << " of 0x" << word_of(a[k]) << " and 0x" << word_of(b[k])
                  << ": got 0x" << word_of(lane) << ", the scalar has 0x" << word_of(expected));
        CHECK((word_of(lane) == word_of(expected) || (lane != lane && expected != expected)));
      }
    }
  }
}

template <class F, class P>
void check_real(const char* what) {
  using many = real<F, rules{}, P>;
  check<many, real<F, rules{}, typename P::scalar>, P>(
      what, [](const typename P::scalar* p) { return many::from_carrier(P::load(p)); });
}

TEST_CASE("<cmath> over a pack gives the scalar's bits") {
  check_real<binary16, pack<float>>("binary16");
  check_real<fp8_e5m2, pack<float, 2 * pack<float>::lanes>>("fp8_e5m2 over two registers");
  check_real<bfloat16, pack<double>>("bfloat16 in binary64");
  check<pack<float>, real<binary32>, pack<float>>("float", [](const float* p) { return pack<float>::load(p); });
  check<pack<double, 16>, real<binary64>, pack<double, 16>>("double", [](const double* p) {
    return pack<double, 16>::load(p);
  });
}

TEST_CASE("questions about a pack are answered by masks") {
  using P = pack<float>;
  const P x = select(P(1) < P(2), P(static_cast<float>(HUGE_VAL)), P(0));
  CHECK(all(isinf(x)));
  CHECK(!any(isnan(x)));
  CHECK(all(isnan(x - x)));
  CHECK(!any(isfinite(real<binary16, rules{}, P>::from_carrier(x))));
}

}  // namespace
