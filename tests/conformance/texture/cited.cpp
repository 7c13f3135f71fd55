// Every preset names its sources, and the bibliography has them.
#include <set>
#include <sstream>
#include <string>

#include "bitshade/texture/presets.hpp"
#include "io/atomic_file.hpp"
#include "support/catch.hpp"

using namespace bitshade;

TEST_CASE("every preset cites keys of the bibliography, and where to look there") {
  const auto bytes = read_file(std::filesystem::path(BITSHADE_SOURCE_DIR) / "docs/bibliography.md");
  const std::string bibliography(bytes.begin(), bytes.end());
  std::set<std::string_view> names;
  for (const filter_model& m : presets) {
    CAPTURE(std::string(m.name), std::string(m.source));
    CHECK(names.insert(m.name).second);
    CHECK(m.source.find(": ") != std::string_view::npos);  // more than a key
    std::istringstream parts{std::string(m.source)};
    std::size_t keys = 0;
    for (std::string part; std::getline(parts, part, ';'); ++keys) {
      part.erase(0, part.find_first_not_of(' '));
      const std::string key = "| [" + part.substr(0, part.find(':')) + "] |";
      CAPTURE(key);
      CHECK(bibliography.find(key) != std::string::npos);
    }
    CHECK(keys > 0);
  }
}
