// pareto as a user runs it: what is measured, what is on the front, what beats the others.
#include <map>
#include <nlohmann/json.hpp>

#include "io/text.hpp"
#include "support/catch.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

using namespace bitshade;
using namespace bitshade::test;
using nlohmann::json;

namespace {

std::vector<std::string> pareto(const temporary_folder& folder, const std::vector<std::string>& more,
                                const std::string& repeats = "3") {
  std::vector<std::string> arguments{"pareto",   "garden", "--size",    "64",
                                     "--view",   "48x30",  "--repeats", repeats,
                                     "--layers", "2",      "--out",     (folder / "out").string()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

}  // namespace

TEST_CASE("pareto measures every configuration and marks the fronts", "[app]") {
  const temporary_folder folder;
  const outcome o = run_bitshade(pareto(folder, {"--json"}));
  INFO(o.err);
  REQUIRE(o.status == 0);
  const json all = json::parse(o.out);
  const json& front = all.at("fronts").at(0);
  CHECK(front.at("measure") == "total-rmse");
  const json& cells = front.at("configurations");
  CHECK(cells.size() == 5 * 3);
  std::map<std::string, json> by_key;
  for (const json& c : cells) by_key[c.at("key")] = c;
  int on_time = 0, on_bytes = 0;
  for (const json& c : cells) {
    CAPTURE(c.dump());
    CHECK(c.at("natural_storage") == true);
    CHECK(c.at("repeats") == 3);
    for (const char* name : {"relative_map", "relative_shade", "relative_time"}) {
      const json& t = c.at(name);
      CHECK(t.at("low") > 0);
      CHECK(t.at("low") <= t.at("median"));
      CHECK(t.at("median") <= t.at("high"));
    }
    CHECK(c.at("passes") >= 1);
    CHECK(c.at("bytes_per_frame") > 0);
    // Only formats that the processor does not compute in cost emulation.
    const std::string label = c.at("label");
    CHECK((c.at("emulation_only_seconds") > 0) == !label.ends_with("binary32"));
    const auto judged = [&](const std::string& front_name, const std::string& by_name,
                            auto cost) {
      const bool is_front = c.at(front_name);
      CHECK(is_front == c.at(by_name).is_null());
      // Nothing is better in one and no worse in the other, if and only if it is on the front.
      bool beaten = false;
      for (const json& d : cells)
        beaten = beaten || (d.at("error") <= c.at("error") && cost(d) <= cost(c) &&
                            (d.at("error") < c.at("error") || cost(d) < cost(c)));
      CHECK(beaten == !is_front);
      if (is_front) return 1;
      const json& by = by_key.at(c.at(by_name));
      CHECK(by.at(front_name) == true);
      CHECK((by.at("error") <= c.at("error") && cost(by) <= cost(c)));
      return 0;
    };
    on_time += judged("front_of_time", "beaten_in_time_by",
                      [](const json& d) { return d.at("relative_time").at("median").get<double>(); });
    on_bytes += judged("front_of_bytes", "beaten_in_bytes_by",
                       [](const json& d) { return d.at("bytes_per_texel").get<double>(); });
  }
  CHECK(on_time > 0);
  CHECK(on_bytes > 0);
  CHECK(contents(folder / "out/report.html").find("Accuracy against time") != std::string::npos);
}

TEST_CASE("pareto's tables fit a page, and say what beats what", "[app]") {
  const temporary_folder folder;
  const std::vector<std::string> few{"--techniques", "hard,pcf,vsm,lvsm", "--overlap", "0"};
  const outcome o = run_bitshade(pareto(folder, few));
  INFO(o.err);
  REQUIRE(o.status == 0);
  for (const std::string& line : split(o.out, '\n')) {
    CAPTURE(line);
    if (!line.starts_with("The report is ")) CHECK(columns(line) <= 80);  // a path
  }
  for (const char* part : {"against time", "emulation*", "against what a GPU feels", "passes",
                           "front", "Beaten", "single-layer VSM in binary32"}) {
    CAPTURE(part);
    CHECK(o.out.find(part) != std::string::npos);
  }
  // The second run takes its times from the database, unless more repeats are asked for.
  const outcome again = run_bitshade(pareto(folder, few));
  CHECK(again.out.find("0 of 12 cells computed") != std::string::npos);
  const outcome more = run_bitshade(pareto(folder, few, "4"));
  CHECK(more.out.find("12 of 12 cells computed") != std::string::npos);
}

TEST_CASE("pareto refuses what makes no sense before it computes", "[app]") {
  const temporary_folder folder;
  const auto refused = [](const outcome& o, const std::string& says) {
    CAPTURE(says, o.err);
    CHECK(o.status == 2);
    CHECK(o.err.find(says) != std::string::npos);
  };
  refused(run_bitshade(pareto(folder, {"--measure", "total-rms"})), "total-rmse");
  refused(run_bitshade(pareto(folder, {}, "0")), "--repeats");
  refused(run_bitshade(pareto(folder, {"--formats", "exact"})), "exact");
  CHECK(!std::filesystem::exists(folder / "out"));
}
