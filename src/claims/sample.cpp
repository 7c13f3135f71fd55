#include "claims/sample.hpp"

#include <algorithm>
#include <stdexcept>

#include "io/error.hpp"
#include "io/nearest.hpp"
#include "io/text.hpp"

namespace bitshade::claims {
namespace {

const number grid_step(1, 1 << 24);

std::size_t below(random_stream& random, std::size_t count) {
  return static_cast<std::size_t>(random.next() * static_cast<double>(count));
}

number draw_number(quantity what, random_stream& random) {
  const std::size_t odds = below(random, 8);
  const auto fraction = [&](std::int64_t steps) {
    const auto k = static_cast<std::int64_t>(random.next() * static_cast<double>(steps + 1));
    return number(k, steps);
  };
  switch (what) {
    case quantity::share:
      if (odds < 2) return number(static_cast<int>(odds));
      return odds < 5 ? fraction(static_cast<std::int64_t>(2 + below(random, 30))) : fraction(4096);
    case quantity::grid:
      if (odds < 4) return number(1, std::int64_t{1} << (1 + below(random, 20)));
      return fraction(4096);
    case quantity::whole:
      return number(1 + static_cast<int>(below(random, 16)));
  }
  return number(0);
}

/// "2/3", "0.7", "12": exact, or nothing.
bool read_decimal(std::string_view text, number& value) {
  number digits = 0, scale = 1;
  bool point = false, any = false;
  for (const char c : text) {
    if (c == '.' && !point) {
      point = true;
    } else if (c >= '0' && c <= '9') {
      digits = digits * number(10) + number(c - '0');
      if (point) scale *= number(10);
      any = true;
    } else {
      return false;
    }
  }
  value = digits / scale;
  return any && text.size() <= 100;
}

number read_number(std::string_view text, const parameter& of) {
  const std::size_t slash = text.find('/');
  number above, below = 1;
  const bool good =
      read_decimal(text.substr(0, slash), above) &&
      (slash == std::string_view::npos || read_decimal(text.substr(slash + 1), below));
  if (!good || below == number(0))
    throw usage_error("--replay: '" + std::string(text) + "' in " + std::string(of.name) +
                      " is no number: write 2/3 or 0.7");
  const number value = above / below;
  const auto refuse = [&](const std::string& what) {
    throw usage_error("--replay: " + std::string(of.name) + " = " + std::string(text) + " is not " +
                      what);
  };
  if (of.what == quantity::whole) {
    if (!value.whole() || value < number(1) || value > number(16))
      refuse("a whole number from 1 to 16");
  } else if (value > number(1)) {
    refuse("in [0,1]");
  } else if (of.what == quantity::grid && !(value / grid_step).whole()) {
    refuse("a multiple of 2^-24, on which splits, overlaps and floors lie here");
  }
  return value;
}

}  // namespace

std::size_t sample::at(std::string_view name) const {
  for (std::size_t i = 0; i < names_->size(); ++i)
    if ((*names_)[i].name == name) return i;
  throw std::logic_error("no parameter " + std::string(name));
}

std::vector<double> sample::reals(std::string_view name) const {
  std::vector<double> result;
  for (const number& x : list(name)) result.push_back(static_cast<double>(x));
  return result;
}

sample draw(const shape& names, random_stream& random) {
  sample s(names);
  std::vector<number> before;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const parameter& p = names[i];
    const std::size_t count = p.least + below(random, p.most - p.least + 1);
    for (std::size_t k = 0; k < count; ++k) {
      const bool tie = p.what == quantity::share && !before.empty() && below(random, 8) == 0;
      const number x = tie ? before[below(random, before.size())] : draw_number(p.what, random);
      s.at_index(i).push_back(x);
      if (p.what == quantity::share) before.push_back(x);
    }
  }
  return s;
}

std::string text_of(const number& x) { return x.text(); }

std::string text_of(const sample& s) {
  std::string text;
  for (std::size_t i = 0; i < s.names().size(); ++i) {
    text.append(text.empty() ? "" : " ").append(s.names()[i].name).append("=");
    for (std::size_t k = 0; k < s.at_index(i).size(); ++k)
      text.append(k == 0 ? "" : ",").append(text_of(s.at_index(i)[k]));
  }
  return text;
}

sample parse_sample(const shape& names, std::string_view text) {
  sample s(names);
  std::vector<std::string_view> known;
  for (const parameter& p : names) known.push_back(p.name);
  for (const std::string& word : split(text, ' ')) {
    if (word.empty()) continue;
    const std::size_t equals = word.find('=');
    const std::string name = word.substr(0, equals);
    const auto found = std::find(known.begin(), known.end(), name);
    if (equals == std::string::npos || found == known.end())
      throw usage_error("--replay: nothing here is called '" + name + "': " + suggest(name, known));
    auto& list = s.list(name);
    if (!list.empty()) throw usage_error("--replay: " + name + " is given twice, keep one");
    const parameter& p = names[static_cast<std::size_t>(found - known.begin())];
    if (equals + 1 == word.size()) continue;
    for (const std::string& one : split(word.substr(equals + 1), ','))
      list.push_back(read_number(one, p));
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    const parameter& p = names[i];
    const std::size_t count = s.at_index(i).size();
    // A single number that is left out is 0; lists and whole numbers must be there.
    if (count == 0 && p.least == 1 && p.most == 1 && p.what != quantity::whole)
      s.at_index(i).emplace_back(0);
    else if (count < p.least || count > p.most)
      throw usage_error("--replay: " + std::string(p.name) + " takes " + std::to_string(p.least) +
                        (p.least == p.most ? "" : " to " + std::to_string(p.most)) +
                        " numbers, not " + std::to_string(count));
  }
  return s;
}

}  // namespace bitshade::claims
