// --grid: what a file describes, what is wrong with it, and that shards of it join without loss.
#include <nlohmann/json.hpp>
#include <set>

#include "io/text.hpp"
#include "support/catch.hpp"
#include "support/process.hpp"
#include "support/rows.hpp"
#include "support/temporary_folder.hpp"

using namespace bitshade;
using namespace bitshade::test;
using nlohmann::json;

namespace {

std::vector<std::string> study(const temporary_folder& folder, const std::string& out,
                               std::initializer_list<std::string> more = {}) {
  std::vector<std::string> arguments{"study",  "garden",
                                     "--size", "64",
                                     "--view", "48x30",
                                     "--grid", (folder / "grid.json").string(),
                                     "--out",  (folder / out).string(),
                                     "--json", "--seed",
                                     "3"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

json rows_of(const outcome& o) {
  INFO(o.err);
  REQUIRE(o.status == 0);
  return json::parse(o.out).at("rows");
}

/// The rows of a folder, in their order, without what a clock decides.
json timeless(const std::filesystem::path& folder) {
  return without_times(json::parse(contents(folder / "results.json")).at("rows"));
}

constexpr const char* grid = R"({
  // every combination of these, ...
  "product": {"technique": ["vsm", "lvsm"], "layers": [1, 2], "format": ["unorm16", "half"],
              "min-variance": [1e-6, 1e-4], "slope-term": [true, false]},
  // ... but for these, ...
  "exclude": [{"technique": "vsm", "format": "half"}, {"min-variance": 1e-4, "slope-term": true}],
  // ... and this one.
  "cells": [{"technique": "lvsm", "format": "unorm16", "layers": 3, "splits": [0.5, 0.9]}]
})";

}  // namespace

TEST_CASE("a grid is a product without what is excluded, and single cells", "[app]") {
  const temporary_folder folder;
  write(folder / "grid.json", grid);
  const json rows = rows_of(run_bitshade(study(folder, "out", {"--overlap", "0.02"})));
  // vsm: unorm16, 3 of 4 floors and slopes, its layers all one; lvsm: 2 layers x 2 formats x 3.
  CHECK(rows.size() == 3 + 12 + 1);
  int slopes = 0, overlaps = 0;
  std::set<std::string> keys;
  for (const json& r : rows) {
    const std::string c = r.at("configuration");
    CAPTURE(c);
    keys.insert(c);
    CHECK(!(r.at("technique") == "vsm" && r.at("format") == "half"));
    const bool slope = c.find("slope-term=on") != std::string::npos;
    CHECK(!(slope && c.find("min-variance=0.0001") != std::string::npos));
    slopes += slope;
    overlaps += c.find("overlap=0.02") != std::string::npos;
  }
  CHECK(keys.size() == rows.size());
  CHECK(slopes == 1 + 4);
  CHECK(overlaps == 6 + 1);  // the command line's, wherever there are two layers
  CHECK(rows.back().at("configuration").get<std::string>().find("splits=0.5,0.9 ") !=
        std::string::npos);
  // Pictures of equal names would overwrite each other.
  std::size_t pictures = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "out/pictures"))
    pictures += entry.path().string().find("-error.png") != std::string::npos;
  CHECK(pictures == 2 * rows.size());
}

