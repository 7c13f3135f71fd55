// The loops around the steps, and the choice among them. Each instruction set instantiates them with its own lanes,
// so that no two files compile the same function with different flags.
#pragma once

#include "bulk/norm_step.hpp"

namespace bitshade::bulk_kernels {

/// Runs step(in, out, random) over whole vectors, and over the tail in a buffer.
template <class V, class In, class Out, class Step>
[[gnu::always_inline]] inline void over(const plan& p, const void* source, void* target, std::size_t n, Step step) {
  constexpr std::size_t width = V::width;
  const In* in = static_cast<const In*>(source);
  Out* out = static_cast<Out*>(target);
  std::uint64_t random = p.random_start;
  std::size_t j = 0;
  for (; j + width <= n; j += width, random += gamma * width) step(in + j, out + j, random, j);
  if (j == n) return;
  In last_in[width] = {};
  Out last_out[width];
  for (std::size_t k = 0; j + k < n; ++k) last_in[k] = in[j + k];
  step(last_in, last_out, random, j);
  for (std::size_t k = 0; j + k < n; ++k) out[j + k] = last_out[k];
}

template <class V, reach Reach, rounding D, shape Shape, class Io>
void round_binary(const plan& p, const void* in, void* out, std::size_t n) {
  const binary_step<V, Reach, D, Shape> step(p, false);
  over<V, Io, Io>(p, in, out, n, [&](const Io* a, Io* b, std::uint64_t random, std::size_t j) {
    const auto x = V::bits(V::load(a));
    const auto r = step.round(x, random);
    if constexpr (D == rounding::stochastic) {
      if (r.undecided) return p.define(p, a, b, V::width, j);
    }
    V::store(b, V::value(step.to_value(r, x)));
  });
}

template <class V, reach Reach, rounding D, class In, class Code>
void encode_binary(const plan& p, const void* in, void* out, std::size_t n) {
  const binary_step<V, Reach, D, shape::full> step(p, true);
  over<V, In, Code>(p, in, out, n, [&](const In* a, Code* b, std::uint64_t random, std::size_t j) {
    const auto x = V::bits(V::load(a));
    const auto r = step.round(x, random);
    if constexpr (D == rounding::stochastic) {
      if (r.undecided) return p.define(p, a, b, V::width, j);
    }
    V::store_codes(b, step.to_code(r, x));
  });
}

template <class V, class Io>
void round_norm(const plan& p, const void* in, void* out, std::size_t n) {
  const norm_step<V, rounding::nearest_even> step(p);
  over<V, Io, Io>(p, in, out, n, [&](const Io* a, Io* b, std::uint64_t, std::size_t) {
    V::store(b, step.to_value(V::sub(step.sum(V::load(a)), step.magic)));
  });
}

template <class V, rounding D, class In, class Code>
void encode_norm(const plan& p, const void* in, void* out, std::size_t n) {
  const norm_step<V, D> step(p);
  over<V, In, Code>(p, in, out, n, [&](const In* a, Code* b, std::uint64_t random, std::size_t) {
    V::store_codes(b, step.to_code(V::load(a), random));
  });
}

template <class V, class Code, class Out>
void decode_norm(const plan& p, const void* in, void* out, std::size_t n) {
  using word = typename V::word;
  const norm_step<V, rounding::nearest_even> step(p);
  const auto sign = V::all_bits(static_cast<word>(p.sign));
  const auto lowest = V::all_bits(static_cast<word>(word{0} - static_cast<word>(p.scale)));
  const bool snorm = p.kind == family::snorm;
  over<V, Code, Out>(p, in, out, n, [&](const Code* a, Out* b, std::uint64_t, std::size_t) {
    auto c = V::and_(V::load_codes(a), step.code_mask);
    c = V::isub(V::xor_(c, sign), sign);  // sign-extends
    if (snorm) c = V::imax(c, lowest);
    V::store(b, step.to_value(V::to_float(c)));
  });
}

/// Codes of narrow and equal reach to numbers: exact, by shifting the fields into place.
template <class V, reach Reach, class Code, class Out>
void decode_binary(const plan& p, const void* in, void* out, std::size_t n) {
  using word = typename V::word;
  constexpr int fraction = V::fraction_bits;
  constexpr int lane_bits = static_cast<int>(sizeof(word)) * 8;
  constexpr int lane_bias = (1 << (V::exponent_bits - 1)) - 1;
  constexpr word infinity_word = ((word{1} << V::exponent_bits) - 1) << fraction;
  const auto all = [](std::uint64_t w) { return V::all_bits(static_cast<word>(w)); };
  const word rebias = static_cast<word>(lane_bias - p.bias) << fraction;
  const auto magnitude = all((p.has_sign ? p.sign : std::uint64_t{1} << p.width) - 1);
  const auto sign = all(p.sign), sign_shift = all(static_cast<word>(lane_bits - p.width));
  const auto shift = all(static_cast<word>(fraction - p.fraction_bits));
  const auto normal = all(rebias), subnormal = all(rebias + (word{1} << fraction));
  const auto least = V::value(subnormal);
  const auto least_code = all(p.min_normal_code), largest = all(p.max_code);
  const auto infinity = all(infinity_word);
  // Of a NaN's payload e4m3 keeps nothing; binary64 keeps even a signalling one, as decode does.
  const auto payload = all(p.special == specials::single_nan ? 0 : (word{1} << fraction) - 1);
  const auto quieted = all(sizeof(Out) == 8 && p.special != specials::single_nan ? 0 : word{1} << (fraction - 1));
  const auto infinite_code = all(p.special == specials::single_nan ? p.max_code : p.max_code + 1);
  const bool flush = p.flush_loads;
  over<V, Code, Out>(p, in, out, n, [&](const Code* a, Out* b, std::uint64_t, std::size_t) {
    const auto c = V::load_codes(a);
    const auto m = V::and_(c, magnitude);
    const auto placed = V::shl(m, shift);
    auto v = V::iadd(placed, normal);
    const auto small = V::igt(least_code, m);
    if constexpr (Reach == reach::narrow) {
      v = V::select(small, V::bits(V::sub(V::value(V::iadd(placed, subnormal)), least)), v);
    }
    if (flush) v = V::keep(V::inot(small), v);
    v = V::select(V::igt(m, largest), V::or_(infinity, V::and_(placed, payload)), v);
    v = V::select(V::igt(m, infinite_code), V::or_(v, quieted), v);
    V::store(b, V::value(V::or_(v, V::and_(V::shl(c, sign_shift), V::shl(sign, sign_shift)))));
  });
}

/// binary16 by the processor's own instructions, in its direction.
template <class V, int Direction>
void round_half(const plan& p, const void* in, void* out, std::size_t n) {
  over<V, float, float>(p, in, out, n, [&](const float* a, float* b, std::uint64_t, std::size_t) {
    V::store(b, V::from_half(V::template to_half<Direction>(V::load(a))));
  });
}
template <class V, int Direction>
void encode_half(const plan& p, const void* in, void* out, std::size_t n) {
  over<V, float, std::uint16_t>(p, in, out, n, [&](const float* a, std::uint16_t* b, std::uint64_t, std::size_t) {
    V::store_half(b, V::template to_half<Direction>(V::load(a)));
  });
}
template <class V>
void decode_half(const plan& p, const void* in, void* out, std::size_t n) {
  over<V, std::uint16_t, float>(p, in, out, n, [&](const std::uint16_t* a, float* b, std::uint64_t, std::size_t) {
    V::store(b, V::from_half(V::load_half(a)));
  });
}

}  // namespace bitshade::bulk_kernels
