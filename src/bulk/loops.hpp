// The loops around the steps, and the choice among them. Each instruction set instantiates them with its own lanes,
// so that no two files compile the same function with different flags.
#pragma once

#include "bulk/binary_step.hpp"
#include "bulk/narrow_value.hpp"
#include "bulk/norm_value.hpp"
#include "bulk/random_block.hpp"
#include "bulk/shared_exponent_value.hpp"

namespace bitshade::bulk_kernels {

/// Runs step(in, out) over whole vectors, and over the tail in a buffer.
template <class V, class In, class Out, class Step>
[[gnu::always_inline]] inline void over(const void* source, void* target, std::size_t n, Step step) {
  constexpr std::size_t width = V::width;
  const In* in = static_cast<const In*>(source);
  Out* out = static_cast<Out*>(target);
  std::size_t j = 0;
  for (; j + 4 * width <= n; j += 4 * width) {
#pragma GCC unroll 4
    for (std::size_t k = 0; k < 4; ++k) step(in + j + k * width, out + j + k * width);
  }
  for (; j + width <= n; j += width) step(in + j, out + j);
  if (j == n) return;
  In last_in[width] = {};
  Out last_out[width];
  for (std::size_t k = 0; j + k < n; ++k) last_in[k] = in[j + k];
  step(last_in, last_out);
  for (std::size_t k = 0; j + k < n; ++k) out[j + k] = last_out[k];
}

/// Runs step(in, random bits, undecided, results) over groups of vectors and put(out, result) over each, in blocks of 32
/// numbers whose counters 32 divides; the first and the last may be shorter and go through a buffer. Where a step cannot
/// decide, decide(in, out, first) does its vector and the few beside it.
template <class V, class In, class Out, class Result, class Step, class Put, class Decide>
[[gnu::always_inline]] inline void over_random(const plan& p, const void* source, void* target, std::size_t n,
                                               Step step, Put put, Decide decide) {
  using m = typename V::m;
  constexpr std::size_t block = random_block<V>::numbers, width = V::width, vectors = block / width;
  constexpr std::size_t group = vectors < 4 ? vectors : 4;  // asked together whether all are decided
  const In* in = static_cast<const In*>(source);
  Out* out = static_cast<Out*>(target);
  random_block<V> random(p);
  random.draw();
  // `first` is the number of the block's first element, below 0 (modulo 2^64) where the block began before the span. In
  // the loop, not called: a call would load every constant again for each block.
  const auto whole = [&](const In* a, Out* b, std::size_t first) __attribute__((always_inline)) {
#pragma GCC unroll 2
    for (std::size_t g = 0; g < vectors; g += group) {
      Result r[group];
      m unclear[group]{}, undecided{};
      step(a + g * width, [&](std::size_t k) __attribute__((always_inline)) { return random.bits(g + k); }, unclear, r);
#pragma GCC unroll 4
      for (std::size_t k = 0; k < group; ++k) undecided = static_cast<m>(undecided | unclear[k]);
      if (V::any(undecided)) [[unlikely]] {
        for (std::size_t k = g; k < g + group; ++k) decide(a + k * width, b + k * width, first + k * width);
        continue;
      }
#pragma GCC unroll 4
      for (std::size_t k = 0; k < group; ++k) put(b + (g + k) * width, r[k]);
    }
    random.draw();
  };
  In some_in[block] = {};
  Out some_out[block];
  std::size_t skip = p.counter % block;
  for (std::size_t j = 0; j < n; skip = 0) {
    const bool part = skip > 0 || n - j < block;
    const std::size_t blocks = part ? 1 : (n - j) / block;
    const std::size_t count = !part ? blocks * block : n - j < block - skip ? n - j : block - skip;
    const In* a = part ? some_in : in + j;
    Out* b = part ? some_out : out + j;
    if (part) {
      for (std::size_t k = 0; k < count; ++k) some_in[skip + k] = in[j + k];
    }
    for (std::size_t k = 0; k < blocks * block; k += block) whole(a + k, b + k, j - skip + k);
    if (part) {
      for (std::size_t k = 0; k < count; ++k) out[j + k] = some_out[skip + k];
    }
    j += count;
  }
}

/// Runs step and put in any direction; a step that does not draw ignores its second and third argument.
template <class V, rounding D, class In, class Out, class Step, class Put>
[[gnu::always_inline]] inline void in_direction(const plan& p, const void* in, void* out, std::size_t n, Step step,
                                                Put put) {
  if constexpr (D == rounding::stochastic) {
    using result = decltype(step(static_cast<const In*>(in), V::all_bits(0), *static_cast<typename V::m*>(nullptr)));
    const auto each = [&]<std::size_t Group>(const In* a, auto random, typename V::m(&undecided)[Group],
                                             result(&r)[Group]) __attribute__((always_inline)) {
#pragma GCC unroll 4
      for (std::size_t k = 0; k < Group; ++k) r[k] = step(a + k * V::width, random(k), undecided[k]);
    };
    over_random<V, In, Out, result>(p, in, out, n, each, put, [&](const In* a, Out* b, std::size_t first) {
      p.define(p, a, b, V::width, first);
    });
  } else {
    over<V, In, Out>(in, out, n, [&](const In* a, Out* b) {
      typename V::m undecided{};
      put(b, step(a, V::all_bits(0), undecided));
    });
  }
}

/// A step that rounds bits to bits, over spans of numbers.
template <class V, rounding D, class Io, class Step>
void round_values(const plan& p, const void* in, void* out, std::size_t n) {
  using i = typename V::i;
  const Step step(p);
  const auto one = [&](const Io* a, i random, typename V::m& undecided) {
    if constexpr (D == rounding::stochastic) return step(V::bits(V::load(a)), random, undecided);
    else return step(V::bits(V::load(a)));
  };
  in_direction<V, D, Io, Io>(p, in, out, n, one, [](Io* b, i v) { V::store(b, V::value(v)); });
}

template <class V, reach Reach, rounding D, class Io>
void round_binary(const plan& p, const void* in, void* out, std::size_t n) {
  using i = typename V::i;
  const binary_step<V, Reach, D> step(p, false);
  const auto one = [&](const Io* a, i random, typename V::m& undecided) {
    const i x = V::bits(V::load(a));
    const auto r = step.round(x, random);
    undecided = r.undecided;
    return step.to_value(r, x);
  };
  in_direction<V, D, Io, Io>(p, in, out, n, one, [](Io* b, i v) { V::store(b, V::value(v)); });
}

template <class V, reach Reach, rounding D, class In, class Code>
void encode_binary(const plan& p, const void* in, void* out, std::size_t n) {
  using i = typename V::i;
  const binary_step<V, Reach, D> step(p, true);
  const auto one = [&](const In* a, i random, typename V::m& undecided) {
    const i x = V::bits(V::load(a));
    const auto r = step.round(x, random);
    undecided = r.undecided;
    return step.to_code(r, x);
  };
  in_direction<V, D, In, Code>(p, in, out, n, one, [](Code* b, i c) { V::store_codes(b, c); });
}

/// binary32 lanes, any direction but the stochastic one.
template <class V, rounding D, bool Signed>
void round_norm_in(const plan& p, const void* in, void* out, std::size_t n) {
  const norm_value<V, D, Signed> step(p);
  over<V, float, float>(in, out, n, [&](const float* a, float* b) { V::store(b, step(V::load(a))); });
}

/// One vector that was undecided, once more without its NaNs before it goes to the definition. It shares nothing with the
/// loop that seldom calls it: that keeps its registers.
template <class V, bool Signed>
[[gnu::noinline, gnu::cold]] void round_norm_numbers(const plan& p, const float* a, float* b, std::size_t first) {
  using f = typename V::f;
  using block = random_block<V>;
  const std::size_t at = first + p.counter % block::numbers;  // from the beginning of the first block on
  block random(p, at / block::numbers);
  random.draw();
  const drawn_norm_value<V, Signed> step(p);
  const f x = V::load(a), number[1] = {V::value(V::keep(V::eq(x, x), V::bits(x)))};
  f r[1];
  typename V::m undecided[1];
  step(number, [&](std::size_t) { return random.bits(at % block::numbers / V::width); }, undecided, r);
  if (V::any(undecided[0])) p.define(p, a, b, V::width, first);
  else V::store(b, r[0]);
}

/// Stochastically, with more than 23 random bits.
template <class V, bool Signed>
void round_norm_drawn(const plan& p, const void* in, void* out, std::size_t n) {
  using f = typename V::f;
  using m = typename V::m;
  const drawn_norm_value<V, Signed> step(p);
  const auto put = [](float* b, f v) { V::store(b, v); };
  const auto decide = [&](const float* a, float* b, std::size_t first) { round_norm_numbers<V, Signed>(p, a, b, first); };
  const auto group = [&]<std::size_t Group>(const float* a, auto random, m(&undecided)[Group], f(&r)[Group])
      __attribute__((always_inline)) {
    f x[Group];
#pragma GCC unroll 4
    for (std::size_t k = 0; k < Group; ++k) x[k] = V::load(a + k * V::width);
    step(x, random, undecided, r);
  };
  over_random<V, float, float, f>(p, in, out, n, group, put, decide);
}

/// Stochastically, with at most 23 random bits, to codes that are still numbers; norm_quotients, to nearest, makes values of
/// them.
template <class V, bool Signed>
void draw_norm(const plan& p, const void* in, void* out, std::size_t n) {
  using f = typename V::f;
  const drawn_norm<V, Signed> step(p);
  const auto one = [&](const float* a, typename V::i random, typename V::m&) { return step(V::load(a), random); };
  in_direction<V, rounding::stochastic, float, float>(p, in, out, n, one, [](float* b, f c) { V::store(b, c); });
}
template <class V>
void norm_quotients(const plan& p, const void* in, void* out, std::size_t n) {
  const norm_step<V, rounding::nearest_even> step(p);
  over<V, float, float>(in, out, n, [&](const float* a, float* b) { V::store(b, step.to_value(V::load(a))); });
}

template <class V, class Io>
void round_norm(const plan& p, const void* in, void* out, std::size_t n) {
  const norm_step<V, rounding::nearest_even> step(p);
  over<V, Io, Io>(in, out, n, [&](const Io* a, Io* b) {
    V::store(b, step.to_value(V::sub(step.sum(V::load(a)), step.magic)));
  });
}

template <class V, rounding D, class In, class Code>
void encode_norm(const plan& p, const void* in, void* out, std::size_t n) {
  using i = typename V::i;
  const norm_step<V, D> step(p);
  const auto one = [&](const In* a, i random, typename V::m&) { return step.to_code(V::load(a), random); };
  in_direction<V, D, In, Code>(p, in, out, n, one, [](Code* b, i c) { V::store_codes(b, c); });
}

template <class V, class Code, class Out>
void decode_norm(const plan& p, const void* in, void* out, std::size_t n) {
  using word = typename V::word;
  const norm_step<V, rounding::nearest_even> step(p);
  const auto sign = V::all_bits(static_cast<word>(p.sign));
  const auto lowest = V::all_bits(static_cast<word>(word{0} - static_cast<word>(p.scale)));
  const bool snorm = p.kind == family::snorm;
  over<V, Code, Out>(in, out, n, [&](const Code* a, Out* b) {
    auto c = V::and_(V::load_codes(a), step.code_mask);
    c = V::isub(V::xor_(c, sign), sign);  // sign-extends
    if (snorm) c = V::imax(c, lowest);
    V::store(b, step.to_value(V::to_float(c)));
  });
}

/// Codes of narrow and equal reach to numbers: exact, by shifting the fields into place.
template <class V, reach Reach, class Code, class Out>
void decode_binary(const plan& p, const void* in, void* out, std::size_t n) {
  using shape = lane_shape<V>;
  using word = typename shape::word;
  constexpr int fraction = shape::fraction;
  const auto all = [](std::uint64_t w) { return shape::all(w); };
  const word rebias = static_cast<word>(shape::lane_bias - p.bias) << fraction;
  const auto magnitude = all((p.has_sign ? p.sign : std::uint64_t{1} << p.width) - 1);
  const auto sign = all(p.sign), sign_shift = all(static_cast<word>(shape::lane_bits - p.width));
  const auto shift = all(static_cast<word>(fraction - p.fraction_bits));
  const auto normal = all(rebias), subnormal = all(rebias + shape::unit_word);
  const auto least = V::value(subnormal);
  const auto least_code = all(p.min_normal_code), largest = all(p.max_code);
  const auto infinity = all(shape::infinity_word);
  // Of a NaN's payload e4m3 keeps nothing; binary64 keeps even a signalling one, as decode does.
  const auto payload = all(p.special == specials::single_nan ? 0 : shape::unit_word - 1);
  const auto quieted = all(sizeof(Out) == 8 && p.special != specials::single_nan ? 0 : shape::unit_word >> 1);
  const auto infinite_code = all(p.special == specials::single_nan ? p.max_code : p.max_code + 1);
  const bool flush = p.flush_loads;
  over<V, Code, Out>(in, out, n, [&](const Code* a, Out* b) {
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
void round_half(const plan&, const void* in, void* out, std::size_t n) {
  over<V, float, float>(in, out, n, [&](const float* a, float* b) {
    V::store(b, V::from_half(V::template to_half<Direction>(V::load(a))));
  });
}
template <class V, int Direction>
void encode_half(const plan&, const void* in, void* out, std::size_t n) {
  over<V, float, std::uint16_t>(in, out, n, [&](const float* a, std::uint16_t* b) {
    V::store_half(b, V::template to_half<Direction>(V::load(a)));
  });
}
template <class V>
void decode_half(const plan&, const void* in, void* out, std::size_t n) {
  over<V, std::uint16_t, float>(in, out, n, [&](const std::uint16_t* a, float* b) {
    V::store(b, V::from_half(V::load_half(a)));
  });
}

}  // namespace bitshade::bulk_kernels
