// Digests of what the headers compute, one a line: the same from every compiler, optimisation and instruction set, and
// in a hostile environment (`digest up`, down or zero). CMakeLists.txt builds it in several ways and compares what it prints.
#include <cfenv>
#include <cstdio>
#include <cstring>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include "bitshade/arithmetic/environment.hpp"
#include "bitshade/arithmetic/interval.hpp"
#include "bitshade/arithmetic/pack.hpp"
#include "bitshade/arithmetic/real_math.hpp"
#include "bitshade/arithmetic/samples.hpp"
#include "bitshade/formats/name.hpp"
#include "bitshade/formats/random.hpp"
#include "bitshade/formats/text.hpp"

using namespace bitshade;

namespace {

constexpr const char* formats[] = {"binary16", "bfloat16", "tf32",    "binary32",   "binary64",   "fp8_e4m3", "fp8_e5m2", "e2m13",
                                   "e11m30",   "ue5m6",    "unorm16", "unorm32",    "snorm16",    "fixed4.12", "ufixed20.30"};

struct digest {
  std::uint64_t value = 0;
  void add(std::uint64_t x) { value = mix64(value ^ mix64(x)); }
  void add(double x) { add(std::bit_cast<std::uint64_t>(x)); }
  void add(float x) { add(std::uint64_t{std::bit_cast<std::uint32_t>(x)}); }
  void print(const char* what) const { std::printf("%-12s %016llx\n", what, static_cast<unsigned long long>(value)); }
};

/// Bit patterns of doubles: a third anything, a third near 1, a third where half's ends lie.
double sample(std::uint64_t i) {
  const std::uint64_t r = random_bits(7, i);
  if (i % 3 == 0) return std::bit_cast<double>(r);
  const std::uint64_t low = i % 3 == 1 ? 1010 : 990, span = i % 3 == 1 ? 20 : 60;
  return std::bit_cast<double>((r & 0x800fffffffffffffu) | ((low + (r >> 52) % span) << 52));
}

// What follows is integers: no environment reaches it, with or without a guard.

void conversions() {
  digest encoded, decoded;
  for (const char* name : formats) {
    const encoding e = parse_encoding(name).value();
    for (std::uint64_t i = 0; i < 4200; ++i) {
      rules r;
      r.direction = static_cast<rounding>(i % 7);
      r.overflow = static_cast<overflow>(i / 7 % 3);
      r.subnormal = static_cast<subnormals>(i / 21 % 4);
      r.nan = static_cast<nan_payload>(i / 84 % 2);
      r.norm = static_cast<norm_decode>(i / 168 % 2);
      const std::uint64_t bits = encode(e, sample(i), r, random_bits(3, i));
      encoded.add(bits);
      decoded.add(decode(e, bits, r));
      decoded.add(decode(e, random_bits(4, i)));
    }
  }
  encoded.print("encode");
  decoded.print("decode");
}

void operations() {
  digest d;
  for (const char* name : formats) {
    const encoding e = parse_encoding(name).value();
    for (std::uint64_t i = 0; i < 1400; ++i) {
      rules r;
      r.direction = static_cast<rounding>(i % 7);
      r.subnormal = static_cast<subnormals>(i / 7 % 4);
      const std::uint64_t a = random_bits(1, i) & low_bits(e.width), b = random_bits(2, i) & low_bits(e.width);
      const std::uint64_t c = random_bits(3, i) & low_bits(e.width), x = random_bits(4, i);
      d.add(add(e, a, b, r, x)), d.add(subtract(e, a, b, r, x)), d.add(multiply(e, a, b, r, x));
      d.add(divide(e, a, b, r, x)), d.add(square_root(e, a, r, x)), d.add(fused_multiply_add(e, a, b, c, r, x));
    }
  }
  d.print("operations");
}

void text() {
  digest d;
  for (const char* number : {"0.1", "-1/3", "1e-45", "0x1.fffffffffffff8p-1", "65519.9999999999999999999", "1e1000000000",
                             "123456789012345678901234567890e-40", "-0", "inf", "nan", "2.4703282292062327e-324"})
    for (const char* name : formats)
      for (int i = 0; i < 7; ++i)
        d.add(encode(parse_encoding(name).value(), parse_number(number).value(), rules{static_cast<rounding>(i)}, 1));
  d.print("text");
}

void elementary_functions() {
  digest d;
  constexpr exact_result (*functions[])(double) = {
      elementary::exp, elementary::exp2, elementary::expm1, elementary::log, elementary::log2, elementary::log10,
      elementary::log1p, elementary::cbrt, elementary::sin, elementary::cos, elementary::tan, elementary::asin,
      elementary::acos, elementary::atan, elementary::sinh, elementary::cosh, elementary::tanh, elementary::asinh,
      elementary::acosh, elementary::atanh};
  for (const auto f : functions)
    for (std::uint64_t i = 0; i < 60; ++i) d.add(round_result(binary64::value, f(sample(i)), {}));
  for (std::uint64_t i = 0; i < 300; ++i)
    d.add(round_result(binary64::value, elementary::pow(sample(3 * i + 1), sample(3 * i + 2)), {}));
  d.print("elementary");
}

void certified() {
  digest d;
  for (std::uint64_t i = 0; i < 300; ++i) {
    const interval<double> a(sample(3 * i + 1)), b(sample(3 * i + 2));
    for (const auto& x : {a + b, a * b, a / b, sqrt(abs(a)), exp(b)}) d.add(x.lower()), d.add(x.upper());
    const samples<binary16, 4> s(sample(3 * i + 1), i), t(sample(3 * i + 2), i);
    for (std::size_t k = 0; k < 4; ++k) d.add((s + t).sample(k)), d.add((s * t).sample(k));
  }
  d.print("certified");
}

// What follows uses the carrier, under the guard of the environment.

template <class T>
void scalars(digest& d) {
  constexpr encoding e = T::encoding_value;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const auto of = [&](std::uint64_t key) { return T::from_bits(static_cast<typename T::bits_type>(random_bits(key, i) & low_bits(e.width))); };
    const T a = of(1), b = of(2), c = of(3);
    for (const T x : {a + b, a - b, a * b, a / b, sqrt(a), fma(a, b, c), -a, abs(a), T(sample(i)), floor(a)}) d.add(std::uint64_t{x.bits()});
    d.add(std::uint64_t{(a < b) + 2u * (a == b) + 4u * (a <= c)});
  }
}

