// A study that is killed at any moment loses no finished cell.
#include <nlohmann/json.hpp>
#include <random>

#include "support/catch.hpp"
#include "support/process.hpp"
#include "support/rows.hpp"
#include "support/temporary_folder.hpp"

using namespace bitshade::test;
using nlohmann::json;

TEST_CASE("ten kills and a resumption give the rows of an uninterrupted run", "[app]") {
  const temporary_folder folder;
  const auto arguments = [&](const std::string& out) -> std::vector<std::string> {
    return {"study",        "garden",       "--size",
            "128",          "--view",       "96x60",
            "--techniques", "vsm,lvsm,pcf", "--layers",
            "1,2,3,4",      "--formats",    "unorm8,unorm16,half,bfloat16,binary32,exact",
            "--json",       "--out",        (folder / out).string()};
  };
  const auto began = std::chrono::steady_clock::now();
  const outcome whole = run_bitshade(arguments("whole"));
  const auto took = std::chrono::duration_cast<std::chrono::microseconds>(
      std::chrono::steady_clock::now() - began);
  INFO(whole.err);
  REQUIRE(whole.status == 0);

  std::mt19937_64 random(20260722);
  int killed = 0;
  for (int i = 0; i < 100 && killed < 10; ++i) {
    run_options options;
    options.kill_after =
        std::chrono::microseconds(random() % static_cast<unsigned long>(took.count()));
    const outcome o = run_bitshade(arguments("killed"), options);
    INFO("killed after " << options.kill_after->count() << " us: " << o.err);
    CHECK((o.signal == 9 || o.status == 0));
    killed += o.signal == 9;
    // It was done before its end came: start afresh, or nothing is left to interrupt.
    if (o.status == 0) std::filesystem::remove_all(folder / "killed");
  }
  CHECK(killed == 10);
  const outcome resumed = run_bitshade(arguments("killed"));
  INFO(resumed.err);
  REQUIRE(resumed.status == 0);

  const auto rows = [](const outcome& o) { return without_times(json::parse(o.out).at("rows")); };
  CHECK(rows(resumed) == rows(whole));
  CHECK(rows(whole).size() == 36);
  // Nothing that was written aside is left, and every picture is whole.
  std::size_t pictures = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / "killed")) {
    CAPTURE(entry.path());
    CHECK(entry.path().extension() != ".part");
    if (entry.path().extension() != ".png") continue;
    CHECK(contents(entry.path()) == contents(folder / "whole/pictures" / entry.path().filename()));
    ++pictures;
  }
  CHECK(pictures > 36);
}
