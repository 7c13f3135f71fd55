// What `bitshade study` writes, and that it writes the same however it is run.
#include <nlohmann/json.hpp>

#include "io/text.hpp"
#include "support/catch.hpp"
#include "support/process.hpp"
#include "support/rows.hpp"
#include "support/temporary_folder.hpp"

using namespace bitshade;
using namespace bitshade::test;
using nlohmann::json;

namespace {

const std::vector<std::string> small{"study", "garden", "--size", "96", "--view", "80x50"};

std::vector<std::string> with(std::vector<std::string> arguments,
                              std::initializer_list<std::string> more) {
  arguments.insert(arguments.end(), more);
  return arguments;
}

/// The rows of a run without what a clock decides.
json rows_of(const outcome& o) {
  INFO(o.err);
  REQUIRE(o.status == 0);
  return without_times(json::parse(o.out).at("rows"));
}

}  // namespace

TEST_CASE("a study leaves a table, a database, CSV, JSON, pictures and a report", "[app]") {
  const temporary_folder folder;
  const std::string out = (folder / "out").string();
  const outcome o = run_bitshade(with(small, {"--out", out}));
  INFO(o.err);
  REQUIRE(o.status == 0);
  CHECK(o.err.empty());
  std::size_t longest = 0;
  for (const std::string& line : split(o.out, '\n'))
    if (line.find(out) == std::string::npos) longest = std::max(longest, columns(line));
  CHECK(longest <= 80);
  CHECK(o.out.find("Method error") != std::string::npos);
  CHECK(o.out.find("Format error") != std::string::npos);
  for (const char* name :
       {"overlap", "transition", "mips", "anisotropy", "subnormals", "layers without receivers"})
    CHECK(o.out.find(name) != std::string::npos);

  const json results = json::parse(contents(folder / "out/results.json"));
  CHECK(results.at("rows").size() == 16);  // (vsm + lvsm 1, 2, 4) x 4 formats
  const std::vector<std::string> lines = split(contents(folder / "out/results.csv"), '\n');
  REQUIRE(lines.size() == 18);  // a head, 16 rows and the end
  const std::vector<std::string> head = split(lines[0], ',');
  for (const char* column :
       {"technique", "format", "layers", "method_error_rmse", "method_error_largest",
        "method_error_p999", "format_error_rmse", "format_error_largest", "format_error_p999",
        "bleed_area", "acne_area", "bytes_per_texel", "map_seconds", "shade_seconds"})
    CHECK(std::find(head.begin(), head.end(), column) != head.end());
  for (std::size_t i = 1; i + 1 < lines.size(); ++i)
    CHECK(split(lines[i], ',').size() == head.size());

  for (const char* name : {"garden-shaded", "garden-truth", "garden-vsm-unorm16-visibility",
                           "garden-lvsm4-half-error", "garden-lvsm2-binary32-format-error"}) {
    CAPTURE(name);
    CHECK(contents(folder / "out/pictures" / (std::string(name) + ".png")).starts_with("\x89PNG"));
  }
  CHECK(contents(folder / "out/report.html").starts_with("<!doctype html>"));
  CHECK(contents(folder / "out/results.sqlite").starts_with("SQLite format 3"));
}

TEST_CASE("one layer of an LVSM has the figures of a VSM in every format", "[app]") {
  const temporary_folder folder;
  const json rows = rows_of(
      run_bitshade(with(small, {"--layers", "1", "--json", "--out", (folder / "out").string()})));
  REQUIRE(rows.size() == 8);
  for (std::size_t i = 0; i < 4; ++i) {
    json vsm = rows[i], lvsm = rows[i + 4];
    CAPTURE(vsm.at("format"));
    for (const char* name : {"key", "technique", "configuration", "effects"})
      vsm.erase(name), lvsm.erase(name);
    CHECK(vsm == lvsm);
  }
}

