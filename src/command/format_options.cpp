#include "command/format_options.hpp"

#include <span>
#include <string_view>

#include "bitshade/formats/name.hpp"
#include "bitshade/formats/packed.hpp"
#include "io/error.hpp"
#include "io/nearest.hpp"

namespace bitshade::command {
namespace {

std::size_t choose(const char* option, const std::string& word, std::span<const char* const> words) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (word == words[i]) return i;
  }
  const std::vector<std::string_view> views(words.begin(), words.end());
  throw usage_error(std::string(option) + ": there is no '" + word + "'; " + suggest(word, views));
}

/// What a name of the right form but out of range breaks; empty where the form is unknown.
std::string range_of(const std::string& name) {
  std::string letters;
  for (const char c : name) {
    if (c < '0' || c > '9') letters += c;
  }
  if (letters.size() == name.size()) return "";
  if (letters == "em" || letters == "uem") return "eXmY needs 2 <= X <= 11 and 1 <= Y <= 52";
  if (letters == "unorm") return "unormN needs 1 <= N <= 32";
  if (letters == "snorm") return "snormN needs 2 <= N <= 32";
  if (letters == "fixed.") return "fixedI.F needs I >= 1 and 2 <= I + F <= 64";
  if (letters == "ufixed.") return "ufixedI.F needs 1 <= I + F <= 64";
  return "";
}

}  // namespace

format_choice choose_format(const std::string& name) {
  if (name == "r11g11b10")
    return {name, {r11g11b10::components.begin(), r11g11b10::components.end()}, 32};
  if (const auto e = parse_encoding(name)) return {name_of(*e), {*e}, e->width};
  if (const std::string range = range_of(name); !range.empty())
    throw usage_error("--format: '" + name + "' is out of range: " + range);
  throw usage_error("--format: there is no format '" + name + "'; did you mean '" + std::string(nearest_name(name)) +
                    "'? 'bitshade formats' lists them");
}

rounding choose_rounding(const std::string& word) {
  return static_cast<rounding>(choose("--rounding", word, rounding_words));
}
subnormals choose_subnormal(const std::string& word) {
  return static_cast<subnormals>(choose("--subnormal", word, subnormal_words));
}
overflow choose_overflow(const std::string& word) {
  return static_cast<overflow>(choose("--overflow", word, overflow_words));
}

}  // namespace bitshade::command
