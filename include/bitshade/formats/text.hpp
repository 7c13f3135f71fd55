// Text to bits with one rounding: decimals of any length, C99 hexadecimal floats, ratios, inf and nan.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

#include "bitshade/formats/digits.hpp"
#include "bitshade/formats/encode.hpp"

namespace bitshade {

/// A number as it was written: (-1)^negative over 10^ten 2^two / under, or no finite number at all.
struct exact_number {
  enum class kind : std::uint8_t { finite, infinite, nan };
  kind what = kind::finite;
  bool negative = false;
  bool is_ratio = false;
  digits over, under;
  std::int64_t ten = 0;
  std::int64_t two = 0;
};

namespace detail {

constexpr char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
constexpr int hex_value(char c) {
  c = lower(c);
  return is_digit(c) ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}
constexpr std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}
constexpr bool same_word(std::string_view text, std::string_view word) {
  if (text.size() != word.size()) return false;
  for (std::size_t i = 0; i < word.size(); ++i) {
    if (lower(text[i]) != word[i]) return false;
  }
  return true;
}
constexpr bool take_sign(std::string_view& text) {
  if (text.empty() || (text.front() != '-' && text.front() != '+')) return false;
  const bool negative = text.front() == '-';
  text.remove_prefix(1);
  return negative;
}

/// "[+-]digits", the whole text; saturates at +-10^17, which no sum of digit counts brings back.
constexpr std::optional<std::int64_t> exponent_of(std::string_view text) {
  const bool negative = take_sign(text);
  if (text.empty()) return std::nullopt;
  std::int64_t value = 0;
  for (const char c : text) {
    if (!is_digit(c)) return std::nullopt;
    value = value > 10'000'000'000'000'000 ? 100'000'000'000'000'000 : 10 * value + (c - '0');
  }
  return negative ? -value : value;
}

/// An unsigned decimal or hexadecimal number without the exponent limit of any format.
constexpr bool read_magnitude(std::string_view text, digits& n, std::int64_t& ten, std::int64_t& two) {
  const bool hex = text.size() > 2 && text[0] == '0' && lower(text[1]) == 'x';
  if (hex) text.remove_prefix(2);
  n = digits(hex);
  std::int64_t exponent = 0, zeros = 0, dropped = 0;
  bool any = false, seen_point = false;
  std::size_t i = 0;
  for (; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '.') {
      if (seen_point) return false;
      seen_point = true;
      continue;
    }
    const int digit = hex ? hex_value(c) : (is_digit(c) ? c - '0' : -1);
    if (digit < 0) break;
    any = true;
    if (seen_point) --dropped;
    // Zeros wait until another digit follows: trailing ones only move the exponent.
    if (digit == 0) {
      ++zeros;
      continue;
    }
    if (!n.is_zero())
      for (; zeros > 0; --zeros) n.append(0);
    zeros = 0;
    n.append(static_cast<unsigned>(digit));
  }
  if (!any) return false;
  if (i < text.size()) {
    if (lower(text[i]) != (hex ? 'p' : 'e')) return false;
    const auto given = exponent_of(text.substr(i + 1));
    if (!given) return false;
    exponent = *given;
  }
  if (hex) {
    two = exponent + 4 * (dropped + zeros);
  } else {
    ten = exponent + dropped + zeros;
  }
  return true;
}

/// The bits of (-1)^negative over 10^ten 2^two / under, both naturals positive; of a norm, over counts its steps.
constexpr std::uint64_t encode_ratio(const encoding& e, bool negative, natural over, natural under, std::int64_t ten,
                                     std::int64_t two, const rules& r, std::uint64_t random) {
  // |log2 x| beyond 1300 is beyond every format, half-steps and 64 random bits included.
  constexpr std::int64_t beyond = 1300;
  const std::int64_t binary = over.width() - under.width() + two;
  // log2 10 = 3.32192809488736...; the product is split to stay within 64 bits.
  const std::int64_t decimal = ten / 1000000 * 3321928 + ten % 1000000 * 3321928 / 1000000;
  const std::int64_t size = binary + decimal;
  const std::int64_t slack = beyond + (ten < 0 ? -ten : ten) / 1000000;
  leading_bits q{1, size < 0 ? -100000 : 100000, size < 0};
  if (size >= -slack && size <= slack) {
    if (ten > 0) over.multiply_power_of_5(ten);
    if (ten < 0) under.multiply_power_of_5(-ten);
    q = divide(std::move(over), std::move(under));
    q.exponent += two + ten;
  }
  if (is_norm(e)) return assemble(e, negative, 0, scaled(q.n, q.exponent, q.sticky), r, random);
  return encode_scaled(e, negative, q.n, q.exponent, q.sticky, r, random);
}

}  // namespace detail