constexpr rules toward(rounding direction) {
  rules r;
  r.direction = direction;
  return r;
}

void reals() {
  const default_environment guard;
  digest d;
  scalars<real<binary16>>(d), scalars<real<bfloat16>>(d), scalars<real<binary32>>(d), scalars<real<binary64>>(d);
  scalars<real<unorm16>>(d), scalars<real<binary16, toward(rounding::up)>>(d);
  d.print("real");
}

/// The same lanes in the same order, however many a pack has.
void packs() {
  const default_environment guard;
  using carrier = pack<float>;
  using many = real<binary16, rules{}, carrier>;
  digest d;
  for (std::uint64_t i = 0; i < 4096; i += carrier::lanes) {
    float a[carrier::lanes], b[carrier::lanes], c[carrier::lanes];
    for (int k = 0; k < carrier::lanes; ++k) {
      const auto at = i + static_cast<std::uint64_t>(k);
      const auto number = [&](std::uint64_t key) { return static_cast<float>(decode(binary16::value, random_bits(key, at))); };
      a[k] = number(1), b[k] = number(2), c[k] = number(3);
    }
    const many x = many::from_carrier(carrier::load(a)), y = many::from_carrier(carrier::load(b)), z = many::from_carrier(carrier::load(c));
    const many results[] = {x + y, x * y, x / y, sqrt(x), fma(x, y, z), select(x < y, y, z)};
    for (int k = 0; k < carrier::lanes; ++k)
      for (const many& r : results) {
        const float lane = r.carrier()[k];
        d.add(lane == lane ? lane : 0.0f);
      }
  }
  d.print("pack");
}

}  // namespace

int main(int argc, char* argv[]) {
  if (argc > 1) {
    std::fesetround(std::strcmp(argv[1], "up") == 0 ? FE_UPWARD : std::strcmp(argv[1], "down") == 0 ? FE_DOWNWARD : FE_TOWARDZERO);
#if defined(__SSE2__)
    _mm_setcsr(_mm_getcsr() | 0x8040);  // flush to zero, denormals are zero
#endif
  }
  conversions(), operations(), text(), elementary_functions(), certified(), reals(), packs();
  return 0;
}
