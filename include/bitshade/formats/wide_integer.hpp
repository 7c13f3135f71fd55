// 128-bit integers under a standard-looking name, and the two bit functions that <bit> lacks there.
#pragma once

#include <bit>
#include <cstdint>

namespace bitshade {

__extension__ typedef unsigned __int128 uint128;

constexpr int bit_width(uint128 x) {
  const auto high = static_cast<std::uint64_t>(x >> 64);
  return high != 0 ? 64 + static_cast<int>(std::bit_width(high))
                   : static_cast<int>(std::bit_width(static_cast<std::uint64_t>(x)));
}

/// 2^n - 1 for 0 <= n <= 64.
constexpr std::uint64_t low_bits(int n) {
  return n >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << n) - 1;
}

}  // namespace bitshade
