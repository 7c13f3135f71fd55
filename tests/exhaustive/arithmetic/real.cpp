// real<F> is what operations.hpp says (which MPFR has checked), whatever path its carrier takes.
#include "bitshade/arithmetic/real.hpp"

#include "bitshade/formats/name.hpp"
#include "bitshade/formats/random.hpp"
#include "support/catch.hpp"
#include "support/operation_oracle.hpp"

using namespace bitshade;

namespace {

struct disagreements {
  std::uint64_t wrong = 0, seen = 0;
  std::string first;

  void expect(const char* what, const encoding& e, std::uint64_t got, std::uint64_t want, std::uint64_t a,
              std::uint64_t b = 0, std::uint64_t c = 0) {
    ++seen;
    // real has one NaN; e4m3's overflow to a negative one is where operations.hpp keeps a sign.
    if (e.kind == family::binary && (want & ~sign_bit(e)) == nan_bits(e)) want = nan_bits(e);
    if (got == want || wrong++ != 0) return;
    first = name_of(e) + ' ' + what + ' ' + oracle::hex(a) + ' ' + oracle::hex(b) + ' ' + oracle::hex(c) + ": got " +
            oracle::hex(got) + ", operations.hpp has " + oracle::hex(want);
  }
};

template <class T>
void compare(disagreements& d, std::uint64_t a, std::uint64_t b, std::uint64_t c) {
  constexpr encoding e = T::encoding_value;
  constexpr rules r = T::rules_value;
  const auto of = [](std::uint64_t bits) { return T::from_bits(static_cast<typename T::bits_type>(bits)); };
  const T x = of(a), y = of(b), z = of(c);
  d.expect("+", e, (x + y).bits(), add(e, a, b, r), a, b);
  d.expect("-", e, (x - y).bits(), subtract(e, a, b, r), a, b);
  d.expect("*", e, (x * y).bits(), multiply(e, a, b, r), a, b);
  d.expect("/", e, (x / y).bits(), divide(e, a, b, r), a, b);
  d.expect("sqrt", e, sqrt(x).bits(), square_root(e, a, r), a);
  d.expect("fma", e, fma(x, y, z).bits(), fused_multiply_add(e, a, b, c, r), a, b, c);
}

/// Boundary codes with each other, and `count` random triples, half of them close together.
template <class T>
void sweep(std::uint64_t count) {
  constexpr encoding e = T::encoding_value;
  disagreements d;
  const auto codes = oracle::boundary_codes(e);
  // snorm's second code for -1 is read as the first: canonical codes alone compare by bits.
  for (const std::uint64_t a : codes)
    for (const std::uint64_t b : codes) compare<T>(d, a, b, codes[(a + 7 * b) % codes.size()]);
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t a = random_bits(1, i) & low_bits(e.width);
    std::uint64_t b = random_bits(2, i) & low_bits(e.width), c = random_bits(3, i) & low_bits(e.width);
    if (e.kind == family::binary && i % 2 == 0) b = a ^ (b & (sign_bit(e) | low_bits(e.fraction_bits)));
    if (e.kind == family::binary && i % 4 == 1) c = (multiply(e, a, b) ^ sign_bit(e)) ^ (c & low_bits(e.fraction_bits / 2));
    compare<T>(d, a, b, c);
  }
  INFO(d.wrong << " of " << d.seen << " wrong; the first: " << d.first);
  CHECK(d.seen > count);
  CHECK(d.wrong == 0);
}

constexpr rules with(rounding direction, subnormals s = subnormals::preserve, overflow o = overflow::ieee) {
  rules r;
  r.direction = direction;
  r.subnormal = s;
  r.overflow = o;
  return r;
}

}  // namespace

TEST_CASE("real is correctly rounded in every format that a float carries") {
  sweep<real<binary16>>(200000);
  sweep<real<fp8_e5m2>>(20000);
  sweep<real<fp8_e4m3>>(20000);
  sweep<real<binary<7, 10>>>(50000);
  sweep<real<binary<2, 1>>>(2000);
  sweep<real<binary16, rules{}, double>>(50000);
}

TEST_CASE("real is correctly rounded where a float would round twice") {
  sweep<real<bfloat16>>(100000);
  sweep<real<bfloat16, rules{}, float>>(50000);
  sweep<real<tf32>>(50000);
  sweep<real<tf32, rules{}, float>>(50000);
  sweep<real<binary32>>(100000);
  sweep<real<binary32, rules{}, double>>(50000);
  sweep<real<binary64>>(100000);
  sweep<real<binary<8, 30>>>(50000);
  sweep<real<binary<11, 10>>>(50000);
  sweep<real<binary<10, 12>>>(50000);
}

TEST_CASE("real is correctly rounded in every direction and policy") {
  sweep<real<binary16, with(rounding::up)>>(50000);
  sweep<real<binary16, with(rounding::down)>>(50000);
  sweep<real<binary16, with(rounding::toward_zero, subnormals::flush_both)>>(50000);
  sweep<real<binary16, with(rounding::nearest_away)>>(50000);
  sweep<real<binary16, with(rounding::nearest_even, subnormals::flush_output)>>(50000);
  sweep<real<binary16, with(rounding::nearest_even, subnormals::flush_both)>>(50000);
  sweep<real<binary16, with(rounding::nearest_even, subnormals::flush_input)>>(50000);
  sweep<real<binary16, with(rounding::nearest_even, subnormals::preserve, overflow::saturate)>>(50000);
  sweep<real<binary32, with(rounding::to_odd)>>(50000);
  sweep<real<binary32, with(rounding::nearest_even, subnormals::flush_both, overflow::saturate)>>(50000);
  sweep<real<fp8_e4m3, with(rounding::nearest_even, subnormals::preserve, overflow::saturate)>>(20000);
}

TEST_CASE("real is correctly rounded in norms and fixed point") {
  sweep<real<unorm8>>(20000);
  sweep<real<unorm16>>(50000);
  sweep<real<unorm<32>>>(20000);
  sweep<real<fixed<4, 12>>>(50000);
  sweep<real<ufixed<8, 24>>>(20000);
  sweep<real<format<unsigned_binary_encoding(5, 6)>>>(20000);
}
