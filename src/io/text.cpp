#include "io/text.hpp"

#include <charconv>
#include <cmath>

namespace bitshade {

std::size_t columns(std::string_view text) {
  std::size_t n = 0;
  for (const char c : text) n += (static_cast<unsigned char>(c) & 0xC0u) != 0x80u;
  return n;
}

std::vector<std::string> wrap(std::string_view text, std::size_t width) {
  std::vector<std::string> lines;
  for (const std::string& paragraph : split(text, '\n')) {
    std::string line;
    for (const std::string& word : split(paragraph, ' ')) {
      if (word.empty()) continue;
      if (!line.empty() && columns(line) + 1 + columns(word) > width) {
        lines.push_back(line);
        line.clear();
      }
      if (!line.empty()) line += ' ';
      line += word;
    }
    lines.push_back(line);
  }
  return lines;
}

std::string pad_right(std::string_view text, std::size_t width) {
  std::string out(text);
  for (std::size_t n = columns(text); n < width; ++n) out += ' ';
  return out;
}

std::string pad_left(std::string_view text, std::size_t width) {
  std::string out;
  for (std::size_t n = columns(text); n < width; ++n) out += ' ';
  return out += text;
}

std::string shortest(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  return {buffer, end};
}

std::string brief(double value, int digits) {
  if (value == 0) return "0";
  if (!std::isfinite(value)) return std::isnan(value) ? "nan" : value < 0 ? "-inf" : "inf";
  char buffer[64];
  const double magnitude = value < 0 ? -value : value;
  // Plain below a million and down to one leading zero; else the exponent says it sooner.
  const bool plain = magnitude >= 0.01 && magnitude < 1e6;
  auto end = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::scientific,
                           digits - 1)
                 .ptr;
  if (!plain) {
    // 1.2e-05 is written 1.2e-5: narrow tables have no column to spare.
    std::string text(buffer, end);
    if (const std::size_t e = text.find('e'); e + 2 < text.size() && text[e + 2] == '0')
      text.erase(e + 2, 1);
    if (const std::size_t plus = text.find('+'); plus != std::string::npos) text.erase(plus, 1);
    return text;
  }
  double rounded = 0;  // so that 0.9999 is written as 1.00, not as 1.000
  std::from_chars(buffer, end, rounded);
  int decimals = digits - 1;
  for (double m = rounded < 0 ? -rounded : rounded; m >= 10 && decimals > 0; m /= 10) --decimals;
  for (double m = rounded < 0 ? -rounded : rounded; m < 1; m *= 10) ++decimals;
  end =
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed, decimals).ptr;
  return {buffer, end};
}

std::string brief_or_whole(double value, int digits) {
  const bool whole = value > -1e7 && value < 1e7 && value == static_cast<int>(value);
  return whole ? std::to_string(static_cast<int>(value)) : brief(value, digits);
}

std::string percent(double share) {
  const double value = share * 100;
  if (value == 0) return "0";
  if (value > 0 && value < 0.01) return "<0.01";
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed,
                                 value < 10 ? 2 : 1)
                       .ptr;
  return {buffer, end};
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0;;) {
    const std::size_t end = text.find(separator, begin);
    parts.emplace_back(text.substr(begin, end == std::string_view::npos ? end : end - begin));
    if (end == std::string_view::npos) return parts;
    begin = end + 1;
  }
}

}  // namespace bitshade
