// The exact functions of <cmath>, held against the C library's, which are exact too.
#include "bitshade/arithmetic/real_math.hpp"

#include <bit>
#include <cmath>
#include <set>
#include <sstream>
#include <unordered_set>

#include "bitshade/arithmetic/real_limits.hpp"
#include "bitshade/arithmetic/real_text.hpp"
#include "bitshade/formats/random.hpp"
#include "support/catch.hpp"

using namespace bitshade;
using namespace bitshade::literals;

namespace {

using half = real<binary16>;
using single = real<binary32>;

bool same(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b) || (std::isnan(a) && std::isnan(b));
}

// At compile time as well.
static_assert(exp(half(1)).bits() == 0x4170);
static_assert(pow(half(2), 3) == 8 && floor(half(-0.5)) == -1 && fmod(half(7), 2.5) == half(2));
static_assert(0.1_half == half(0.1) && 1'000.5e-1_half == half(100.05));
static_assert(nextafter(half(0), half(-1)).bits() == 0x8001);

template <class Ours, class Native>
constexpr bool same_limits() {
  using a = std::numeric_limits<Ours>;
  using b = std::numeric_limits<Native>;
  return a::is_iec559 && a::digits == b::digits && a::digits10 == b::digits10 && a::max_digits10 == b::max_digits10 &&
         a::min_exponent == b::min_exponent && a::max_exponent == b::max_exponent &&
         a::min_exponent10 == b::min_exponent10 && a::max_exponent10 == b::max_exponent10 &&
         static_cast<Native>(a::max()) == b::max() && static_cast<Native>(a::min()) == b::min() &&
         static_cast<Native>(a::lowest()) == b::lowest() && static_cast<Native>(a::epsilon()) == b::epsilon() &&
         static_cast<Native>(a::denorm_min()) == b::denorm_min() &&
         static_cast<Native>(a::infinity()) == b::infinity() && static_cast<Native>(a::round_error()) == b::round_error();
}
static_assert(same_limits<real<binary32>, float>() && same_limits<real<binary64>, double>());
static_assert(std::numeric_limits<real<fp8_e4m3>>::max() == real<fp8_e4m3>(448));
static_assert(std::numeric_limits<real<unorm16>>::epsilon() == real<unorm16>(1.0 / 65535));

}  // namespace

TEST_CASE("floor, fmod, remainder, frexp ... of real are the C library's, bit for bit") {
  std::uint64_t wrong = 0;
  for (std::uint64_t i = 0; i < 60000; ++i) {
    float x = std::bit_cast<float>(static_cast<std::uint32_t>(random_bits(1, i)));
    float y = std::bit_cast<float>(static_cast<std::uint32_t>(random_bits(2, i)));
    if (i % 2 == 0) x = static_cast<float>(static_cast<int>(random_bits(3, i) % 4001) - 2000) / 4;
    if (i % 4 == 0) y = static_cast<float>(static_cast<int>(random_bits(4, i) % 401) - 200) / 8;
    // glibc's fmin answers a signalling NaN with NaN; real has quiet ones alone.
    if (std::isnan(x)) x = std::copysign(std::numeric_limits<float>::quiet_NaN(), x);
    if (std::isnan(y)) y = std::copysign(std::numeric_limits<float>::quiet_NaN(), y);
    const single a(x), b(y);
    int n = 0, m = 0;
    const bool good = same(float(floor(a)), std::floor(x)) && same(float(ceil(a)), std::ceil(x)) &&
                      same(float(trunc(a)), std::trunc(x)) && same(float(round(a)), std::round(x)) &&
                      same(float(rint(a)), std::rint(x)) && same(float(fmod(a, b)), std::fmod(x, y)) &&
                      same(float(remainder(a, b)), std::remainder(x, y)) &&
                      same(float(nextafter(a, b)), std::nextafter(x, y)) &&
                      same(float(fmin(a, b)), std::fmin(x, y)) && same(float(fmax(a, b)), std::fmax(x, y)) &&
                      same(float(copysign(a, b)), std::copysign(x, y)) && same(float(ldexp(a, 7)), std::ldexp(x, 7)) &&
                      same(float(frexp(a, &n)), std::frexp(x, &m)) && (n == m || !std::isfinite(x)) &&
                      isnan(a) == std::isnan(x) && isinf(a) == std::isinf(x) && isnormal(a) == std::isnormal(x) &&
                      signbit(a) == std::signbit(x);
    if (!good && wrong++ == 0) {
      INFO("x = " << std::hexfloat << x << ", y = " << y << ": floor " << float(floor(a)) << ", fmod "
                  << float(fmod(a, b)) << ", remainder " << float(remainder(a, b)) << ", nextafter "
                  << float(nextafter(a, b)));
      CHECK(good);
    }
  }
  CHECK(wrong == 0);
}

TEST_CASE("real streams and parses with one rounding") {
  std::istringstream in(" 1.00048828125000000000000000001) -inf 0x1.8p+1 abc");
  half x;
  char bracket = 0;
  in >> x >> bracket;
  CHECK(x.bits() == 0x3c01);  // by way of double it would be a tie, and go to 0x3c00
  CHECK(bracket == ')');
  in >> x;
  CHECK(x.bits() == 0xfc00);
  in >> x;
  CHECK(x == half(3));
  CHECK(!(in >> x));
  std::ostringstream out;
  out << half(0.1) << ' ' << real<unorm8>(0.5);
  CHECK(out.str() == "0.0999756 0.501961");
}

TEST_CASE("real converts once from everything") {
  CHECK(half(0x1.0020000000000002p+0L).bits() == 0x3c01);  // long double, just above a tie
  CHECK(real<binary32>(std::int64_t{16777217}) == real<binary32>(16777216));
  CHECK(real<binary64>(std::uint64_t{0xfffffffffffffbff}) == real<binary64>(0x1.fffffffffffffp+63));
  CHECK(half(std::int64_t{-70000}).bits() == 0xfc00);
  CHECK(real<unorm8>(-3) == real<unorm8>(0));
  CHECK(std::is_convertible_v<half, real<binary32>>);
  CHECK_FALSE(std::is_convertible_v<real<binary32>, half>);
  CHECK_FALSE(std::is_convertible_v<half, float>);
}

TEST_CASE("real hashes equal numbers alike and sorts") {
  CHECK(std::hash<half>()(half(-0.0)) == std::hash<half>()(half(0.0)));
  std::unordered_set<half> bag{half(1), half(2), half(1)};
  CHECK(bag.size() == 2);
  const half low(0.5), high(1.5);
  CHECK(std::min(low, high) == low);
  CHECK(std::max(low, high) == high);
}
