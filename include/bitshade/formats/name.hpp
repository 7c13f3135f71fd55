// Formats by name: what the command line and a study's tables call them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "bitshade/formats/encoding.hpp"

namespace bitshade {

struct named_encoding {
  std::string_view name;
  encoding value;
};

/// The names worth knowing; the first name of an encoding is the one that is printed.
inline constexpr std::array<named_encoding, 18> known_encodings{{
    {"binary16", binary16::value},
    {"bfloat16", bfloat16::value},
    {"tf32", tf32::value},
    {"binary32", binary32::value},
    {"binary64", binary64::value},
    {"fp8_e4m3", fp8_e4m3::value},
    {"fp8_e5m2", fp8_e5m2::value},
    {"unorm8", unorm_encoding(8)},
    {"unorm16", unorm_encoding(16)},
    {"unorm24", unorm_encoding(24)},
    {"unorm32", unorm_encoding(32)},
    {"snorm8", snorm_encoding(8)},
    {"snorm16", snorm_encoding(16)},
    {"fixed16.16", fixed_encoding(16, 16)},
    {"ufixed0.16", ufixed_encoding(0, 16)},
    {"half", binary16::value},
    {"float", binary32::value},
    {"double", binary64::value},
}};

namespace detail {

/// Takes a decimal number of at most three digits from the front of a text.
constexpr std::optional<int> take_number(std::string_view& text) {
  std::size_t n = 0;
  int value = 0;
  while (n < text.size() && n < 4 && text[n] >= '0' && text[n] <= '9') value = 10 * value + (text[n++] - '0');
  if (n == 0 || n == 4) return std::nullopt;
  text.remove_prefix(n);
  return value;
}
constexpr bool take(std::string_view& text, std::string_view word) {
  if (!text.starts_with(word)) return false;
  text.remove_prefix(word.size());
  return true;
}

}  // namespace detail

/// "half", "e5m7", "unorm12", "fixed4.12" ...: the encoding, or nothing where no valid format has that name.
constexpr std::optional<encoding> parse_encoding(std::string_view name) {
  for (const auto& known : known_encodings) {
    if (known.name == name) return known.value;
  }
  const auto valid = [&](const encoding& e) { return name.empty() && is_valid(e) ? std::optional(e) : std::nullopt; };
  if (detail::take(name, "unorm")) {
    const auto n = detail::take_number(name);
    return n ? valid(unorm_encoding(*n)) : std::nullopt;
  }
  if (detail::take(name, "snorm")) {
    const auto n = detail::take_number(name);
    return n ? valid(snorm_encoding(*n)) : std::nullopt;
  }
  const bool is_unsigned = detail::take(name, "ufixed");
  if (is_unsigned || detail::take(name, "fixed")) {
    const auto i = detail::take_number(name);
    if (!i || !detail::take(name, ".")) return std::nullopt;
    const auto f = detail::take_number(name);
    if (!f) return std::nullopt;
    return valid(is_unsigned ? ufixed_encoding(*i, *f) : fixed_encoding(*i, *f));
  }
  const bool no_sign = detail::take(name, "u");
  if (detail::take(name, "e")) {
    const auto e = detail::take_number(name);
    if (!e || !detail::take(name, "m")) return std::nullopt;
    const auto m = detail::take_number(name);
    if (!m) return std::nullopt;
    return valid(no_sign ? unsigned_binary_encoding(*e, *m) : binary_encoding(*e, *m));
  }
  return std::nullopt;
}

/// A name that parse_encoding reads back.
inline std::string name_of(const encoding& e) {
  for (const auto& known : known_encodings) {
    if (known.value == e) return std::string(known.name);
  }
  const auto pair = [&](const char* word) {
    return word + std::to_string(e.width - e.fraction_bits) + '.' + std::to_string(e.fraction_bits);
  };
  switch (e.kind) {
    case family::unorm: return "unorm" + std::to_string(e.width);
    case family::snorm: return "snorm" + std::to_string(e.width);
    case family::ufixed: return pair("ufixed");
    case family::fixed: return pair("fixed");
    case family::binary: break;
  }
  return (e.has_sign ? "e" : "ue") + std::to_string(e.exponent_bits) + 'm' + std::to_string(e.fraction_bits);
}

}  // namespace bitshade
