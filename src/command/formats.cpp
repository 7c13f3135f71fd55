// `bitshade formats`: the formats by name, with limits derived from their encodings.
#include <CLI/CLI.hpp>
#include <charconv>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "bitshade/formats/decode.hpp"
#include "bitshade/formats/hexadecimal.hpp"
#include "bitshade/formats/name.hpp"
#include "bitshade/formats/packed.hpp"
#include "command/commands.hpp"
#include "io/text.hpp"

namespace bitshade::command {
namespace {

const char* word_of(family kind) {
  switch (kind) {
    case family::binary: return "binary";
    case family::unorm: return "unorm";
    case family::snorm: return "snorm";
    case family::ufixed: return "ufixed";
    case family::fixed: return "fixed";
  }
  return "";
}

/// The code of the smallest number: the most negative one of norms and fixed point.
double lowest(const encoding& e) {
  if (e.kind == family::fixed) return decode(e, sign_bit(e));
  if (e.kind == family::snorm) return -1;
  return e.has_sign ? -decode(e, max_bits(e)) : 0;
}

/// Enough for fixed16.16 to stay below 32768.
std::string ten_digits(double x) {
  char buffer[40];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, x, std::chars_format::general, 10).ptr};
}

std::string aliases_of(const encoding& e, std::string_view name) {
  std::string out;
  for (const auto& known : known_encodings) {
    if (known.value == e && known.name != name) out += (out.empty() ? "" : " ") + std::string(known.name);
  }
  return out;
}

nlohmann::ordered_json describe(const std::string& name, const encoding& e) {
  nlohmann::ordered_json j{{"name", name}, {"kind", word_of(e.kind)}, {"bits", e.width}};
  if (const std::string other = aliases_of(e, name); !other.empty()) j["alias"] = other;
  if (e.kind == family::binary) {
    j["exponent_bits"] = e.exponent_bits;
    j["fraction_bits"] = e.fraction_bits;
    j["infinities"] = has_infinity(e);
    j["smallest_normal"] = hexadecimal(decode(e, min_normal_bits(e)));
  } else if (e.kind == family::fixed || e.kind == family::ufixed) {
    j["integer_bits"] = e.width - e.fraction_bits;
    j["fraction_bits"] = e.fraction_bits;
  }
  j["smallest_positive"] = hexadecimal(decode(e, 1));
  j["lowest"] = hexadecimal(lowest(e));
  j["largest"] = hexadecimal(decode(e, max_bits(e)));
  return j;
}

std::vector<std::pair<std::string, encoding>> listed() {
  std::vector<std::pair<std::string, encoding>> list;
  for (const auto& known : known_encodings) {
    if (name_of(known.value) == known.name) list.emplace_back(known.name, known.value);
  }
  return list;
}

void print_json() {
  auto list = nlohmann::ordered_json::array();
  for (const auto& [name, e] : listed()) list.push_back(describe(name, e));
  auto parts = nlohmann::ordered_json::array();
  for (const encoding& e : r11g11b10::components) parts.push_back(describe(name_of(e), e));
  list.push_back({{"name", "r11g11b10"}, {"kind", "packed"}, {"bits", 32}, {"components", parts}});
  std::cout << list.dump(2) << '\n';
}

void print_table() {
  const auto row = [](const std::string& name, const std::string& bits, const std::string& smallest,
                      const std::string& normal, const std::string& largest, const std::string& alias) {
    std::string line = pad_right(name, 12) + pad_left(bits, 4) + pad_left(smallest, 14) + pad_left(normal, 14) +
                       pad_left(largest, 18);
    if (!alias.empty()) line += "  also " + alias;
    std::cout << line << '\n';
  };
  std::cout << pad_right("format", 12) << "bits      smallest        normal           largest\n";
  for (const auto& [name, e] : listed()) {
    row(name, std::to_string(e.width), brief(decode(e, 1), 4),
        e.kind == family::binary ? brief(decode(e, min_normal_bits(e)), 4) : "-", ten_digits(decode(e, max_bits(e))),
        aliases_of(e, name));
  }
  std::cout << "r11g11b10     32  ue5m6, ue5m6 and ue5m5 in one word, the first lowest\n";
  std::cout << "\nand any of\n"
               "  eXmY        X exponent and Y fraction bits, IEEE semantics;\n"
               "              2 <= X <= 11, 1 <= Y <= 52\n"
               "  ueXmY       the same without a sign; negative numbers become 0\n"
               "  unormN      c / (2^N - 1), N <= 32\n"
               "  snormN      c / (2^(N-1) - 1), 2 <= N <= 32; both lowest codes are -1\n"
               "  fixedI.F    two's complement, I integer bits with the sign's, F fraction\n"
               "              bits; I + F <= 64\n"
               "  ufixedI.F   the same without a sign\n";
}

}  // namespace

void add_formats(CLI::App& app) {
  auto json = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand("formats", "List the number formats and what they can hold");
  command->add_flag("--json", *json, "A JSON array instead of a table");
  command->callback([json] { *json ? print_json() : print_table(); });
}

}  // namespace bitshade::command
