// Random bits without state: the same key and counter give the same bits on any thread, in any order.
#pragma once

#include <cstdint>

namespace bitshade {

/// SplitMix64's output function, a bijection of 64 bits. Source [SteeleLeaFlood14] with variant 13.
constexpr std::uint64_t mix64(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

/// 64 random bits for the counter-th rounding under a key (a seed); `lane` tells the components of one thing apart.
///
///   mix(mix(key + gamma (lane + 1)) + gamma counter),  gamma = 2^64 / golden ratio, odd
///
/// The inner part depends on the key and lane alone: two multiplications a number, which vectorise.
constexpr std::uint64_t random_bits(std::uint64_t key, std::uint64_t counter, std::uint64_t lane = 0) {
  constexpr std::uint64_t gamma = 0x9e3779b97f4a7c15u;
  return mix64(mix64(key + gamma * (lane + 1)) + gamma * counter);
}

/// The generator of stochastic rounding: random bits of the counter-th number under a seed, in few enough instructions
/// that rounding many numbers at once is not held up by them. Thirty-two bits at a time, so that vectors multiply in one
/// instruction; two numbers, 16 apart, share the first half of the work. docs/round.md has the formulas in one place.
struct rounding_stream {
  static constexpr std::uint32_t weyl = 0x9e3779b9u;
  static constexpr std::uint32_t mixers[] = {0x21f0aaadu, 0x735a2d97u, 0xac4c1b51u};
  /// Numbers 2^16 and more apart are in different streams with keys of their own: in one stream, the leading bits of
  /// numbers 2^27 apart would differ in up to 55 % of all cases instead of 50 %.
  static constexpr int stream_bits = 16;
  /// Where one bit of a number changes, each of the leading 23 bits of its words, which kernels draw, flips half of the
  /// time: no bias was measured. The other nine may flip with a probability this far from one half.
  static constexpr double low_bits_bias = 0.025;

  std::uint32_t start, middle;

  constexpr explicit rounding_stream(std::uint64_t key)
      : start(static_cast<std::uint32_t>(key >> 32)), middle(static_cast<std::uint32_t>(key)) {}

  /// The words of a seed's numbers: `low` false for their upper 32 bits.
  static constexpr rounding_stream of(std::uint64_t seed, std::uint64_t counter, std::uint64_t lane, bool low) {
    constexpr std::uint64_t gamma = 0x9e3779b97f4a7c15u;
    const std::uint64_t key = mix64(mix64(seed + gamma * (lane + 1)) + gamma * (counter >> stream_bits));
    return rounding_stream(low ? mix64(key + gamma) : key);
  }

  /// Which of the stream's steps a number uses, and whether it takes the second of its two words.
  static constexpr std::uint32_t step_of(std::uint64_t counter) {
    return static_cast<std::uint32_t>((counter >> 5 << 4) | (counter & 15));
  }
  static constexpr bool is_second(std::uint64_t counter) { return (counter >> 4 & 1) != 0; }

  constexpr std::uint32_t word(std::uint64_t counter) const {
    std::uint32_t z = start + weyl * step_of(counter);
    z = (z ^ (z >> 16)) * mixers[0];
    z ^= z >> 15 ^ middle;
    if (!is_second(counter)) return z * mixers[1];
    z = z << 24 | (z << 8 & 0xff0000u) | (z >> 8 & 0xff00u) | z >> 24;
    return z * mixers[2];
  }
};

/// 64 random bits for stochastic rounding; a rounding to n bits looks at the n leading ones.
constexpr std::uint64_t rounding_bits(std::uint64_t seed, std::uint64_t counter, std::uint64_t lane = 0) {
  return static_cast<std::uint64_t>(rounding_stream::of(seed, counter, lane, false).word(counter)) << 32 |
         rounding_stream::of(seed, counter, lane, true).word(counter);
}

}  // namespace bitshade
