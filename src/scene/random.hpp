// Random numbers that depend on a seed, a stream and a counter alone: no state, no order.
#pragma once

#include <cstdint>

namespace bitshade {

/// SplitMix64's output function: a bijection of 64 bits that passes the usual test batteries.
constexpr std::uint64_t mix_bits(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15u;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

/// The numbers of one stream (one leaf, one building), drawn one after another.
class random_stream {
 public:
  constexpr random_stream(std::uint64_t seed, std::uint64_t stream)
      : key_(mix_bits(mix_bits(seed) ^ stream)) {}

  /// Uniform on the multiples of 2^-53 in [0,1).
  constexpr double next() { return static_cast<double>(mix_bits(key_ + count_++) >> 11) * 0x1p-53; }
  constexpr double next(double low, double high) { return low + (high - low) * next(); }

 private:
  std::uint64_t key_;
  std::uint64_t count_ = 0;
};

}  // namespace bitshade
