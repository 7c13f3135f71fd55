// Stochastic arithmetic: several samples of one computation, rounded at random, tell how many digits it kept.
#pragma once

#include <array>
#include <compare>
#include <cstddef>

#include "bitshade/arithmetic/exponential.hpp"
#include "bitshade/arithmetic/operations.hpp"
#include "bitshade/formats/random.hpp"

namespace bitshade {

/// N samples of a number of a format; each operation rounds each of them stochastically.
///
/// Policy   the random bits come from the operands' histories and the seed that the inputs were given: the same
///          expression with the same seed gives the same samples, on any thread.
/// Source   [Vignes04], [ParkerMCA97].
template <class Format, std::size_t N = 8>
class samples {
  static_assert(N >= 2, "bitshade: one sample has no spread");
  static constexpr encoding E = Format::value;
  static constexpr rules R{rounding::stochastic};

 public:
  /// A number of the format exactly; any other is rounded stochastically as well.
  constexpr samples(double x = 0, std::uint64_t seed = 0) : history_(mix64(seed ^ std::bit_cast<std::uint64_t>(x))) {
    for (std::size_t i = 0; i < N; ++i) bits_[i] = encode(E, x, R, random_bits(history_, i));
  }

  constexpr double sample(std::size_t i) const { return decode(E, bits_[i]); }
  constexpr double mean() const {
    double sum = 0;
    for (std::size_t i = 0; i < N; ++i) sum += sample(i);
    return sum / static_cast<double>(N);
  }
  /// What a template that ends in a number of the language's gets: the mean.
  template <class T>
    requires std::is_arithmetic_v<T>
  explicit constexpr operator T() const {
    return static_cast<T>(mean());
  }
  /// Bits on which the samples agree: log2(|mean| / standard deviation), from 0 to the format's precision.
  constexpr double significant_bits() const {
    const double m = mean(), most = E.kind == family::binary ? precision(E) : E.width;
    double square = 0;
    for (std::size_t i = 0; i < N; ++i) square += (sample(i) - m) * (sample(i) - m);
    if (square == 0) return most;
    // log2 of a ratio of squares, halved: no square root needed.
    const exact_result l = elementary::log2(m * m / (square / static_cast<double>(N - 1)));
    const double bits = decode(binary_encoding(11, 52), round_result(binary_encoding(11, 52), l, {})) / 2;
    return !(bits > 0) ? 0 : bits < most ? bits : most;
  }

  friend constexpr samples operator+(const samples& a, const samples& b) {
    return apply([](auto x, auto y, std::uint64_t r) { return add(E, x, y, R, r); }, 1, a, b);
  }
  friend constexpr samples operator-(const samples& a, const samples& b) {
    return apply([](auto x, auto y, std::uint64_t r) { return subtract(E, x, y, R, r); }, 2, a, b);
  }
  friend constexpr samples operator*(const samples& a, const samples& b) {
    return apply([](auto x, auto y, std::uint64_t r) { return multiply(E, x, y, R, r); }, 3, a, b);
  }
  friend constexpr samples operator/(const samples& a, const samples& b) {
    return apply([](auto x, auto y, std::uint64_t r) { return divide(E, x, y, R, r); }, 4, a, b);
  }
  friend constexpr samples sqrt(const samples& a) {
    return apply([](auto x, auto, std::uint64_t r) { return square_root(E, x, R, r); }, 5, a, a);
  }
  /// a b + c, each sample rounded once.
  friend constexpr samples fma(const samples& a, const samples& b, const samples& c) {
    samples r;
    r.history_ = mix64(a.history_ + mix64(b.history_ + mix64(c.history_ + 6)));
    for (std::size_t i = 0; i < N; ++i)
      r.bits_[i] = fused_multiply_add(E, a.bits_[i], b.bits_[i], c.bits_[i], R, random_bits(r.history_, i));
    return r;
  }
  /// A function of each sample, or of each pair, that gives an exact result; `which` tells it apart in the history.
  template <class Function>
  friend constexpr samples each(std::uint64_t which, Function f, const samples& a) {
    return apply([f](auto x, auto, std::uint64_t r) { return round_result(E, f(decode(E, x)), R, r); }, which, a, a);
  }
  template <class Function>
  friend constexpr samples each(std::uint64_t which, Function f, const samples& a, const samples& b) {
    return apply([f](auto x, auto y, std::uint64_t r) { return round_result(E, f(decode(E, x), decode(E, y)), R, r); },
                 which, a, b);
  }
  friend constexpr samples operator-(const samples& a) { return samples() - a; }
  friend constexpr samples operator+(const samples& a) { return a; }
  friend constexpr samples abs(const samples& a) { return a < samples() ? -a : a; }
  constexpr samples& operator+=(const samples& b) { return *this = *this + b; }
  constexpr samples& operator-=(const samples& b) { return *this = *this - b; }
  constexpr samples& operator*=(const samples& b) { return *this = *this * b; }
  constexpr samples& operator/=(const samples& b) { return *this = *this / b; }
  // Order is the means', and so is equality: of two numbers exactly one of <, == and > holds. Whether two numbers can
  // be told apart at all is another question, which indistinguishable() answers.
  friend constexpr bool operator==(const samples& a, const samples& b) { return a.mean() == b.mean(); }
  friend constexpr bool operator!=(const samples& a, const samples& b) { return !(a == b); }
  friend constexpr std::partial_ordering operator<=>(const samples& a, const samples& b) { return a.mean() <=> b.mean(); }
  friend constexpr bool operator<(const samples& a, const samples& b) { return a.mean() < b.mean(); }
  friend constexpr bool operator>(const samples& a, const samples& b) { return b < a; }
  friend constexpr bool operator<=(const samples& a, const samples& b) { return !(b < a); }
  friend constexpr bool operator>=(const samples& a, const samples& b) { return !(a < b); }

  /// Whether the difference has no significant bit: a stochastic zero [Vignes04].
  friend constexpr bool indistinguishable(const samples& a, const samples& b) {
    const samples d = a - b;
    return d.mean() == 0 || d.significant_bits() < 1;
  }

 private:
  template <class Operation>
  static constexpr samples apply(Operation operation, std::uint64_t which, const samples& a, const samples& b) {
    samples r;
    r.history_ = mix64(a.history_ + mix64(b.history_ + which));
    for (std::size_t i = 0; i < N; ++i) r.bits_[i] = operation(a.bits_[i], b.bits_[i], random_bits(r.history_, i));
    return r;
  }

  std::array<std::uint64_t, N> bits_{};
  std::uint64_t history_ = 0;
};

}  // namespace bitshade
