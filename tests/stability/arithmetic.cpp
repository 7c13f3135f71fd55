// The hard cases of arithmetic, 38, 41 and 42, in every format that they concern.
#include <xmmintrin.h>

#include <cfenv>
#include <clocale>
#include <cmath>
#include <string>

#include "bitshade/arithmetic/environment.hpp"
#include "bitshade/arithmetic/pack_math.hpp"
#include "bitshade/arithmetic/real_limits.hpp"
#include "bitshade/arithmetic/real_math.hpp"
#include "bitshade/arithmetic/real_text.hpp"
#include "bitshade/formats/hexadecimal.hpp"
#include "bitshade/formats/name.hpp"
#include "bitshade/formats/random.hpp"
#include "bitshade/shadow/chebyshev.hpp"
#include "support/catch.hpp"
#include "support/operation_oracle.hpp"

using namespace bitshade;
using half = real<binary16>;

namespace {

/// fma, product, quotient and root of random numbers near each other against MPFR, in real as it computes them.
template <class T>
void rounds_once() {
  constexpr encoding e = T::encoding_value;
  oracle::calculator truth(e);
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const std::uint64_t x = random_bits(1, i) & low_bits(e.width) & ~sign_bit(e);
    std::uint64_t y = random_bits(2, i) & low_bits(e.width);
    if (i % 2 == 0) y = x ^ (y & low_bits(e.fraction_bits));
    // An addend whose half step the product straddles.
    const std::uint64_t z = multiply(e, x, y) ^ (random_bits(3, i) & (sign_bit(e) | 3));
    const auto of = [](std::uint64_t b) { return T::from_bits(static_cast<typename T::bits_type>(b)); };
    const auto expect = [&](const char* what, oracle::operation op, T got) {
      truth.compute(op, x, y, z);
      std::uint64_t want = truth.bits({});
      if ((want & ~sign_bit(e)) == nan_bits(e)) want = nan_bits(e);  // real has one NaN
      INFO(name_of(e) << ' ' << what << ' ' << oracle::hex(x) << ' ' << oracle::hex(y) << ' ' << oracle::hex(z)
                      << ": got " << oracle::hex(got.bits()) << ", MPFR has " << oracle::hex(want));
      if (got.bits() != want) FAIL_CHECK("rounded twice");
    };
    expect("fma", oracle::operation::fma, fma(of(x), of(y), of(z)));
    expect("x", oracle::operation::multiply, of(x) * of(y));
    expect("/", oracle::operation::divide, of(x) / of(y));
    expect("sqrt", oracle::operation::square_root, sqrt(of(x)));
  }
  // (1 + u) u/2 (1 - u) + 1 + u with u = 2^-M lies u^3/2 below a tie that goes up: three times a significand apart.
  if constexpr (min_exponent(e) <= -e.fraction_bits - 1) {
    const auto code = [&](double v, int steps) {
      return T::from_bits(static_cast<typename T::bits_type>(encode(e, v) + static_cast<std::uint64_t>(steps)));
    };
    const T odd = code(1, 1), nearly = code(std::ldexp(1.0, -e.fraction_bits - 1), -2);
    INFO(name_of(e));
    CHECK(fma(odd, nearly, odd) == odd);
    CHECK(fma(odd, -nearly, code(1, 2)) == code(1, 2));
  }
}

/// Depths t one step beyond mu with variance 0: how many squares (t - mu)^2 are 0, and whether any bound is NaN.
template <class T>
void adjacent_depths(double at_least) {
  constexpr encoding e = T::encoding_value;
  const std::uint64_t one = encode(e, 1.0), step = one / 20000 + 1;
  int zero = 0, adjacent = 0;
  for (std::uint64_t c = 0; c < one; c += step) {
    const auto of = [](std::uint64_t b) { return T::from_bits(static_cast<typename T::bits_type>(b)); };
    const T mu = of(c), t = of(c + 1), square = (t - mu) * (t - mu);
    ++adjacent;
    zero += square == T(0);
    // A floor of the smallest number, or none at all, where the comparison of the sum with 0 decides.
    const T least = std::numeric_limits<T>::denorm_min();
    const T with_floor = chebyshev(mean_variance<T>{mu, T(0)}, t, least), without = chebyshev(mean_variance<T>{mu, T(0)}, t, T(0));
    INFO(name_of(e) << " mu " << oracle::hex(c) << ": " << static_cast<double>(with_floor) << ", " << static_cast<double>(without));
    if (!(without == T(0) && with_floor >= T(0) && with_floor <= T(1))) FAIL_CHECK("no bound");
    if (square == T(0) && with_floor != T(1)) FAIL_CHECK("the floor does not decide");
  }
  INFO(name_of(e) << ": " << zero << " of " << adjacent);
  CHECK(zero >= at_least * adjacent);
}

}  // namespace