TEST_CASE("any number of threads and any locale give the same rows and pictures", "[app]") {
  const temporary_folder folder;
  const json one = rows_of(
      run_bitshade(with(small, {"--threads", "1", "--json", "--out", (folder / "one").string()})));
  run_options german;
  german.environment = {"LC_ALL=de_DE.UTF-8", "LANG=de_DE.UTF-8"};
  const json two = rows_of(run_bitshade(
      with(small, {"--threads", "2", "--json", "--out", (folder / "two").string()}), german));
  CHECK(one == two);
  std::size_t compared = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "one/pictures")) {
    CAPTURE(entry.path().filename());
    CHECK(contents(entry.path()) == contents(folder / "two/pictures" / entry.path().filename()));
    ++compared;
  }
  CHECK(compared >= 40);
}

TEST_CASE("finished cells are not computed again, and others are", "[app]") {
  const temporary_folder folder;
  const std::vector<std::string> arguments = with(
      small, {"--layers", "2", "--formats", "half,binary32", "--out", (folder / "out").string()});
  CHECK(run_bitshade(arguments).out.find("4 of 4 cells computed") != std::string::npos);
  CHECK(run_bitshade(arguments).out.find("0 of 4 cells computed") != std::string::npos);
  const outcome more = run_bitshade(with(
      small, {"--layers", "2", "--formats", "half,unorm16", "--out", (folder / "out").string()}));
  CHECK(more.out.find("2 of 4 cells computed") != std::string::npos);
  const outcome other = run_bitshade(with(arguments, {"--min-variance", "1e-4"}));
  CHECK(other.out.find("4 of 4 cells computed") != std::string::npos);
}

TEST_CASE("a plan is verified against everything, and the saving is printed", "[app]") {
  const temporary_folder folder;
  const outcome o =
      run_bitshade(with(small, {"--verify-plan", "--transition", "--filter", "trilinear",
                                "--anisotropy", "4", "--layers", "1,3", "--formats",
                                "half,unorm16,exact", "--out", (folder / "out").string()}));
  INFO(o.err);
  CHECK(o.status == 0);
  CHECK(o.out.find("Plan verified: 9 of 9 cells") != std::string::npos);
  CHECK(o.out.find("saved") != std::string::npos);
}

