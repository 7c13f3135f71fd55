#include "command/format_options.hpp"

#include <span>
#include <string_view>

#include "bitshade/formats/name.hpp"
#include "bitshade/formats/packed.hpp"
#include "io/error.hpp"
#include "io/format_names.hpp"
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

}  // namespace

format_choice choose_format(const std::string& name) {
  if (name == "r11g11b10")
    return {name, {r11g11b10::components.begin(), r11g11b10::components.end()}, 32};
  if (const auto e = parse_encoding(name)) return {name_of(*e), {*e}, e->width};
  throw usage_error("--format: '" + name + "' " + explain_format_name(name));
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
