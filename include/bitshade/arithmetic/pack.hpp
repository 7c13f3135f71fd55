// Several numbers side by side in a vector register: a carrier, so that one source serves scalars and SIMD.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

#include "bitshade/arithmetic/real.hpp"
#include "bitshade/arithmetic/select.hpp"

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace bitshade {

// Files compiled for different instruction sets get different types: what they instantiate never meets at the linker.
#if defined(__AVX512F__)
inline namespace avx512_packs {
inline constexpr int pack_bytes = 64;
#elif defined(__AVX2__) && defined(__F16C__)
inline namespace avx2_f16c_packs {
inline constexpr int pack_bytes = 32;
#elif defined(__AVX__)
inline namespace avx_packs {
inline constexpr int pack_bytes = 32;
#else
inline namespace portable_packs {
inline constexpr int pack_bytes = 16;
#endif

/// N numbers of type T, worked on together; every operation is T's, lane by lane.
///
/// Shapes   N lanes, a power of two; by default as many as a register of this file's instruction set holds. More
///          lanes take several registers: emulated formats wait long for each result, and independent registers
///          fill the wait.
/// Failure  none. Comparisons give a mask of lanes, so that branches become select(mask, a, b).
template <class T, int N = pack_bytes / static_cast<int>(sizeof(T))>
class pack {
  static_assert(N >= 2 && (N & (N - 1)) == 0, "bitshade: a pack has 2, 4, 8 ... lanes");

 public:
  using scalar = T;
  typedef T vector __attribute__((vector_size(N * sizeof(T))));
  static constexpr int lanes = N;

  /// One truth value a lane.
  class mask {
   public:
    typedef decltype(vector{} < vector{}) bits;

    mask() = default;
    explicit mask(const bits& b) : bits_(b) {}
    explicit mask(bool b) : bits_(bits{} - (b ? 1 : 0)) {}
    bool operator[](int lane) const { return bits_[lane] != 0; }
    const bits& lanes_of() const { return bits_; }
    friend mask operator&(const mask& a, const mask& b) { return mask(a.bits_ & b.bits_); }
    friend mask operator|(const mask& a, const mask& b) { return mask(a.bits_ | b.bits_); }
    friend mask operator!(const mask& a) { return mask(~a.bits_); }
    friend bool any(const mask& a) {
      bool found = false;
      for (int k = 0; k < N; ++k) found |= a[k];
      return found;
    }
    friend bool all(const mask& a) { return !any(!a); }

   private:
    bits bits_;
  };

  pack() = default;
  pack(T x) : vector_(x - vector{}) {}  // x - 0 is x, the sign of zero included
  template <class U>
    requires(std::is_arithmetic_v<U> && !std::is_same_v<U, T>)
  explicit pack(U x) : pack(static_cast<T>(x)) {}
  explicit pack(const vector& v) : vector_(v) {}

  static pack load(const T* p) {
    pack r;
    std::memcpy(&r.vector_, p, sizeof r.vector_);
    return r;
  }
  void store(T* p) const { std::memcpy(p, &vector_, sizeof vector_); }
  T operator[](int lane) const { return vector_[lane]; }
  const vector& lanes_of() const { return vector_; }

  friend pack operator+(const pack& a, const pack& b) { return pack(a.vector_ + b.vector_); }
  friend pack operator-(const pack& a, const pack& b) { return pack(a.vector_ - b.vector_); }
  friend pack operator*(const pack& a, const pack& b) { return pack(a.vector_ * b.vector_); }
  friend pack operator/(const pack& a, const pack& b) { return pack(a.vector_ / b.vector_); }
  friend pack operator+(const pack& a) { return a; }
  friend pack operator-(const pack& a) { return pack(-a.vector_); }
  pack& operator+=(const pack& b) { return *this = *this + b; }
  pack& operator-=(const pack& b) { return *this = *this - b; }
  pack& operator*=(const pack& b) { return *this = *this * b; }
  pack& operator/=(const pack& b) { return *this = *this / b; }
  friend mask operator==(const pack& a, const pack& b) { return mask(a.vector_ == b.vector_); }
  friend mask operator!=(const pack& a, const pack& b) { return mask(a.vector_ != b.vector_); }
  friend mask operator<(const pack& a, const pack& b) { return mask(a.vector_ < b.vector_); }
  friend mask operator<=(const pack& a, const pack& b) { return mask(a.vector_ <= b.vector_); }
  friend mask operator>(const pack& a, const pack& b) { return mask(a.vector_ > b.vector_); }
  friend mask operator>=(const pack& a, const pack& b) { return mask(a.vector_ >= b.vector_); }

  /// m ? a : b, lane by lane.
  friend pack select(const mask& m, const pack& a, const pack& b) {
    return pack(m.lanes_of() ? a.vector_ : b.vector_);
  }
  friend pack abs(const pack& a) { return a.magnitude(); }
  friend pack sqrt(const pack& a) { return a.square_root(); }

  pack magnitude() const {
    typedef typename mask::bits bits;
    using word = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;
    return pack(std::bit_cast<vector>(std::bit_cast<bits>(vector_) & (bits{} + std::numeric_limits<word>::max())));
  }
  pack square_root() const {
#if defined(__SSE2__)
    if constexpr (sizeof(vector) == 16) return pack(root(vector_));
#endif
#if defined(__AVX__)
    if constexpr (sizeof(vector) == 32) return pack(root(vector_));
#endif
#if defined(__AVX512F__)
    if constexpr (sizeof(vector) == 64) return pack(root(vector_));
#endif
    vector r;
    for (int k = 0; k < N; ++k) r[k] = std::sqrt(vector_[k]);
    return pack(r);
  }

 private:
#if defined(__SSE2__)
  static __m128 root(__m128 x) { return _mm_sqrt_ps(x); }
  static __m128d root(__m128d x) { return _mm_sqrt_pd(x); }
#endif
#if defined(__AVX__)
  static __m256 root(__m256 x) { return _mm256_sqrt_ps(x); }
  static __m256d root(__m256d x) { return _mm256_sqrt_pd(x); }
#endif
#if defined(__AVX512F__)
  static __m512 root(__m512 x) { return _mm512_maskz_sqrt_ps(0xffff, x); }
  static __m512d root(__m512d x) { return _mm512_maskz_sqrt_pd(0xff, x); }
#endif

  vector vector_;
};

template <class T, int N>
inline constexpr bool takes_registers = N * static_cast<int>(sizeof(T)) > pack_bytes;

/// More lanes than a register has: two halves, and so on.
template <class T, int N>
  requires takes_registers<T, N>
class pack<T, N> {
  static_assert((N & (N - 1)) == 0, "bitshade: a pack has 2, 4, 8 ... lanes");

 public:
  using scalar = T;
  using half = pack<T, N / 2>;
  static constexpr int lanes = N;

  class mask {
   public:
    using half_mask = typename half::mask;
    mask() = default;
    explicit mask(bool b) : low_(b), high_(b) {}
    [[gnu::always_inline]] mask(const half_mask& low, const half_mask& high) : low_(low), high_(high) {}
    bool operator[](int lane) const { return lane < N / 2 ? low_[lane] : high_[lane - N / 2]; }
    const half_mask& low() const { return low_; }
    const half_mask& high() const { return high_; }
    [[gnu::always_inline]] friend mask operator&(const mask& a, const mask& b) { return {a.low_ & b.low_, a.high_ & b.high_}; }
    [[gnu::always_inline]] friend mask operator|(const mask& a, const mask& b) { return {a.low_ | b.low_, a.high_ | b.high_}; }
    [[gnu::always_inline]] friend mask operator!(const mask& a) { return {!a.low_, !a.high_}; }
    [[gnu::always_inline]] friend bool any(const mask& a) { return any(a.low_ | a.high_); }
    [[gnu::always_inline]] friend bool all(const mask& a) { return all(a.low_ & a.high_); }

   private:
    half_mask low_, high_;
  };

  pack() = default;
  [[gnu::always_inline]] pack(T x) : low_(x), high_(x) {}
  template <class U>
    requires(std::is_arithmetic_v<U> && !std::is_same_v<U, T>)
  explicit pack(U x) : pack(static_cast<T>(x)) {}
  [[gnu::always_inline]] pack(const half& low, const half& high) : low_(low), high_(high) {}

  [[gnu::always_inline]] static pack load(const T* p) { return {half::load(p), half::load(p + N / 2)}; }
  [[gnu::always_inline]] void store(T* p) const {
    low_.store(p);
    high_.store(p + N / 2);
  }
  T operator[](int lane) const { return lane < N / 2 ? low_[lane] : high_[lane - N / 2]; }
  const half& low() const { return low_; }
  const half& high() const { return high_; }

  [[gnu::always_inline]] friend pack operator+(const pack& a, const pack& b) { return {a.low_ + b.low_, a.high_ + b.high_}; }
  [[gnu::always_inline]] friend pack operator-(const pack& a, const pack& b) { return {a.low_ - b.low_, a.high_ - b.high_}; }
  [[gnu::always_inline]] friend pack operator*(const pack& a, const pack& b) { return {a.low_ * b.low_, a.high_ * b.high_}; }
  [[gnu::always_inline]] friend pack operator/(const pack& a, const pack& b) { return {a.low_ / b.low_, a.high_ / b.high_}; }
  [[gnu::always_inline]] friend pack operator+(const pack& a) { return a; }
  [[gnu::always_inline]] friend pack operator-(const pack& a) { return {-a.low_, -a.high_}; }
  pack& operator+=(const pack& b) { return *this = *this + b; }
  pack& operator-=(const pack& b) { return *this = *this - b; }
  pack& operator*=(const pack& b) { return *this = *this * b; }
  pack& operator/=(const pack& b) { return *this = *this / b; }
  [[gnu::always_inline]] friend mask operator==(const pack& a, const pack& b) { return {a.low_ == b.low_, a.high_ == b.high_}; }
  [[gnu::always_inline]] friend mask operator!=(const pack& a, const pack& b) { return {a.low_ != b.low_, a.high_ != b.high_}; }
  [[gnu::always_inline]] friend mask operator<(const pack& a, const pack& b) { return {a.low_ < b.low_, a.high_ < b.high_}; }
  [[gnu::always_inline]] friend mask operator<=(const pack& a, const pack& b) { return {a.low_ <= b.low_, a.high_ <= b.high_}; }
  [[gnu::always_inline]] friend mask operator>(const pack& a, const pack& b) { return {a.low_ > b.low_, a.high_ > b.high_}; }
  [[gnu::always_inline]] friend mask operator>=(const pack& a, const pack& b) { return {a.low_ >= b.low_, a.high_ >= b.high_}; }

  [[gnu::always_inline]] friend pack select(const mask& m, const pack& a, const pack& b) {
    return {select(m.low(), a.low_, b.low_), select(m.high(), a.high_, b.high_)};
  }
  [[gnu::always_inline]] friend pack abs(const pack& a) { return a.magnitude(); }
  [[gnu::always_inline]] friend pack sqrt(const pack& a) { return a.square_root(); }
  [[gnu::always_inline]] pack magnitude() const { return {low_.magnitude(), high_.magnitude()}; }
  [[gnu::always_inline]] pack square_root() const { return {low_.square_root(), high_.square_root()}; }

 private:
  half low_, high_;
};

}  // inline namespace

/// Several registers: each half by itself.
template <class T, int N>
  requires takes_registers<T, N>
struct carrier_traits<pack<T, N>> {
  using carrier = pack<T, N>;
  using scalar = T;
  using mask = typename carrier::mask;
  using part = carrier_traits<pack<T, N / 2>>;
  static constexpr int lanes = N;

  [[gnu::always_inline]] static carrier broadcast(T x) { return carrier(x); }
  [[gnu::always_inline]] static carrier abs(const carrier& x) { return x.magnitude(); }
  [[gnu::always_inline]] static carrier sqrt(const carrier& x) { return x.square_root(); }
  template <encoding E, rules R>
  [[gnu::always_inline]] static carrier round(const carrier& x) {
    return {part::template round<E, R>(x.low()), part::template round<E, R>(x.high())};
  }
  template <encoding E, rules R>
  [[gnu::always_inline]] static carrier fused(const carrier& a, const carrier& b, const carrier& c) {
    return {part::template fused<E, R>(a.low(), b.low(), c.low()),
            part::template fused<E, R>(a.high(), b.high(), c.high())};
  }
};

/// Formats that a lane carries without rounding twice, to nearest even (carrier.hpp).
template <class T, int N>
struct carrier_traits<pack<T, N>> {
  using carrier = pack<T, N>;
  using scalar = T;
  using mask = typename carrier::mask;
  using vector = typename carrier::vector;
  using bits = typename mask::bits;
  static constexpr int lanes = N;
  static constexpr encoding shape = detail::shape_of<T>::value;

  [[gnu::always_inline]] static carrier broadcast(T x) { return carrier(x); }
  [[gnu::always_inline]] static carrier abs(const carrier& x) { return x.magnitude(); }
  [[gnu::always_inline]] static carrier sqrt(const carrier& x) { return x.square_root(); }

  /// To nearest even. Adding a power of two pushes what lies below the format's unit out of the lane's significand;
  /// its exponent is that of the number, but at least that of the smallest normal one. No branch, no table:
  /// subnormals take the same time.
  template <encoding E, rules R>
  [[gnu::always_inline]] static carrier round(const carrier& x) {
    if constexpr (E == shape && R.overflow != overflow::saturate && !flushes_output(R.subnormal)) {
      return x;
    } else {
      static_assert(detail::is_narrower<T>(E, R),
                    "bitshade: a pack rounds binary formats narrower than its lanes, to nearest even");
      if constexpr (std::is_same_v<T, float> && E == binary_encoding(5, 10) &&
                    R.subnormal == subnormals::preserve && R.overflow != overflow::saturate) {
#if defined(__AVX512F__)
        if constexpr (N == 16) {
          return opaque(_mm512_maskz_cvtph_ps(0xffff, _mm512_maskz_cvtps_ph(0xffff, x.lanes_of(), nearest)));
        }
#endif
#if defined(__F16C__)
        if constexpr (N == 8) return opaque(_mm256_cvtph_ps(_mm256_cvtps_ph(x.lanes_of(), nearest)));
        if constexpr (N == 4) return opaque(_mm_cvtph_ps(_mm_cvtps_ph(x.lanes_of(), nearest)));
#endif
      }
      using word = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;
      constexpr int drop = shape.fraction_bits - E.fraction_bits;
      constexpr auto field = [](int exponent) {
        return static_cast<word>(exponent + bias(shape)) << shape.fraction_bits;
      };
      constexpr word infinity = static_cast<word>(infinity_bits(shape));
      constexpr T largest = std::bit_cast<T>(static_cast<word>(
          (static_cast<word>(max_bits(E)) << drop) + field(min_exponent(E)) - (word{1} << shape.fraction_bits)));
      constexpr T beyond = R.overflow == overflow::saturate ? largest
                           : has_infinity(E) ? std::bit_cast<T>(infinity)
                                             : std::numeric_limits<T>::quiet_NaN();
      const bits magnitude = std::bit_cast<bits>(x.lanes_of()) & (bits{} + std::numeric_limits<word>::max());
      const bits sign = std::bit_cast<bits>(x.lanes_of()) ^ magnitude;
      bits exponent = magnitude & (bits{} + infinity);
      exponent = exponent > field(min_exponent(E)) ? exponent : bits{} + field(min_exponent(E));
      // Beyond the largest exponent the power need only be large enough, and finite.
      exponent = exponent < field(bias(E) + 2) ? exponent : bits{} + field(bias(E) + 2);
      const vector power = std::bit_cast<vector>(exponent + (word{drop} << shape.fraction_bits));
      vector r = (std::bit_cast<vector>(magnitude) + power) - power;
      r = r > largest ? vector{} + beyond : r;
      if constexpr (flushes_output(R.subnormal)) {
        r = r < std::bit_cast<T>(field(min_exponent(E))) ? vector{} : r;
      }
      return carrier(std::bit_cast<vector>(std::bit_cast<bits>(r) | sign));
    }
  }

  /// a b + c: the product is exact in a lane that carries the format; an error-free sum, rounded to odd, keeps what
  /// the rounding to E has to know [BoldoMelquiond08].
  template <encoding E, rules R>
  [[gnu::always_inline]] static carrier fused(const carrier& a, const carrier& b, const carrier& c) {
    static_assert(std::is_same_v<T, float> ? carried_by_float(E) : carried_by_double(E));
    const vector product = a.lanes_of() * b.lanes_of(), term = c.lanes_of();
    const vector sum = product + term;
    const vector back = sum - product;
    const vector error = (product - (sum - back)) + (term - back);
    const bits pattern = std::bit_cast<bits>(sum);
    // Inexact and even: one step up in magnitude where the error has the sum's sign, else one down.
    const bits opposite = (std::bit_cast<bits>(error) ^ pattern) >> (8 * static_cast<int>(sizeof(T)) - 1);
    const bits inexact = (error < 0) | (error > 0);
    const bits step = inexact & ~pattern & 1;
    return round<E, R>(carrier(std::bit_cast<vector>(pattern + ((step ^ opposite) - opposite))));
  }

 private:
  /// clang 16 turns a comparison of converted halves into one of halves, lane by lane: hide where they came from.
  static carrier opaque(vector x) {
#if defined(__clang__) && defined(__SSE2__)
    asm("" : "+x"(x));
#endif
    return carrier(x);
  }
  static constexpr int nearest = 0x8;  // to nearest even whatever the processor is set to, no exceptions
};

/// Neighbouring scalars of an array as one number over a pack, and back; nothing is rounded.
///
/// Shapes   reads or writes P::lanes scalars from p on.
template <class P, class F, rules R>
real<F, R, P> load_pack(const real<F, R, typename P::scalar>* p) {
  real<F, R, P> r;
  static_assert(std::is_trivially_copyable_v<real<F, R, P>> && sizeof r == P::lanes * sizeof *p);
  std::memcpy(static_cast<void*>(&r), p, sizeof r);
  return r;
}
template <class P, class F, rules R>
void store_pack(const real<F, R, P>& x, real<F, R, typename P::scalar>* p) {
  std::memcpy(static_cast<void*>(p), &x, sizeof x);
}

}  // namespace bitshade
