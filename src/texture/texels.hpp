// Texels in memory as vectors of binary32, and back: one type a storage. Each instruction set
// instantiates them with its own lanes. `stream` passes the caches by and wants aligned places;
// `narrow` and `wide` take codes that are in a register already, of 16 bits and of 32.
#pragma once

#include <cstdint>

namespace bitshade::texture_kernels {

/// binary32 itself.
template <class V>
struct native_texels {
  using f = typename V::f;
  using code = float;
  static constexpr bool integers = false;  ///< codes that `wide` takes and that shuffles widen
  [[gnu::always_inline]] f load(const code* p) const { return V::load(p); }
  [[gnu::always_inline]] f narrow(f x) const { return x; }
  [[gnu::always_inline]] void store(code* p, f x) const { V::store(p, x); }
  [[gnu::always_inline]] void stream(code* p, f x) const { V::stream(p, x); }
  [[gnu::always_inline]] f round(f x) const { return x; }
};

/// binary16 by the processor's conversions, to nearest even.
template <class V>
struct half_texels {
  using f = typename V::f;
  using code = std::uint16_t;
  static constexpr bool integers = false;
  [[gnu::always_inline]] f load(const code* p) const { return V::from_half(V::load_half(p)); }
  [[gnu::always_inline]] f narrow(typename V::half_codes c) const { return V::from_half(c); }
  [[gnu::always_inline]] f wide(typename V::i c) const { return V::from_half(V::words(c)); }
  [[gnu::always_inline]] void store(code* p, f x) const {
    V::store_half(p, V::template to_half<0>(x));
  }
  [[gnu::always_inline]] void stream(code* p, f x) const {
    V::stream_words(p, V::template to_half<0>(x));
  }
  [[gnu::always_inline]] f round(f x) const { return V::from_half(V::template to_half<0>(x)); }
};

/// unorm16, rounded once each way; numbers known to be in [0,1] need no limits.
///
/// fma(x, 65535, 2^23) has the code in its low bits, rounded at the exact product's unit. c / 65535
/// is c * high + c * low with high + low = 1 / 65535 to 2^-49 of it, while the quotient of a code
/// keeps 2^-41 of itself away from the middle between two numbers: tests try every code.
template <class V, bool Limits = true>
struct unorm16_texels {
  using f = typename V::f;
  using code = std::uint16_t;
  static constexpr bool integers = true;
  static constexpr float high = 1 / 65535.0f, low = static_cast<float>(1 / 65535.0 - double{high});
  f scale = V::all(65535.0f), magic = V::all(0x1p23f);

  [[gnu::always_inline]] f load(const code* p) const { return wide(V::load_codes(p)); }
  [[gnu::always_inline]] f narrow(typename V::half_codes c) const { return wide(V::widen(c)); }
  [[gnu::always_inline]] f wide(typename V::i c) const { return value(V::to_float(c)); }
  [[gnu::always_inline]] void store(code* p, f x) const {
    V::store_codes(p, V::isub(V::bits(sum(x)), V::bits(magic)));
  }
  [[gnu::always_inline]] void stream(code* p, f x) const {
    V::stream_words(p, V::words(V::isub(V::bits(sum(x)), V::bits(magic))));
  }
  [[gnu::always_inline]] f round(f x) const { return value(V::sub(sum(x), magic)); }

 private:
  [[gnu::always_inline]] f sum(f x) const {
    if constexpr (Limits) x = V::min(V::max(x, V::all(0.0f)), V::all(1.0f));
    return V::fma(x, scale, magic);
  }
  [[gnu::always_inline]] f value(f c) const {
    return V::fma(c, V::all(high), V::mul(c, V::all(low)));
  }
};

/// Codes of 16 bits as the integers that they are.
template <class V>
struct code_texels {
  using f = typename V::f;
  using code = std::uint16_t;
  static constexpr bool integers = true;
  [[gnu::always_inline]] f load(const code* p) const { return wide(V::load_codes(p)); }
  [[gnu::always_inline]] f narrow(typename V::half_codes c) const { return wide(V::widen(c)); }
  [[gnu::always_inline]] f wide(typename V::i c) const { return V::to_float(c); }
};

}  // namespace bitshade::texture_kernels
