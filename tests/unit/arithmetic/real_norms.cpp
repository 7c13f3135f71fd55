// Norms have values that no binary64 holds: what must be exact goes by their codes, in every direction of rounding.
#include "bitshade/arithmetic/real_math.hpp"
#include "support/catch.hpp"

using namespace bitshade;

namespace {

/// Results that lie on the grid come out as themselves; how many do not.
template <rounding Direction>
int misplaced() {
  using wide = real<unorm16, rules{Direction}>;
  using narrow = real<unorm8, rules{Direction}>;
  using signed_wide = real<snorm16, rules{Direction}>;
  const auto of = [](int code) { return wide::from_bits(static_cast<std::uint16_t>(code)); };
  int wrong = 0;
  for (int c = 1; c < 32768; ++c) {
    const auto x = signed_wide::from_bits(static_cast<std::uint16_t>(c));
    wrong += (-x).bits() != (0x10000 - c) || (-(-x)).bits() != c || abs(-x).bits() != c;
    wrong += ldexp(of(c), 1).bits() != 2 * c || ldexp(of(2 * c), -1).bits() != c;
    wrong += fmod(of(c + 32767), of(c)).bits() != (c + 32767) % c || remainder(of(2 * c), of(c)).bits() != 0;
    if (c < 13107) wrong += hypot(of(3 * c), of(4 * c)).bits() != 5 * c;
  }
  for (int c = 0; c < 256; ++c) {
    const auto x = narrow::from_bits(static_cast<std::uint8_t>(c));
    wrong += wide(x).bits() != 257 * c || narrow(of(257 * c)).bits() != c;
  }
  return wrong;
}

}  // namespace

TEST_CASE("what lies on a norm's grid stays there, in every direction") {
  CHECK(misplaced<rounding::nearest_even>() == 0);
  CHECK(misplaced<rounding::up>() == 0);
  CHECK(misplaced<rounding::down>() == 0);
  CHECK(misplaced<rounding::toward_zero>() == 0);
  CHECK(misplaced<rounding::to_odd>() == 0);
}

TEST_CASE("a norm converts by its exact value") {
  // 2/3 of unorm2 is a tie of nothing: just above or below, never both.
  CHECK(real<binary32, rules{rounding::up}>(real<unorm<2>>::from_bits(2)).bits() == 0x3f2aaaab);
  CHECK(real<binary32, rules{rounding::down}>(real<unorm<2>>::from_bits(2)).bits() == 0x3f2aaaaa);
  CHECK(real<snorm16>(real<unorm16>::from_bits(0x8000)).bits() == 0x4000);  // 16383.75 steps
  CHECK(real<fixed<2, 8>>(real<unorm8>::from_bits(255)).bits() == 0x100);
  CHECK(convert(snorm16::value, unorm16::value, 0x8000, rules{rounding::down}) == 0x3fff);
  CHECK(convert(unorm8::value, snorm16::value, 0x8000) == 0);
  CHECK(convert(unorm8::value, binary16::value, 0x3800) == 0x80);
  CHECK(convert(binary16::value, fixed_encoding(4, 12), 0xf800) == 0xb800);
}

TEST_CASE("encode multiplies a long number for a norm without losing a bit") {
  // 2^97 - 1 over 2^97, just below 1: toward zero it is not 1.
  const uint128 n = (uint128{1} << 97) - 1;
  CHECK(encode_scaled(unorm_encoding(32), false, n, -97, false, rules{rounding::toward_zero}, 0) == 0xfffffffe);
  CHECK(encode_scaled(unorm_encoding(32), false, n, -97, false, rules{}, 0) == 0xffffffff);
  CHECK(encode_scaled(unorm_encoding(32), false, ~uint128{0}, -128, false, rules{rounding::toward_zero}, 0) == 0xfffffffe);
}
