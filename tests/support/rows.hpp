// Rows as the command prints them, without what a clock decides.
#pragma once

#include <nlohmann/json.hpp>

namespace bitshade::test {

inline nlohmann::json without_times(nlohmann::json rows) {
  for (nlohmann::json& r : rows)
    for (auto it = r.begin(); it != r.end();) {
      const std::string& name = it.key();
      const bool time = name.find("seconds") != std::string::npos || name.starts_with("natural") ||
                        name == "threads" || name == "repeats";
      it = time ? r.erase(it) : std::next(it);
    }
  return rows;
}

}  // namespace bitshade::test
