// `bitshade round`: numbers in, the same numbers as a format would hold them out. docs/round.md is its meaning.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "bitshade/formats/hexadecimal.hpp"
#include "bitshade/formats/random.hpp"
#include "bitshade/formats/round_to.hpp"
#include "bitshade/formats/text.hpp"
#include "command/commands.hpp"
#include "command/format_options.hpp"
#include "io/error.hpp"
#include "io/numbers.hpp"

namespace bitshade::command {
namespace {

struct options {
  std::string format, rounding = "nearest-even", subnormal = "preserve", overflow = "ieee";
  std::string seed = "0";
  bool json = false;
};

/// The texts of a line's numbers: the line itself, or its words for a packed format.
std::vector<std::string> numbers_of(const std::string& line, std::size_t count) {
  if (count == 1) return {line};
  std::vector<std::string> words;
  std::size_t at = 0;
  while ((at = line.find_first_not_of(" \t\r", at)) != std::string::npos) {
    const std::size_t end = std::min(line.find_first_of(" \t\r", at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

/// The lines before this one are answered: their array ends, so that it can be read.
[[noreturn]] void refuse(bool json, std::uint64_t line, std::string text, const std::string& wanted) {
  if (json) std::cout << "\n]\n";
  constexpr std::size_t shown = 40;
  if (text.size() > shown) text = text.substr(0, shown) + "...";
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < ' ' || c == 127) c = '?';
  }
  throw failure("standard input, line " + std::to_string(line) + ": '" + text + "' is not " + wanted);
}

void round_lines(const options& given) {
  const format_choice format = choose_format(given.format);
  rules r;
  r.direction = choose_rounding(given.rounding);
  if (choose_subnormal(given.subnormal) != subnormals::preserve) r.subnormal = subnormals::flush_output;
  r.overflow = choose_overflow(given.overflow);
  const std::uint64_t seed = parse_seed(given.seed, "--seed");
  const std::size_t count = format.components.size();

  // A filter: no flush of its output for each line that it reads, unless somebody types them.
  if (::isatty(STDIN_FILENO) == 0) std::cin.tie(nullptr);
  std::string line;
  std::uint64_t number = 0;
  if (given.json) std::cout << '[';
  // Input may have no end: it is of no use once the output cannot be written.
  while (std::cout && std::getline(std::cin, line)) {
    ++number;
    const std::vector<std::string> texts = numbers_of(line, count);
    if (texts.size() != count) refuse(given.json, number, line, "three numbers between blanks, as r11g11b10 takes them");
    std::uint64_t word = 0;
    int position = 0;
    std::string values;
    for (std::size_t i = 0; i < count; ++i) {
      const encoding& e = format.components[i];
      const auto x = parse_number(texts[i]);
      if (!x)
        refuse(given.json, number, texts[i],
               "a number: write a decimal, a C99 hexadecimal float, a ratio a/b, inf or nan");
      const std::uint64_t bits = encode(e, *x, r, rounding_bits(seed, number, i));
      word |= bits << position;
      position += e.width;
      const std::string value = hexadecimal(decode(e, bits));
      if (given.json)
        values += (i == 0 ? "\"" : ", \"") + value + '"';
      else
        values += value + ' ';
    }
    const std::string pattern = hexadecimal_bits(word, format.width);
    if (given.json) {
      std::cout << (number == 1 ? "\n" : ",\n") << " {\"line\": " << number << ", \"value\": "
                << (count == 1 ? values : '[' + values + ']') << ", \"bits\": \"" << pattern << "\"}";
    } else {
      std::cout << values << pattern << '\n';
    }
  }
  // std::cin reads through stdin and takes its errors for the end of the file.
  if (std::cin.bad() || std::ferror(stdin) != 0) throw failure("standard input cannot be read; check where it comes from");
  if (given.json) std::cout << "\n]\n";
}

}  // namespace

void add_round(CLI::App& app) {
  auto given = std::make_shared<options>();
  CLI::App* command = app.add_subcommand(
      "round",
      "Round numbers to a format: one a line in, its value and bits out\n"
      "A line is a decimal of any length, a C99 hexadecimal float, a ratio a/b, inf or nan, and is read "
      "exactly. The answer is the rounded number as a C99 hexadecimal float and its bits.");
  command->add_option("--format", given->format, "Format to round to; 'bitshade formats' lists them")
      ->required()
      ->option_text("NAME");
  command->add_option("--rounding", given->rounding,
                      "nearest-even, nearest-away, toward-zero, up, down, to-odd or stochastic")
      ->capture_default_str()
      ->type_name("DIRECTION");
  command->add_option("--subnormal", given->subnormal,
                      "preserve, or flush results that are subnormal to zeros of their sign")
      ->capture_default_str()
      ->type_name("WORD");
  command->add_option("--overflow", given->overflow,
                      "infinity, saturate, or ieee: as the direction of rounding says")
      ->capture_default_str()
      ->type_name("WORD");
  command->add_option("--seed", given->seed, "Key of stochastic rounding; the counter is the line's number")
      ->capture_default_str()
      ->option_text("N");
  command->add_flag("--json", given->json, "A JSON array instead of lines");
  command->footer(
      "Examples:\n"
      "  echo 0.1 | bitshade round --format half\n"
      "  echo 1/3 | bitshade round --format unorm16\n"
      "  echo 70000 | bitshade round --format e5m7 --overflow saturate");
  command->callback([given] { round_lines(*given); });
}

}  // namespace bitshade::command
