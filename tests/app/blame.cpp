// `bitshade blame` and `bitshade certify` as their users see them.
#include <nlohmann/json.hpp>

#include "support/catch.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

using namespace bitshade::test;
using nlohmann::json;

TEST_CASE("blame names a guilty stage and leaves a map of each") {
  const temporary_folder folder;
  const auto done = run_bitshade({"blame", "garden", "--size", "64", "--view", "48x30", "--json",
                                  "--format", "unorm8", "--out", folder.path().string()});
  CAPTURE(done.err);
  REQUIRE(done.status == 0);
  const json found = json::parse(done.out);
  double shares = 0;
  for (const auto& s : found["stages"]) shares += s["share"].get<double>();
  CHECK(shares == Approx(1));
  CHECK(found["stages"].size() == 5);
  for (const auto& file : found["files"]) {
    CHECK(contents(file.get<std::string>()).size() > 100);
  }
  const auto many = run_bitshade({"blame", "garden", "--format", "half,unorm16"});
  CHECK(many.status == 2);
  CHECK(many.err.find("one format") != std::string::npos);
  CHECK(run_bitshade({"blame", "garden", "--weight-bits", "99"}).status == 2);
}

TEST_CASE("blame tells the store of a summed-area table from its running sums") {
  const temporary_folder folder;
  const auto done =
      run_bitshade({"blame", "garden", "--size", "64", "--view", "48x30", "--json", "--technique",
                    "savsm", "--format", "half", "--msaa", "2", "--out", folder.path().string()});
  CAPTURE(done.err);
  REQUIRE(done.status == 0);
  const json found = json::parse(done.out);
  std::string stages;
  for (const auto& s : found["stages"]) stages += s["stage"].get<std::string>() + " ";
  CHECK(stages == "store resolve sums filter shading ");
  const auto refused = run_bitshade({"blame", "garden", "--technique", "savsm", "--weight-bits", "8"});
  CHECK(refused.status == 2);
  CHECK(refused.err.find("savsm") != std::string::npos);
}

TEST_CASE("certify prints each certificate narrower than the one before") {
  const temporary_folder folder;
  const auto done = run_bitshade({"certify", "slope", "--size", "64", "--view", "48x30", "--json",
                                  "--out", folder.path().string()});
  CAPTURE(done.err);
  REQUIRE(done.status == 0);
  const json found = json::parse(done.out);
  const auto largest = [&](const char* which) { return found[which]["largest"].get<double>(); };
  CHECK(largest("running") < largest("stored"));
  CHECK(largest("stored") < largest("global"));
  CHECK(contents(found["files"]["certificate"].get<std::string>()).starts_with("\x89PNG"));
  const auto refused = run_bitshade({"certify", "slope", "--technique", "msm"});
  CHECK(refused.status == 2);
  CHECK(refused.err.find("vsm, savsm and lvsm") != std::string::npos);
}
