// advise as a user runs it: the cheapest that keeps an error, why the others lost, its shader.
#include <nlohmann/json.hpp>

#include "io/text.hpp"
#include "support/catch.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

using namespace bitshade;
using namespace bitshade::test;
using nlohmann::json;

namespace {

outcome advise(const temporary_folder& folder, std::vector<std::string> more) {
  std::vector<std::string> arguments{"advise", "garden",    "--size", "64", "--view",
                                     "48x30",  "--repeats", "1",      "--out",
                                     (folder / "out").string()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_bitshade(arguments);
}

json answer(const outcome& o) {
  INFO(o.err);
  REQUIRE(o.status == 0);
  return json::parse(o.out);
}

}  // namespace

TEST_CASE("advise chooses the cheapest that keeps the error", "[app]") {
  const temporary_folder folder;
  const std::vector<std::string> offered{"--techniques", "vsm,lvsm,evsm2", "--layers", "2",
                                         "--json"};
  for (const std::string cost : {"bytes", "traffic", "time"}) {
    std::vector<std::string> more = offered;
    more.insert(more.end(), {"--cost", cost});
    const json all = answer(advise(folder, more));
    const std::string column = cost == "bytes"     ? "bytes_per_texel"
                               : cost == "traffic" ? "bytes_per_frame"
                                                   : "relative_time";
    const double most = all.at("max_error");
    // Floors as asked for, and those that noise needs in narrow formats; the reference is there.
    CHECK(all.at("configurations").size() == 3 * 3 + 3 * 2);
    double least = 1e300;
    for (const json& c : all.at("configurations")) {
      CAPTURE(c.dump(), most);
      CHECK(c.at("keeps") == (c.at("error") <= most));
      if (c.at("keeps")) least = std::min(least, c.at(column).get<double>());
      if (c.at("label") == "vsm binary32") CHECK(c.at("error") == most);
    }
    const json& first = all.at("configurations").at(0);
    CHECK(first.at("key") == all.at("chosen"));
    CHECK(first.at(column) == least);
    CHECK(all.at("render").get<std::string>().starts_with("bitshade render garden"));
  }
}

TEST_CASE("advise says so where nothing keeps the error, and comes as text", "[app]") {
  const temporary_folder folder;
  const outcome none =
      advise(folder, {"--techniques", "vsm", "--formats", "unorm8", "--max-error", "1e-9"});
  CHECK(none.status == 1);
  CHECK(none.out.find("No configuration here keeps") != std::string::npos);
  CHECK(none.out.find("shadow_light") == std::string::npos);
  CHECK(none.err.find("--max-error") != std::string::npos);
  const outcome text = advise(folder, {"--techniques", "lvsm", "--layers", "2", "--measure",
                                       "format-p999", "--max-error", "0.01"});
  INFO(text.err);
  CHECK(text.status == 0);
  for (const std::string& line : split(text.out, '\n')) {
    CAPTURE(line);
    // Commands and paths are not broken.
    if (!line.starts_with("See it: ") && !line.starts_with("The report is "))
      CHECK(columns(line) <= 80);
  }
  for (const char* part : {"The cheapest that keeps format-p999 within 0.01", "verdict",
                           "const float SPLIT[1] = float[1](0.5);", "float shadow_light("}) {
    CAPTURE(part);
    CHECK(text.out.find(part) != std::string::npos);
  }
  for (const auto& [option, value, says] :
       {std::tuple{"--cost", "byte", "bytes"}, {"--max-error", "2", "outside 0 to 1"},
        {"--measure", "rmse", "total-rmse"}, {"--formats", "exact", "exact"}}) {
    const outcome refused = advise(folder, {option, value});
    CAPTURE(option, refused.err);
    CHECK(refused.status == 2);
    CHECK(refused.err.find(says) != std::string::npos);
  }
}
