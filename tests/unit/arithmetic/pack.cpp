// A pack's lanes give what the scalar gives, bit for bit. Built once more for each wider instruction set.
#include "support/catch.hpp"

#include <bit>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "bitshade/arithmetic/pack.hpp"
#include "bitshade/arithmetic/real.hpp"
#include "bitshade/formats/name.hpp"
#include "bitshade/formats/random.hpp"
#include "bitshade/shadow/chebyshev.hpp"

namespace {

using namespace bitshade;

template <class T>
auto word_of(T x) {
  return std::bit_cast<std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>>(x);
}
/// Equal bits, or both NaN: real keeps no payload.
template <class T>
bool same(T a, T b) {
  return word_of(a) == word_of(b) || (a != a && b != b);
}

/// Numbers of a format: all of them for 8 bits, else random ones with the corners in between.
template <class Format>
double number(std::uint64_t j, std::uint64_t key) {
  constexpr encoding e = Format::value;
  std::uint64_t bits = random_bits(key, j) & low_bits(e.width);
  const std::uint64_t corners[] = {0, 1, min_normal_bits(e) - 1, min_normal_bits(e), max_bits(e), max_bits(e) + 1,
                                   infinity_bits(e) >> 1, (infinity_bits(e) >> 1) + 1};
  if (random_bits(key + 1, j) % 4 == 0) bits = (bits & sign_bit(e)) | corners[random_bits(key + 2, j) % 8];
  return decode(e, bits);
}

template <class Format, rules R, class T, class P = pack<T>>
void check(const char* what) {
  using one = real<Format, R, T>;
  using many = real<Format, R, P>;
  constexpr int n = P::lanes;
  for (std::uint64_t j = 0; j < 20000; j += n) {
    T a[n], b[n], c[n], wide[n];
    for (int k = 0; k < n; ++k) {
      const auto index = j + static_cast<std::uint64_t>(k);
      a[k] = static_cast<T>(number<Format>(index, 1)), b[k] = static_cast<T>(number<Format>(index, 10));
      c[k] = static_cast<T>(number<Format>(index, 20));
      wide[k] = std::bit_cast<T>(static_cast<decltype(word_of(T{}))>(random_bits(30, index)));
    }
    const auto load = [](const T* p) { return many::from_carrier(P::load(p)); };
    const many x = load(a), y = load(b), z = load(c);
    const struct {
      const char* name;
      many got;
      one (*expected)(one, one, one);
    } cases[] = {
        {"+", x + y, [](one u, one v, one) { return u + v; }},
        {"-", x - y, [](one u, one v, one) { return u - v; }},
        {"*", x * y, [](one u, one v, one) { return u * v; }},
        {"/", x / y, [](one u, one v, one) { return u / v; }},
        {"sqrt", sqrt(x), [](one u, one, one) { return sqrt(u); }},
        {"fma", fma(x, y, z), [](one u, one v, one w) { return fma(u, v, w); }},
        {"abs", abs(x), [](one u, one, one) { return abs(u); }},
        {"select", select(x < y, y, z), [](one u, one v, one w) { return u < v ? v : w; }},
        {"chebyshev", chebyshev(mean_and_variance(x, y), z, many(0.001f)),
         [](one u, one v, one w) { return chebyshev(mean_and_variance(u, v), w, one(0.001f)); }}};
    for (const auto& t : cases) {
      for (int k = 0; k < n; ++k) {
        const T expected = t.expected(one(a[k]), one(b[k]), one(c[k])).carrier(), got = t.got.carrier()[k];
        INFO(what << " " << t.name << std::hex << " a=0x" << word_of(a[k]) << " b=0x" << word_of(b[k]) << " c=0x"
                  << word_of(c[k]) << " expected=0x" << word_of(expected) << " got=0x" << word_of(got));
        if (!same(got, expected)) FAIL_CHECK("lanes differ from the scalar");
      }
    }
    const many rounded = load(wide);
    for (int k = 0; k < n; ++k) {
      const T expected = static_cast<T>(round_to(Format::value, static_cast<double>(wide[k]), R));
      INFO(what << " rounding" << std::hex << " in=0x" << word_of(wide[k]) << " expected=0x" << word_of(expected)
                << " got=0x" << word_of(rounded.carrier()[k]));
      if (!same(rounded.carrier()[k], expected)) FAIL_CHECK("lanes differ from the definition");
    }
  }
  SUCCEED();
}

constexpr rules saturating{.overflow = overflow::saturate};
constexpr rules flushing{.subnormal = subnormals::flush_output};

TEST_CASE("a real over a pack gives the scalar's bits") {
  check<binary16, rules{}, float>("binary16");
  check<binary16, saturating, float>("binary16 saturating");
  check<binary16, flushing, float>("binary16 flushing");
  check<fp8_e5m2, rules{}, float>("fp8_e5m2");
  check<fp8_e4m3, rules{}, float>("fp8_e4m3");
  check<binary<6, 9>, rules{}, float>("e6m9");
  check<binary16, rules{}, float, pack<float, 4 * pack<float>::lanes>>("binary16 over four registers");
  check<binary16, rules{}, float, pack<float, 2>>("binary16 over two lanes");
  check<binary16, rules{}, double>("binary16 in binary64");
  check<bfloat16, rules{}, double>("bfloat16 in binary64");
  check<tf32, rules{}, double>("tf32 in binary64");
}

TEST_CASE("a pack of floats is floats, side by side") {
  using P = pack<float>;
  constexpr int n = P::lanes;
  float a[n], b[n], c[n];
  for (int k = 0; k < n; ++k) a[k] = static_cast<float>(k) - 1.5f, b[k] = 0.25f * static_cast<float>(k + 1);
  const P x = P::load(a), y = P::load(b);
  (x * y - y / x).store(c);
  for (int k = 0; k < n; ++k) CHECK(word_of(c[k]) == word_of(a[k] * b[k] - b[k] / a[k]));
  CHECK(any(x < y));
  CHECK(!all(x < P(0)));
  CHECK((x < P(0))[0]);
  CHECK(!(!(x < P(0)))[1]);
  CHECK(word_of(P(-0.0f)[0]) == 0x80000000u);
  CHECK(word_of((-P(0.0f))[n - 1]) == 0x80000000u);
  static_assert(sizeof(P) == pack_bytes);
  static_assert(sizeof(real<binary16, rules{}, P>) == sizeof(P));
}

}  // namespace
