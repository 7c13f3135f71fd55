#include "command/grid_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <set>
#include <vector>

#include "io/error.hpp"

namespace bitshade::command {
namespace {

/// "line 3, column 14" of a byte.
std::string place(const std::string& text, std::size_t byte) {
  const std::size_t end = std::min(byte, text.size());
  const auto begin = text.begin(), at = begin + static_cast<std::ptrdiff_t>(end);
  const auto line = std::count(begin, at, '\n') + 1;
  const std::size_t start = end == 0 ? std::string::npos : text.rfind('\n', end - 1);
  const std::size_t column = start == std::string::npos ? end : end - start - 1;
  return "line " + std::to_string(line) + ", column " +
         std::to_string(std::max<std::size_t>(1, column));
}

}  // namespace

nlohmann::ordered_json read_json(const std::string& file) {
  using json = nlohmann::ordered_json;
  std::ifstream in(file, std::ios::binary);
  if (!in) throw failure(file + ": cannot be read: " + std::strerror(errno));
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  std::vector<std::set<std::string>> open;  // names seen in each object that is not closed yet
  try {
    return json::parse(
        text,
        [&](int, json::parse_event_t event, json& value) {
          if (event == json::parse_event_t::object_start) open.emplace_back();
          if (event == json::parse_event_t::object_end) open.pop_back();
          if (event == json::parse_event_t::key && !open.back().insert(value).second)
            throw usage_error(file + ": the name \"" + value.get<std::string>() +
                              "\" stands twice in one object: keep one of them");
          return true;
        },
        true, true);
  } catch (const json::parse_error& e) {
    std::string why = e.what();  // "[json.exception.parse_error.101] parse error at …: reason"
    const std::size_t colon = why.find(": ", why.find("parse error at"));
    if (colon != std::string::npos) why = why.substr(colon + 2);
    throw usage_error(file + ": " + place(text, e.byte) + ": is no JSON: " + why);
  }
}

}  // namespace bitshade::command
