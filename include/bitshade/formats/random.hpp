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

}  // namespace bitshade
