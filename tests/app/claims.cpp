// The command `claims` as its user meets it.
#include <nlohmann/json.hpp>

#include "support/catch.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

using namespace bitshade::test;
using nlohmann::json;

TEST_CASE("claims evaluates the case that it is given back, exactly") {
  const auto got = run_bitshade({"claims", "C5", "--replay", "x=0,1 t=2/3 splits=1/2", "--json"});
  REQUIRE(got.status == 0);
  const json page = json::parse(got.out);
  REQUIRE(page.size() == 1);
  CHECK(page[0]["refuted"] == true);
  CHECK(page[0]["case"] == "x=0,1 t=2/3 splits=1/2 floor=0");
  CHECK(page[0]["numbers"][0]["exact"] == "1");
  CHECK(page[0]["numbers"][1]["exact"] == "9/10");
  const auto agrees = run_bitshade({"claims", "C5", "--replay", "x=0,1 t=1/3 splits=1/2"});
  CHECK(agrees.status == 0);
  CHECK_THAT(agrees.out, Catch::Contains("This case agrees."));
}

TEST_CASE("claims prints a verdict with figures, and counterexamples that it takes back") {
  const auto got = run_bitshade({"claims", "C8", "C9", "C19", "--quick", "--json"});
  CAPTURE(got.err);
  REQUIRE(got.status == 0);
  const json page = json::parse(got.out);
  CHECK(page["command"] == "bitshade claims C8 C9 C19 --quick");
  REQUIRE(page["claims"].size() == 3);
  for (const json& c : page["claims"]) {
    CAPTURE(c["id"].dump());
    CHECK(c["verdict"] != "");
    CHECK(c["figures"].size() >= 4);
    CHECK(c["counterexamples"].size() >= 1);
    for (const json& example : c["counterexamples"]) {
      const auto again = run_bitshade({"claims", c["id"].get<std::string>(), "--replay",
                                       example["replay"].get<std::string>(), "--json"});
      CAPTURE(example["replay"].dump(), again.err);
      REQUIRE(again.status == 0);
      bool refuted = false;
      for (const json& r : json::parse(again.out))
        refuted = refuted || (r["refuted"] == true && r["numbers"] == example["numbers"]);
      CHECK(refuted);
    }
  }
}

TEST_CASE("claims refuses what it cannot mean, with status 2 and the cure") {
  const auto refused = [](std::vector<std::string> arguments, const std::string& with) {
    arguments.insert(arguments.begin(), "claims");
    const auto got = run_bitshade(arguments);
    INFO(got.err);
    CHECK(got.status == 2);
    CHECK(got.out.empty());
    CHECK_THAT(got.err, Catch::Contains(with));
  };
  refused({"C42"}, "known are C1 to C29");
  refused({"c5"}, "did you mean 'C5'?");
  refused({"--replay", "x=0"}, "name it");
  refused({"C22", "--replay", "x=0"}, "no single case");
  refused({"C5", "--replay", "y=0"}, "nothing here is called 'y'");
  refused({"--threads", "many"}, "--threads");
}

TEST_CASE("claims prints the same on any number of threads, within 80 columns, and pages") {
  const temporary_folder folder;
  const std::string out = (folder.path() / "claims").string();
  const auto one = run_bitshade({"claims", "C2", "C16", "--quick", "--threads", "1", "--out", out});
  const auto two = run_bitshade({"claims", "C16", "C2", "--quick", "--threads", "2"});
  CAPTURE(one.err, two.err);
  REQUIRE(one.status == 0);
  REQUIRE(two.status == 0);
  CHECK_THAT(one.out, Catch::StartsWith(two.out));
  for (std::size_t at = 0, end = 0; end != std::string::npos; at = end + 1) {
    end = two.out.find('\n', at);
    CHECK((end == std::string::npos ? two.out.size() : end) - at <= 80);
  }
  const std::string text = contents(folder.path() / "claims" / "claims.md");
  for (const char* part : {"Of 2 claims", "## Where the sources are right",
                           "## Where they need a condition", "### C16: holds if"})
    CHECK_THAT(text, Catch::Contains(part));
  const std::string page = contents(folder.path() / "claims" / "claims.html");
  CHECK_THAT(page, Catch::Contains("Where they need a condition") && Catch::Contains("C16"));
  CHECK(json::parse(contents(folder.path() / "claims" / "claims.json"))["claims"].size() == 2);
}