TEST_CASE("what is wrong with a grid is told with its place and its cure", "[app]") {
  const temporary_folder folder;
  const std::vector<std::pair<std::string, std::vector<std::string>>> wrong{
      {R"({"product": {"technique": ["vsm"], "format": ["unorm16"],})", {"line 1, column 58"}},
      {R"([1])", {"no object"}},
      {R"({"products": {}})", {"/products", "product"}},
      {R"({"product": {"technique": "vsm", "fromat": "half"}})", {"/product/fromat", "'format'"}},
      {R"({"product": {"technique": "vsm", "format": ["half", "halv"]}})",
       {"/product/format/1", "did you mean 'half'"}},
      {R"({"product": {"technique": "vsm", "format": "half", "overlap": [0, 0.9]}})",
       {"/product/overlap/1", "outside 0 to 0.5"}},
      {R"({"product": {"technique": "vsm", "format": "half", "blur": ["wide"]}})",
       {"/product/blur/0", "wide"}},
      {R"({"product": {"technique": "vsm", "format": "half", "slope-term": 1}})",
       {"/product/slope-term", "true or false"}},
      {R"({"product": {"technique": ["vsm", "vsm"], "format": "half"}})",
       {"/product/technique/1", "twice"}},
      {R"({"product": {"technique": "vsm", "technique": "lvsm", "format": "half"}})",
       {"\"technique\"", "twice"}},
      {R"({"product": {"technique": "vsm", "techniques": "lvsm", "format": "half"}})",
       {"/product/techniques", "again"}},
      {R"({"product": {"technique": "vsm", "format": []}})", {"/product/format", "empty"}},
      {R"({"product": {"technique": "lvsm", "format": "half", "layers": 3, "splits": "0.5"}})",
       {"/product", "splits 0.5"}},
      {R"({"product": {"technique": "vsm", "format": "half"}, "exclude": [{"format": "unorm16"}]})",
       {"/exclude/0", "no cell"}},
      {R"({"cells": [{"technique": "vsm", "format": ["half", "unorm16"]}]})",
       {"/cells/0/format", "numbers"}},
      {R"({"product": {"technique": "vsm"}})", {"/product", "4 cells"}},
      {R"({"product": {"technique": "vsm", "format": "half"}, "exclude": [{"format": "half"}]})",
       {"no cell"}}};
  for (const auto& [text, expected] : wrong) {
    CAPTURE(text);
    write(folder / "grid.json", text);
    const outcome o = run_bitshade(study(folder, "out"));
    CAPTURE(o.err);
    CHECK(o.status == 2);
    CHECK(o.err.find("grid.json") != std::string::npos);
    CHECK(split(o.err, '\n').size() == 2);  // one sentence
    for (const std::string& part : expected) {
      CAPTURE(part);
      CHECK(o.err.find(part) != std::string::npos);
    }
  }
  CHECK(!std::filesystem::exists(folder / "out"));
  CHECK(run_bitshade({"study", "--grid", (folder / "none.json").string()}).status == 1);
  write(folder / "grid.json", grid);
  CHECK(run_bitshade(study(folder, "out", {"--layers", "2"})).status == 2);
}

/// Rows that a killed run left behind; none where it had not yet made its database.
std::size_t rows_left(const temporary_folder& folder, const std::string& out) {
  const outcome o = run_bitshade({"merge", (folder / out).string(), "--json", "--out",
                                  (folder / "left").string()});
  const std::size_t rows = o.status == 0 ? json::parse(o.out).at("rows").size() : 0;
  std::filesystem::remove_all(folder / "left");
  return rows;
}

/// Kills a shard's run between its first and its last cell; later or sooner until one is hit.
void kill_in_the_middle(const temporary_folder& folder, const std::string& out,
                        const std::string& shard, std::chrono::microseconds after) {
  const std::size_t all = rows_of(run_bitshade(study(folder, "all", {"--shard", shard}))).size();
  REQUIRE(all > 1);
  for (int tries = 0; tries < 40; ++tries) {
    run_options options;
    options.kill_after = after;
    const outcome o = run_bitshade(study(folder, out, {"--shard", shard}), options);
    const std::size_t left = rows_left(folder, out);
    CAPTURE(after.count(), o.signal, o.status, left, all, o.err);
    CHECK((o.signal == 9 || o.status == 0));
    if (o.signal == 9 && left > 0 && left < all) return;
    std::filesystem::remove_all(folder / out);
    after = left > 0 ? after * 4 / 5 : after * 5 / 4;
  }
  FAIL("no kill fell between two cells");
}

TEST_CASE("shards of a grid, one of them killed and resumed, join to the whole", "[app]") {
  const temporary_folder folder;
  write(folder / "grid.json", grid);
  const auto began = std::chrono::steady_clock::now();
  rows_of(run_bitshade(study(folder, "whole")));
  const auto took = std::chrono::duration_cast<std::chrono::microseconds>(
      std::chrono::steady_clock::now() - began);
  std::vector<std::string> merge{"merge"}, alone{"merge", (folder / "whole").string()};
  for (const char* shard : {"1/3", "2/3", "3/3"}) {
    const std::string out = "part" + std::string(shard, 1);
    if (shard[0] == '2') kill_in_the_middle(folder, out, shard, took / 6);
    CHECK(!rows_of(run_bitshade(study(folder, out, {"--shard", shard}))).empty());
    merge.push_back((folder / out).string());
  }
  merge.insert(merge.end(), {"--out", (folder / "joined").string()});
  alone.insert(alone.end(), {"--out", (folder / "alone").string()});
  for (int twice = 0; twice < 2; ++twice) {
    REQUIRE(run_bitshade(merge).status == 0);
    REQUIRE(run_bitshade(alone).status == 0);
    const json joined = timeless(folder / "joined");
    CHECK(joined.size() == 16);
    CHECK((joined == timeless(folder / "alone")));
  }
  std::size_t compared = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "alone/pictures")) {
    CAPTURE(entry.path().filename());
    CHECK(contents(entry.path()) == contents(folder / "joined/pictures" / entry.path().filename()));
    ++compared;
  }
  CHECK(compared >= 3 * 16);
}
