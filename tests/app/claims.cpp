// The command `claims` as its user meets it.
#include <nlohmann/json.hpp>

#include "support/catch.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

using bitshade::test::run_bitshade;

TEST_CASE("claims evaluates the case that it is given back, exactly") {
  const auto got = run_bitshade({"claims", "C5", "--replay", "x=0,1 t=2/3 splits=1/2", "--json"});
  REQUIRE(got.status == 0);
  const auto page = nlohmann::json::parse(got.out);
  CHECK(page["refutes"] == true);
  CHECK(page["numbers"][0]["exact"] == "1");
  CHECK(page["numbers"][1]["exact"] == "9/10");
  const auto agrees = run_bitshade({"claims", "C5", "--replay", "x=0,1 t=1/3 splits=1/2"});
  CHECK(agrees.status == 0);
  CHECK_THAT(agrees.out, Catch::Contains("agrees with the claim"));
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
  refused({"--replay", "x=0"}, "name it");
  refused({"C22", "--replay", "x=0"}, "no single case");
  refused({"C5", "--replay", "y=0"}, "nothing here is called 'y'");
  refused({"--threads", "many"}, "--threads");
}

TEST_CASE("claims prints the same on any number of threads, within 80 columns, and a page") {
  temporary_folder folder;
  const std::string page = (folder.path() / "claims.md").string();
  const auto one =
      run_bitshade({"claims", "C2", "C16", "--quick", "--threads", "1", "--markdown", page});
  const auto two = run_bitshade({"claims", "C16", "C2", "--quick", "--threads", "2"});
  REQUIRE(one.status == 0);
  CHECK(one.out == two.out);
  for (std::size_t at = 0, end = 0; end != std::string::npos; at = end + 1) {
    end = one.out.find('\n', at);
    CHECK((end == std::string::npos ? one.out.size() : end) - at <= 80);
  }
  const std::string text = bitshade::test::contents(page);
  CHECK_THAT(text, Catch::Contains("## Where the sources are right") &&
                       Catch::Contains("## Where they need a condition") &&
                       Catch::Contains("### C16: holds if"));
}