TEST_CASE("hard case 38: nothing is rounded twice, by fma or in formats wider than half the carrier") {
  // a b + c = 1 + 2^-10 + 2^-11 - 2^-31 lies just below a tie of half; binary32 rounds it onto the tie, which goes up.
  const half a(1 + 0x1p-10), b(0x1.ff8p-12), c(1 + 0x1p-10);
  CHECK(fma(a, b, c).bits() == 0x3c01);
  CHECK(half(std::fma(static_cast<float>(a), static_cast<float>(b), static_cast<float>(c))).bits() == 0x3c02);
  rounds_once<real<binary16>>();
  rounds_once<real<binary16, rules{}, double>>();
  rounds_once<real<bfloat16>>();
  rounds_once<real<bfloat16, rules{}, float>>();
  rounds_once<real<tf32>>();
  rounds_once<real<binary32>>();
  rounds_once<real<binary64>>();
  rounds_once<real<fp8_e5m2>>();
  rounds_once<real<fp8_e4m3>>();
  rounds_once<real<binary<8, 20>, rules{}, float>>();
  rounds_once<real<binary<8, 30>>>();
  rounds_once<real<binary<11, 30>>>();
  rounds_once<real<binary<2, 52>>>();
}

TEST_CASE("hard case 41: (t - mu)^2 of adjacent depths underflows in short formats, and no bound is NaN") {
  CHECK(isnan(half(0) / half(0)));
  adjacent_depths<half>(0.5);
  adjacent_depths<real<binary16, rules{.subnormal = subnormals::flush_both}>>(0.5);
  adjacent_depths<real<fp8_e5m2>>(0);
  adjacent_depths<real<fp8_e4m3>>(0.3);
  adjacent_depths<real<binary<4, 11>>>(0.5);
  adjacent_depths<real<bfloat16>>(0);
  adjacent_depths<real<unorm16>>(1);
  adjacent_depths<real<unorm8>>(1);
  adjacent_depths<real<snorm16>>(1);
  adjacent_depths<real<fixed<4, 12>>>(1);
  // Over packs as well.
  using many = real<binary16, rules{}, pack<float>>;
  const many mu(0.5), t(half(0.5) + std::numeric_limits<half>::epsilon() / half(4)), zero(0);
  CHECK(!any(isnan(chebyshev(mean_variance<many>{mu, zero}, t, zero))));
}

TEST_CASE("hard case 42: the caller's environment changes nothing, and comes back") {
  struct answers {
    std::uint64_t encoded, subnormal, text, quotient, exponential, carried;
    bool operator==(const answers&) const = default;
  };
  volatile double third = 1.0 / 3;
  volatile float a = 0.1f, b = 0.3f;
  const auto work = [&] {
    const default_environment guard;
    return answers{encode(binary16::value, third),
                   encode(binary16::value, 0x1.8p-24),
                   encode(binary64::value, parse_number("0.1").value()),
                   divide(binary32::value, 0x3f800000, 0x40400000),
                   std::uint64_t{exp(half(1)).bits()},
                   std::uint64_t{(real<binary32>(a) * real<binary32>(b)).bits()}};
  };
  const answers calm = work();
  const unsigned control = _mm_getcsr();
  for (const int direction : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::fesetround(direction);
    _mm_setcsr(_mm_getcsr() | 0x8040);  // flush to zero, denormals are zero
    const answers hostile = work();
    const int kept = std::fegetround();
    const unsigned flags = _mm_getcsr() & 0x8040;
    // encode, parse and operations.hpp need no guard at all.
    const std::uint64_t bare = encode(binary16::value, third), small = encode(binary16::value, 0x1.8p-24);
    const std::uint64_t ratio = divide(binary32::value, 0x3f800000, 0x40400000);
    _mm_setcsr(control);
    std::fesetround(FE_TONEAREST);
    CHECK(hostile == calm);
    CHECK(kept == direction);
    CHECK(flags == 0x8040);
    CHECK(bare == calm.encoded);
    CHECK(small == calm.subnormal);
    CHECK(ratio == calm.quotient);
  }
  if (std::setlocale(LC_ALL, "de_DE.UTF-8") != nullptr || std::setlocale(LC_ALL, "fr_FR.UTF-8") != nullptr)
    CHECK(work() == calm);
  std::setlocale(LC_ALL, "C");
  CHECK(hexadecimal(0.1) == "0x1.999999999999ap-4");
}
