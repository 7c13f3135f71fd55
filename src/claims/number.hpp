// Exact rationals, compiled once: some thirty files of experiments need not know whose they are.
#pragma once

#include <concepts>
#include <cstdint>
#include <memory>
#include <string>

namespace bitshade::claims {

/// A rational number: + - x / and comparisons are exact, conversions in are exact. It is
/// exact_rational (interop/rational.hpp) with its operators in one place.
///
/// Failure  division by zero throws std::overflow_error, an infinite or NaN double std::domain_error.
class number {
 public:
  number();
  template <std::integral T>
  number(T x) : number(static_cast<std::int64_t>(x), 1) {}
  number(double x);
  number(std::int64_t above, std::int64_t below);
  number(const number& b);
  number(number&& b) noexcept;
  number& operator=(const number& b);
  number& operator=(number&& b) noexcept;
  ~number();

  explicit operator double() const;

  number& operator+=(const number& b);
  number& operator-=(const number& b);
  number& operator*=(const number& b);
  number& operator/=(const number& b);
  friend number operator+(number a, const number& b) { return a += b; }
  friend number operator-(number a, const number& b) { return a -= b; }
  friend number operator*(number a, const number& b) { return a *= b; }
  friend number operator/(number a, const number& b) { return a /= b; }
  friend number operator-(const number& a) { return number() - a; }
  friend bool operator==(const number& a, const number& b) { return a.compared(b) == 0; }
  friend bool operator!=(const number& a, const number& b) { return a.compared(b) != 0; }
  friend bool operator<(const number& a, const number& b) { return a.compared(b) < 0; }
  friend bool operator>(const number& a, const number& b) { return a.compared(b) > 0; }
  friend bool operator<=(const number& a, const number& b) { return a.compared(b) <= 0; }
  friend bool operator>=(const number& a, const number& b) { return a.compared(b) >= 0; }
  friend number abs(const number& a) { return a < number() ? -a : a; }

  number above() const;  ///< the numerator, in lowest terms
  number below() const;  ///< the denominator, at least 1
  number floor() const;  ///< the largest whole number that is not larger
  bool whole() const { return below() == number(1); }
  std::string text() const;  ///< "2/3", "0", "1"

 private:
  struct value;
  explicit number(value v);
  int compared(const number& b) const;

  std::unique_ptr<value> value_;
};

}  // namespace bitshade::claims
