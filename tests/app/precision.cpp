// `bitshade precision` as its user sees it: a slope of -2, a joint chart, a cure for each mistake.
#include <cmath>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>

#include "support/catch.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

using namespace bitshade::test;
using nlohmann::json;

TEST_CASE("precision prints the curve's slope and writes plots, CSV and JSON") {
  const temporary_folder folder;
  const auto out = (folder.path() / "bits").string();
  const auto done = run_bitshade({"precision", "--layers", "1,2,4", "--min-variance", "9e-6",
                                  "--roundings", "1", "--json", "--out", out});
  CAPTURE(done.err);
  REQUIRE(done.status == 0);
  const json found = json::parse(done.out);
  REQUIRE(found["curves"].size() == 1);
  CHECK(std::fabs(found["curves"][0]["slope_found"].get<double>() + 2) < 0.05);
  for (const auto& point : found["curves"][0]["points"]) {
    CHECK(point["found"].get<double>() <= point["predicted"].get<double>());
  }
  CHECK(found["joint"].size() == 3);
  CHECK(json::parse(contents(folder.path() / "bits" / "precision.json")) == found);
  CHECK(contents(folder.path() / "bits" / "precision.csv").starts_with("where,technique"));
  CHECK(contents(folder.path() / "bits" / "precision.html").find("<svg") != std::string::npos);
}

TEST_CASE("precision refuses what no number of bits can answer") {
  const auto refused = [](std::vector<std::string> arguments, const std::string& cure) {
    arguments.insert(arguments.begin(), "precision");
    const auto done = run_bitshade(arguments);
    CAPTURE(done.err);
    CHECK(done.status == 2);
    CHECK(done.err.find(cure) != std::string::npos);
  };
  refused({"--min-variance", "0"}, "without a floor no number of bits suffices");
  refused({"--layers", "2.5"}, "whole numbers");
  refused({"--tolerated", "2"}, "0.00392");
  refused({"--layers", "200", "--min-variance", "1e-4"}, "fewer layers");
}

TEST_CASE("precision on a scene finds no more bits than the bound asks for") {
  const auto done = run_bitshade({"precision", "garden", "--size", "48", "--view", "32x20",
                                  "--layers", "1,2", "--min-variance", "1e-4", "--json"});
  CAPTURE(done.err);
  REQUIRE(done.status == 0);
  const json found = json::parse(done.out);
  // Four stages of vsm and lvsm each, two of both EVSM, and all of each; six rows of savsm.
  CHECK(found["on_scene"].size() == 22);
  for (const auto& s : found["on_scene"]) {
    CAPTURE(s.dump());
    CHECK(s["found_bits"].get<int>() > 0);
    if (!s["predicted_bits"].is_null()) CHECK(s["found_bits"].get<int>() <= s["predicted_bits"].get<int>());
    CHECK(s["error"].get<double>() <= 1.0 / 255);
  }
}

TEST_CASE("precision tells a summed-area table's store from its sums, and searches all of them") {
  const auto done =
      run_bitshade({"precision", "garden", "--size", "64", "--view", "32x20", "--techniques", "savsm",
                    "--min-variance", "1e-4", "--json"});
  CAPTURE(done.err);
  REQUIRE(done.status == 0);
  std::map<std::string, int> bits;
  const json found = json::parse(done.out);
  for (const auto& s : found["on_scene"])
    bits[s["stage"].get<std::string>() + " " + s["unit"].get<std::string>()] = s["found_bits"];
  CAPTURE(done.out);
  REQUIRE(bits.size() == 6);
  // 4096 texels: sums need more bits than what they are made of, and all of them what sums need.
  CHECK(bits["sums significand"] > bits["store significand"] + 4);
  CHECK(bits["all significand"] >= bits["sums significand"]);
  CHECK(bits["all significand"] <= bits["sums significand"] + 1);
  CHECK(std::abs(bits["all unorm"] - bits["store unorm"]) <= 1);

  const auto refused = run_bitshade({"precision", "garden", "--techniques", "savsm,pcf"});
  CHECK(refused.status == 2);
  CHECK(refused.err.find("stages of pcf") != std::string::npos);
  const auto idle = run_bitshade({"precision", "--techniques", "savsm"});
  CHECK(idle.status == 2);
  CHECK(idle.err.find("give a SCENE") != std::string::npos);
}

TEST_CASE("precision searches the stores of exponential, convolution and four-moment maps") {
  const auto done =
      run_bitshade({"precision", "garden", "--size", "32", "--view", "24x16", "--techniques",
                    "esm,csm,msm", "--blur", "3", "--json"});
  CAPTURE(done.err);
  REQUIRE(done.status == 0);
  const json found = json::parse(done.out);
  REQUIRE(found["on_scene"].size() == 9);  // store, blur and all of each, whatever the two floors
  for (const auto& s : found["on_scene"]) {
    CAPTURE(s.dump());
    CHECK(s["found_bits"].get<int>() > 4);
    CHECK(s["predicted_bits"].is_null() == (s["technique"] == "msm" || s["stage"] == "all"));
    if (!s["predicted_bits"].is_null())
      CHECK(s["found_bits"].get<int>() <= s["predicted_bits"].get<int>());
  }
}
