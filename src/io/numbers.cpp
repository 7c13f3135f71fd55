#include "io/numbers.hpp"

#include <charconv>
#include <cmath>

#include "io/error.hpp"

namespace bitshade {

std::vector<double> parse_numbers(std::string_view text, const std::string& option,
                                  std::size_t least, std::size_t most) {
  const auto refuse = [&](const std::string& why) {
    const std::string count = least == most ? std::to_string(least)
                                            : std::to_string(least) + " to " + std::to_string(most);
    return usage_error(option + " takes " + count +
                       (most == 1 ? " number" : " numbers with commas between") + ", but '" +
                       std::string(text) + "' " + why);
  };
  std::vector<double> out;
  for (std::string_view rest = text;;) {
    const std::size_t comma = rest.find(',');
    const std::string_view part = rest.substr(0, comma);
    double value = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    if (error != std::errc() || end != part.data() + part.size() || !std::isfinite(value)) {
      throw refuse("has '" + std::string(part) + "' in it");
    }
    out.push_back(value);
    if (comma == std::string_view::npos) break;
    rest.remove_prefix(comma + 1);
  }
  if (out.size() < least || out.size() > most) throw refuse("has " + std::to_string(out.size()));
  return out;
}

std::uint64_t parse_seed(std::string_view text, const std::string& option) {
  std::uint64_t value = 0;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  if (error != std::errc() || end != last || text.empty())
    throw usage_error(option + " takes a whole number from 0 to 18446744073709551615, but not '" +
                      std::string(text) + "'");
  return value;
}

}  // namespace bitshade
