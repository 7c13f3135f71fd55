// Several numbers side by side in one vector register.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

#include "bitshade/arithmetic/select.hpp"
#include "bitshade/formats/contract.hpp"

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

}  // inline namespace

}  // namespace bitshade
