// real in and out of text: streams, and literals that round once.
#pragma once

#include <istream>
#include <ostream>
#include <string>

#include "bitshade/arithmetic/real.hpp"
#include "bitshade/formats/text.hpp"

namespace bitshade {

/// The number that a text says, rounded once from all its digits. Failure  NaN (0 where there is none).
template <class T>
  requires real_number<T>
constexpr T from_text(std::string_view text) {
  const auto x = parse_number(text);
  if (!x) return T::from_exact(exact_result::nan());
  return T::from_bits(static_cast<typename T::bits_type>(encode(T::encoding_value, *x, T::rules_value)));
}

/// As the stream would write the double: its flags, its locale.
template <class F, rules R, class C>
std::ostream& operator<<(std::ostream& out, const real<F, R, C>& x) {
  return out << static_cast<double>(x);
}

/// One word of text, read as parse_number does, in any locale; 0 and failbit where it is no number.
template <class F, rules R, class C>
std::istream& operator>>(std::istream& in, real<F, R, C>& x) {
  std::string word;
  if (!(in >> std::ws)) return in;
  // What can belong to a number, so that "1.5)" leaves the bracket.
  for (int c = in.peek(); c != std::char_traits<char>::eof(); c = in.peek()) {
    const char ch = static_cast<char>(c);
    const bool letter = (ch >= 'a' && ch <= 'z') || (ch >= 'A' && ch <= 'Z');
    const bool sign = (ch == '+' || ch == '-') && (word.empty() || word.back() == 'e' || word.back() == 'E' ||
                                                   word.back() == 'p' || word.back() == 'P');
    if (!(letter || (ch >= '0' && ch <= '9') || ch == '.' || sign)) break;
    word += ch;
    in.get();
  }
  if (const auto number = parse_number(word)) {
    x = real<F, R, C>::from_bits(static_cast<typename F::bits_type>(encode(F::value, *number, R)));
  } else {
    x = real<F, R, C>(0);
    in.setstate(std::ios::failbit);
  }
  return in;
}

/// using namespace bitshade::literals; then 0.1_half is rounded once, by the compiler, from its text.
namespace literals {

namespace detail {
/// A literal's text without digit separators, which are the language's, not the number's.
template <char... Text>
struct spelling {
  char text[sizeof...(Text)] = {Text...};
  std::size_t size = 0;

  consteval spelling() {
    for (const char c : text) {
      if (c != '\'') text[size++] = c;
    }
  }
  constexpr std::string_view view() const { return {text, size}; }
  /// 0b101 is no number to parse_number, but 010 is, and eight to the language.
  consteval bool is_decimal_or_hexadecimal() const {
    const bool octal = size > 1 && text[0] == '0' && view().find_first_not_of("0123456789") == std::string_view::npos;
    return !octal && parse_number(view()).has_value();
  }
};

template <class T, char... Text>
consteval T literal() {
  constexpr spelling<Text...> number;
  static_assert(number.is_decimal_or_hexadecimal(),
                "bitshade: a literal is written in decimal or hexadecimal digits, not in octal or binary ones");
  return from_text<T>(number.view());
}
}  // namespace detail

template <char... Text> consteval auto operator""_half() { return detail::literal<real<binary16>, Text...>(); }
template <char... Text> consteval auto operator""_bf16() { return detail::literal<real<bfloat16>, Text...>(); }
template <char... Text> consteval auto operator""_tf32() { return detail::literal<real<tf32>, Text...>(); }
template <char... Text> consteval auto operator""_e5m2() { return detail::literal<real<fp8_e5m2>, Text...>(); }
template <char... Text> consteval auto operator""_e4m3() { return detail::literal<real<fp8_e4m3>, Text...>(); }

}  // namespace literals

}  // namespace bitshade
