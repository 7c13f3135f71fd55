// Packs of more lanes than a register has: two halves, each of them a pack.
#pragma once

#include "bitshade/arithmetic/register_pack.hpp"

namespace bitshade {

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

}  // namespace bitshade