TEST_CASE("a mesh and a depth map that bitshade wrote are studied", "[app]") {
  const temporary_folder folder;
  write(folder / "pyramid.obj",
        "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv 0 1.5 0\n"
        "f 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n");
  const outcome depth = run_bitshade({"depth", "garden", "--size", "64", "--view", "64x40", "--out",
                                      (folder / "depth.exr").string()});
  INFO(depth.err);
  REQUIRE(depth.status == 0);
  const auto study = [&](const std::string& file, std::vector<std::string> more) {
    std::vector<std::string> arguments{"study",     (folder / file).string(), "--layers",
                                       "2",         "--techniques",           "lvsm",
                                       "--formats", "unorm16,exact",          "--json",
                                       "--out",     (folder / "out").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const json rows = rows_of(run_bitshade(arguments));
    REQUIRE(rows.size() == 2);
    for (const json& r : rows) CHECK(r.at("receivers") > 0);
    return rows[0].at("input");
  };
  CHECK(study("pyramid.obj", {"--size", "64", "--view", "64x40"}) != study("depth.exr", {}));
  CHECK(std::filesystem::exists(folder / "out/pictures/pyramid-lvsm2-unorm16-error.png"));
  CHECK(std::filesystem::exists(folder / "out/pictures/depth-lvsm2-exact-visibility.png"));
}

TEST_CASE("render draws one configuration, and plan says what it needs", "[app]") {
  const temporary_folder folder;
  const outcome drawn =
      run_bitshade({"render", "garden", "--size", "64", "--view", "64x40", "--json", "--format",
                    "half", "--out", (folder / "out").string()});
  INFO(drawn.err);
  REQUIRE(drawn.status == 0);
  const json files = json::parse(drawn.out).at("files");
  CHECK(files.size() == 5);
  for (const auto& [name, path] : files.items()) {
    CAPTURE(name);
    CHECK(contents(path.get<std::string>()).starts_with("\x89PNG"));
  }
  const outcome two = run_bitshade({"render", "garden", "--layers", "1,2"});
  CHECK(two.status == 2);

  const outcome planned = run_bitshade(
      {"plan", "garden", "--size", "64", "--view", "64x40", "--layers", "2", "--json"});
  INFO(planned.err);
  REQUIRE(planned.status == 0);
  const json plans = json::parse(planned.out).at("plans");
  REQUIRE(plans.size() == 8);
  for (const json& p : plans) {
    CHECK(p.at("effects").size() == 6);
    for (const json& e : p.at("effects")) CHECK(!e.at("evidence").get<std::string>().empty());
  }
}

TEST_CASE("shards computed apart and merged are the whole study", "[app]") {
  const temporary_folder folder;
  const auto sorted = [](json rows) {
    std::sort(rows.begin(), rows.end(),
              [](const json& a, const json& b) { return a.at("key") < b.at("key"); });
    return rows;
  };
  const std::vector<std::string> study = with(small, {"--layers", "2", "--json"});
  const json whole = rows_of(run_bitshade(with(study, {"--out", (folder / "whole").string()})));
  REQUIRE(whole.size() == 8);
  std::size_t parts = 0;
  for (const char* shard : {"1/3", "2/3", "3/3"}) {
    const std::string out = (folder / ("part" + std::string(shard, 1))).string();
    parts += rows_of(run_bitshade(with(study, {"--shard", shard, "--out", out}))).size();
  }
  CHECK(parts == 8);
  const std::vector<std::string> merge{"merge",
                                       (folder / "part1").string(),
                                       (folder / "part2").string(),
                                       (folder / "part3").string(),
                                       "--json",
                                       "--out",
                                       (folder / "all").string()};
  CHECK(sorted(rows_of(run_bitshade(merge))) == sorted(whole));
  CHECK(sorted(rows_of(run_bitshade(merge))) == sorted(whole));  // twice changes nothing
  CHECK(run_bitshade({"study", "--shard", "4/3"}).status == 2);
  CHECK(run_bitshade({"merge", (folder / "nothing").string()}).status == 1);
}

TEST_CASE("a reader that leaves and a full device are told apart", "[app]") {
  const temporary_folder folder;
  run_options full;
  full.standard_output = "/dev/full";
  const outcome failed =
      run_bitshade(with(small, {"--layers", "1", "--techniques", "vsm", "--formats", "half",
                                "--out", (folder / "out").string()}),
                   full);
  CHECK(failed.status == 1);
  CHECK(failed.err.find("standard output") != std::string::npos);
  // The shell's pipe: its reader is gone at once.
  const outcome left = run_program(
      {"bash", "-c", std::string("set -o pipefail; ") + BITSHADE_COMMAND + " --help | true"});
  CHECK(left.status == 0);
  CHECK(left.err.empty());
}

TEST_CASE("study --json holds what --blame and --precision found, as results.json does") {
  const temporary_folder folder;
  const auto done =
      run_bitshade({"study", "garden", "--size", "48", "--view", "32x20", "--techniques",
                    "vsm,savsm", "--formats", "half", "--min-variance", "1e-4", "--blame",
                    "--precision", "--json", "--out", folder.path().string()});
  CAPTURE(done.err);
  REQUIRE(done.status == 0);
  const json found = json::parse(done.out);
  CHECK(json::parse(contents(folder.path() / "results.json")) == found);
  const json& parts = found["inputs"][0]["parts"];
  // Sums of 2304 texels in half drift farther than anything that a vsm does.
  CHECK(parts["blame"]["configuration"].get<std::string>().starts_with("savsm"));
  double shares = 0;
  std::string stages;
  for (const auto& s : parts["blame"]["stages"]) {
    shares += s["share"].get<double>();
    stages += s["stage"].get<std::string>() + " ";
  }
  CHECK(shares == Approx(1));
  CHECK(stages == "store sums filter shading ");
  CHECK(parts["blame"]["whole"]["rmse"] == found["rows"][1]["format_error_rmse"]);
  CHECK(parts["precision"]["curves"].size() == 2);
  CHECK(parts["precision"]["on_scene"].size() == 7);  // the vsm's store, six of savsm
  CHECK(parts["precision"]["command"].get<std::string>().find("--techniques lvsm,savsm") !=
        std::string::npos);

  const auto plain = run_bitshade({"study", "garden", "--size", "48", "--view", "32x20",
                                   "--techniques", "vsm", "--formats", "half", "--json", "--out",
                                   folder.path().string()});
  REQUIRE(plain.status == 0);
  CHECK_FALSE(json::parse(plain.out)["inputs"][0].contains("parts"));
}
