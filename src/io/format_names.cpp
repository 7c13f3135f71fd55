#include "io/format_names.hpp"

#include <array>
#include <cctype>
#include <utility>
#include <vector>

#include "bitshade/formats/name.hpp"
#include "io/nearest.hpp"

namespace bitshade {
namespace {

/// What other tools call formats.
constexpr std::array<std::pair<std::string_view, std::string_view>, 14> foreign_names{{
    {"fp16", "half"},
    {"f16", "half"},
    {"float16", "half"},
    {"r16_float", "half"},
    {"bf16", "bfloat16"},
    {"fp32", "float"},
    {"f32", "float"},
    {"float32", "float"},
    {"fp64", "double"},
    {"float64", "double"},
    {"e4m3fn", "fp8_e4m3"},
    {"r8_unorm", "unorm8"},
    {"r16_unorm", "unorm16"},
    {"r11g11b10_float", "r11g11b10"},
}};

/// What a name of the right form but out of range breaks; empty where the form is unknown.
std::string_view range_of(std::string_view letters) {
  if (letters == "em" || letters == "uem") return "eXmY needs 2 <= X <= 11 and 1 <= Y <= 52";
  if (letters == "unorm") return "unormN needs 1 <= N <= 32";
  if (letters == "snorm") return "snormN needs 2 <= N <= 32";
  if (letters == "fixed.") return "fixedI.F needs I >= 1 and 2 <= I + F <= 64";
  if (letters == "ufixed.") return "ufixedI.F needs 1 <= I + F <= 64";
  return "";
}

/// The known names, and each family's with the numbers that stand in a name.
std::vector<std::string> candidates(const std::vector<std::string>& numbers) {
  std::vector<std::string> names;
  for (const auto& known : known_encodings) names.emplace_back(known.name);
  names.emplace_back("r11g11b10");
  const auto offer = [&](const std::string& name) {
    if (parse_encoding(name)) names.push_back(name);
  };
  if (numbers.size() == 1) {
    for (const char* word : {"unorm", "snorm"}) offer(word + numbers[0]);
  } else if (numbers.size() == 2) {
    for (const char* word : {"e", "ue"}) offer(word + numbers[0] + 'm' + numbers[1]);
    for (const char* word : {"fixed", "ufixed"}) offer(word + numbers[0] + '.' + numbers[1]);
  }
  return names;
}

}  // namespace

std::string explain_format_name(std::string_view name) {
  std::string small, letters;
  std::vector<std::string> numbers;
  bool in_number = false;
  for (const char c : name) {
    const char lower = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    small += lower;
    const bool digit = lower >= '0' && lower <= '9';
    if (!digit) {
      letters += lower;
    } else if (!in_number) {
      numbers.emplace_back(1, lower);
    } else {
      numbers.back() += lower;
    }
    in_number = digit;
  }
  const std::string_view range = range_of(letters);
  if (!range.empty() && !numbers.empty() && !parse_encoding(small)) return "is out of range: " + std::string(range);
  for (const auto& [theirs, ours] : foreign_names)
    if (small == theirs) return "is no format; did you mean '" + std::string(ours) + "'?";
  const auto known = candidates(numbers);
  const std::string_view near = nearest(small, std::vector<std::string_view>(known.begin(), known.end()));
  if (!near.empty()) return "is no format; did you mean '" + std::string(near) + "'?";
  return "is no format; write half, bfloat16, tf32, float, double, fp8_e4m3, fp8_e5m2, eXmY (X bits of exponent, Y of "
         "fraction), unormN, snormN, fixedI.F or ufixedI.F; 'bitshade formats' lists them";
}

}  // namespace bitshade
