// The slow ways of certified.hpp: bilinear sums in 128-bit integers, and the nearest number of a
// rational. Each rounds the exact value once, to nearest even.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>
#include <type_traits>

#include "bitshade/formats/decode.hpp"
#include "bitshade/formats/encode.hpp"

namespace bitshade::certified_detail {

__extension__ typedef __int128 int128;

template <class R>
inline constexpr encoding target = std::is_same_v<R, float> ? binary_encoding(8, 23)
                                                            : binary_encoding(11, 52);
template <class R>
inline constexpr bool is_result = std::is_same_v<R, float> || std::is_same_v<R, double>;

/// Bilinear in 128-bit integers, rounded once by division with a sticky remainder; nothing where
/// weights or texels are too far apart for 126 bits.
template <class R>
std::optional<R> bilinear_integer(double a, double b, double c, double d, double fx, double fy,
                                  double divisor) {
  const double texel[4] = {a, b, c, d};
  int lowest = 1000, highest = -1000;
  for (const double t : texel) {
    if (t == 0) continue;
    const auto bits = std::bit_cast<std::uint64_t>(t);
    const int exponent = static_cast<int>((bits >> 52) & 0x7ff) - 1075;
    if (exponent < -1000) return std::nullopt;
    const int zeros =
        std::countr_zero((bits & ((std::uint64_t{1} << 52) - 1)) | (std::uint64_t{1} << 52));
    lowest = std::min(lowest, exponent + zeros);
    highest = std::max(highest, exponent + 53);
  }
  if (lowest > highest) return R{0};  // all four are zero
  // The weights' own last bits: both lie on the grid of 2^-32.
  const auto wx = static_cast<std::uint64_t>(fx * 0x1p32),
             wy = static_cast<std::uint64_t>(fy * 0x1p32);
  const int gx = wx == 0 ? 0 : 32 - std::countr_zero(wx),
            gy = wy == 0 ? 0 : 32 - std::countr_zero(wy);
  if (highest - lowest + gx + gy > 126) return std::nullopt;
  const auto scaled = [&](double t) {
    const auto bits = std::bit_cast<std::uint64_t>(t);
    if (t == 0) return static_cast<int128>(0);
    const int exponent = static_cast<int>((bits >> 52) & 0x7ff) - 1075;
    auto m =
        static_cast<int128>((bits & ((std::uint64_t{1} << 52) - 1)) | (std::uint64_t{1} << 52));
    const int shift = exponent - lowest;
    m = shift >= 0 ? m << shift : m >> -shift;
    return t < 0 ? -m : m;
  };
  const auto ox = static_cast<int128>(std::uint64_t{1} << gx),
             oy = static_cast<int128>(std::uint64_t{1} << gy);
  const auto ix = static_cast<int128>(gx == 0 ? 0 : wx >> (32 - gx));
  const auto iy = static_cast<int128>(gy == 0 ? 0 : wy >> (32 - gy));
  const int128 upper = (ox - ix) * scaled(a) + ix * scaled(b);
  const int128 lower = (ox - ix) * scaled(c) + ix * scaled(d);
  const int128 sum = (oy - iy) * upper + iy * lower;
  if (sum == 0) return R{0};
  const bool negative = sum < 0;
  uint128 magnitude = static_cast<uint128>(negative ? -sum : sum);
  std::int64_t exponent = lowest - gx - gy;
  bool sticky = false;
  if (divisor != 1) {
    const int room = 127 - bit_width(magnitude);
    magnitude <<= room;
    exponent -= room;
    const auto by = static_cast<uint128>(divisor);
    sticky = magnitude % by != 0;
    magnitude /= by;
  }
  const std::uint64_t code = encode_scaled(target<R>, negative, magnitude, exponent, sticky, {}, 0);
  return static_cast<R>(decode(target<R>, code));
}

/// The nearest R of an exact rational, ties to even; beyond the largest, as IEEE 754 has it,
/// infinity from half a step on.
///
/// Rationals know comparisons and a conversion that may err in its last bits: the guess is put
/// right by comparing with the midpoints to both neighbours.
template <class R, class T>
R nearest_of(const T& x) {
  using bits_type = std::conditional_t<std::is_same_v<R, float>, std::uint32_t, std::uint64_t>;
  const T zero = static_cast<T>(0);
  if (x == zero) return R{0};
  const bool negative = x < zero;
  const T size = negative ? zero - x : x;
  auto guess = std::bit_cast<bits_type>(static_cast<R>(static_cast<double>(size)));
  const auto value = [](bits_type bits) { return static_cast<double>(std::bit_cast<R>(bits)); };
  const auto middle = [&](bits_type lower) {
    return (static_cast<T>(value(lower)) + static_cast<T>(value(lower + 1))) / static_cast<T>(2);
  };
  constexpr bits_type largest =
      std::is_same_v<R, float> ? bits_type{0x7f7fffff} : static_cast<bits_type>(0x7fefffffffffffff);
  guess = std::min(guess, largest);
  while (guess < largest) {
    const T up = middle(guess);
    if (up < size || (up == size && (guess & 1) != 0))
      ++guess;
    else
      break;
  }
  while (guess > 0) {
    const T down = middle(static_cast<bits_type>(guess - 1));
    if (size < down || (size == down && (guess & 1) != 0))
      --guess;
    else
      break;
  }
  if (guess == largest) {
    const T most = static_cast<T>(value(largest));
    if (!(size - most < most - middle(largest - 1))) ++guess;
  }
  const R result = std::bit_cast<R>(guess);
  return negative ? -result : result;
}

}  // namespace bitshade::certified_detail
