#include "claims/number.hpp"

#include "bitshade/interop/rational.hpp"

namespace bitshade::claims {

struct number::value {
  rational q;
};

number::number() : value_(std::make_unique<value>()) {}
number::number(value v) : value_(std::make_unique<value>(std::move(v))) {}
number::number(double x) : number(value{exact_rational(x).value()}) {}
number::number(std::int64_t above, std::int64_t below) : number(value{rational(above, below)}) {}
number::number(const number& b) : number(value(*b.value_)) {}
number::number(number&& b) noexcept = default;
number& number::operator=(const number& b) {
  if (this != &b) value_ = std::make_unique<value>(*b.value_);
  return *this;
}
number& number::operator=(number&& b) noexcept = default;
number::~number() = default;

number::operator double() const { return static_cast<double>(value_->q); }

number& number::operator+=(const number& b) {
  value_->q += b.value_->q;
  return *this;
}
number& number::operator-=(const number& b) {
  value_->q -= b.value_->q;
  return *this;
}
number& number::operator*=(const number& b) {
  value_->q *= b.value_->q;
  return *this;
}
number& number::operator/=(const number& b) {
  value_->q /= b.value_->q;
  return *this;
}

int number::compared(const number& b) const { return value_->q.compare(b.value_->q); }

number number::above() const { return number(value{rational(numerator(value_->q))}); }
number number::below() const { return number(value{rational(denominator(value_->q))}); }

number number::floor() const {
  using boost::multiprecision::cpp_int;
  const cpp_int n = numerator(value_->q), d = denominator(value_->q);
  cpp_int whole = n / d;  // toward zero
  if (n < 0 && whole * d != n) --whole;
  return number(value{rational(whole)});
}

std::string number::text() const { return value_->q.str(); }

}  // namespace bitshade::claims