/// Reads "-1.5e3", "0x1.8p+1", "1/65535", "inf", "nan" ...; nothing where the text is no such number.
///
/// Policy   blanks around the number and around '/' are ignored; letters may be of either case; the decimal
///          point is '.', whatever the locale.
/// Failure  nothing for anything else, for 1/0, for inf or nan in a ratio, and for a ratio of a hexadecimal and a
///          decimal number whose powers of 2 and of 10 both pass a million.
constexpr std::optional<exact_number> parse_number(std::string_view text) {
  exact_number x;
  text = detail::trimmed(text);
  const std::size_t slash = text.find('/');
  std::string_view left = detail::trimmed(text.substr(0, slash));
  x.negative = detail::take_sign(left);
  if (slash == std::string_view::npos) {
    if (detail::same_word(left, "inf") || detail::same_word(left, "infinity")) {
      x.what = exact_number::kind::infinite;
      return x;
    }
    if (detail::same_word(left, "nan")) {
      x.what = exact_number::kind::nan;
      return x;
    }
  }
  if (!detail::read_magnitude(left, x.over, x.ten, x.two)) return std::nullopt;
  if (slash == std::string_view::npos) {
    x.under.append(1);
    return x;
  }
  x.is_ratio = true;
  std::string_view right = detail::trimmed(text.substr(slash + 1));
  if (detail::take_sign(right)) x.negative = !x.negative;
  std::int64_t ten = 0, two = 0;
  if (!detail::read_magnitude(right, x.under, ten, two) || x.under.is_zero()) return std::nullopt;
  x.ten -= ten;
  x.two -= two;
  // 0x1p-3321928094/1e-1000000000 would need a billion digits to tell from 1.
  constexpr std::int64_t huge = 1'000'000;
  if ((x.ten > huge || x.ten < -huge) && (x.two > huge || x.two < -huge)) return std::nullopt;
  return x;
}

/// The bits of an exact number, rounded once. An exponent of a billion costs nothing.
///
/// Failure  none. Time is linear in the number of digits, but for a ratio that its first 800 digits leave undecided
///          (of two long equal numbers, say): its time grows with their square, seconds for a million digits.
constexpr std::uint64_t encode(const encoding& e, const exact_number& x, const rules& r = {},
                               std::uint64_t random = 0) {
  if (x.what == exact_number::kind::nan) return encode_nan(e, x.negative, std::uint64_t{1} << 51, r);
  if (x.what == exact_number::kind::infinite) {
    const std::uint64_t inf = 0x7ff0000000000000u | (x.negative ? std::uint64_t{1} << 63 : 0);
    return encode(e, std::bit_cast<double>(inf), r, random);
  }
  if (x.over.is_zero()) return encode_scaled(e, x.negative, 0, 0, false, r, random);
  digits over = x.over;
  // A norm counts in 1 / (2^N - 1): multiply while everything is exact.
  if (is_norm(e)) over.multiply(steps_to_one(e));
  const auto round = [&](digits::leading_part a, digits::leading_part b) {
    const std::int64_t ten = x.ten + (over.is_hexadecimal() ? 0 : a.dropped) - (x.under.is_hexadecimal() ? 0 : b.dropped);
    const std::int64_t two =
        x.two + 4 * ((over.is_hexadecimal() ? a.dropped : 0) - (x.under.is_hexadecimal() ? b.dropped : 0));
    return detail::encode_ratio(e, x.negative, std::move(a.n), std::move(b.n), ten, two, r, random);
  };
  digits::leading_part a = over.leading(), b = x.under.leading();
  if (!a.cut && !b.cut) return round(std::move(a), std::move(b));
  if (x.is_ratio) {
    // Roundings are monotone: where both bounds of the quotient go to the same code, so does the quotient.
    digits::leading_part most = a, least = b;
    if (a.cut) most.n.multiply_add(1, 1);
    if (b.cut) least.n.multiply_add(1, 1);
    const std::uint64_t low = round(std::move(a), std::move(least)), high = round(std::move(most), std::move(b));
    return low == high ? low : round(over.whole(), x.under.whole());
  }
  // A digit for all that was cut: no border lies between.
  a.n.multiply_add(16, 1);
  digits::leading_part last = std::move(b);
  last.n.multiply_add(16, 0);
  return round(std::move(a), std::move(last));
}

}  // namespace bitshade
