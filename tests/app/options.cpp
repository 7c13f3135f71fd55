// No option is taken and then ignored: each one concerns a technique or is refused.
#include <CLI/CLI.hpp>
#include <map>

#include "command/option_use.hpp"
#include "command/study_options.hpp"
#include "support/catch.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

using namespace bitshade;
using namespace bitshade::command;
using namespace bitshade::test;

namespace {

/// A value of each option that is not its default.
const std::map<std::string, std::string> other_values{
    {"layers", "5"}, {"splits", "lloyd-view"}, {"overlap", "0.03"}, {"transition", ""},
    {"lookup", "every"}, {"layer-warp", "unclamped"}, {"direct-index", ""}, {"min-width", "0.01"},
    {"one-pass", ""}, {"lloyd-weights", "1e-5,0.02"}, {"lloyd-splits", "2"}, {"lloyd-sums", "half"},
    {"lloyd-latency", "3"}, {"lloyd-teleport", "costly-half"}, {"lloyd-scope", "frame"},
    {"lloyd-hysteresis", "0.1"}, {"lloyd-measure", "cost"}, {"lloyd-rest", "0.001"},
    {"lloyd-frames", "50"}, {"msaa", "4"}, {"blur", "5"}, {"blur-sigma", "1"},
    {"blur-shape", "box"}, {"blur-way", "one-pass"}, {"blur-fraction-bits", "4"}, {"lookups", "3"},
    {"filter", "nearest"}, {"anisotropy", "4"}, {"smallest-box", "3"}, {"depth-bias", "0.001"}, {"min-variance", "1e-4"},
    {"noise-floor", ""}, {"slope-term", ""}, {"second-moment", "centred"},
    {"bleeding-reduction", "0.2"}, {"bleeding-power", "1.3"}, {"bleeding-lift", "0.65"},
    {"exponent", "4"}, {"negative-exponent", "3"}, {"terms", "6"}, {"moment-bias", "1e-4"},
    {"basis", "dense"}, {"moment-bound", "hausdorff"}};

configuration parsed(std::vector<std::string> arguments) {
  CLI::App app;
  const auto options = add_study_options(app, {});
  std::reverse(arguments.begin(), arguments.end());
  app.parse(arguments);
  const auto cells = options->cells();
  REQUIRE(cells.size() == 1);
  return cells.front();
}

bool names(const std::vector<std::string>& arguments, const std::string& option) {
  for (const auto& a : arguments)
    if (a == "--" + option || a.starts_with("--" + option + "=")) return true;
  return false;
}

}  // namespace

TEST_CASE("an option is said to be used exactly where it changes a run's identity", "[app]") {
  CLI::App app;
  const auto keep = add_study_options(app, {});
  // What other options depend on: several layers, splits by relaxation, fractions of a blur.
  const std::vector<std::vector<std::string>> bases{
      {}, {"--layers=3"}, {"--layers=3", "--splits=lloyd"}, {"--layers=3", "--splits=optimal"},
      {"--layers=3", "--splits=lloyd", "--lloyd-teleport=off"}, {"--blur-way=linear"},
      {"--blur=0"}, {"--blur-shape=box"}};
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_lnames().empty()) continue;
    const std::string name = option->get_lnames().front();
    if (name == "help" || name == "techniques" || name == "formats") continue;
    INFO(name);
    REQUIRE(other_values.contains(name));  // a new option: say here what it could be
    const std::string& value = other_values.at(name);
    for (const auto technique : technique_names) {
      for (auto base : bases) {
        base.push_back("--technique=" + std::string(technique));
        base.push_back("--format=unorm16");
        if (!names(base, "layers")) base.push_back("--layers=1");
        if (names(base, name) && name != "layers") continue;
        if (name == "direct-index" && names(base, "splits")) continue;  // refused together
        auto with = base;
        std::erase_if(with, [&](const auto& a) { return a.starts_with("--" + name + "="); });
        with.push_back(value.empty() ? "--" + name : "--" + name + "=" + value);
        const configuration before = parsed(base), after = parsed(with);
        CAPTURE(before.key(), after.key());
        CHECK(is_used(name, after, measured::alone) == (before.key() != after.key()));
        if (!is_used(name, after, measured::alone)) CHECK_FALSE(users_of(name).empty());
      }
    }
  }
}

TEST_CASE("options that concern no cell are refused by every command, with whom they are for") {
  const auto refused = [](std::vector<std::string> arguments, const std::string& words) {
    const auto done = run_bitshade(arguments);
    CAPTURE(arguments, done.err);
    CHECK(done.status == 2);
    CHECK(done.err.find(words) != std::string::npos);
  };
  refused({"render", "planes", "--technique", "msm", "--slope-term"},
          "--slope-term is for techniques with a variance");
  refused({"render", "planes", "--technique", "vsm", "--exponent", "8"},
          "--exponent is for esm, evsm2 and evsm4");
  refused({"render", "planes", "--technique", "vsm", "--smallest-box", "3"}, "is for savsm");
  refused({"render", "planes", "--technique", "vsm", "--animate", "2", "--steps", "2"},
          "--steps are of Lloyd relaxation");
  refused({"study", "planes", "--techniques", "vsm,esm", "--terms", "8"}, "--terms is for csm");
  refused({"plan", "planes", "--techniques", "pcf", "--anisotropy", "4"}, "is for techniques whose");
  refused({"blame", "planes", "--technique", "vsm", "--overlap", "0.1"}, "is for lvsm");
  refused({"blame", "planes", "--weight-bits", "8", "--filter", "trilinear"}, "plain bilinear");
  refused({"certify", "planes", "--technique", "vsm", "--one-pass"}, "--one-pass is for lvsm");
  refused({"precision", "--size", "64"}, "give a SCENE");
  refused({"precision", "planes", "--reach", "0.1"}, "--joint");
  refused({"precision", "planes", "--roundings", "2"}, "--adversarial");
  const temporary_folder folder;
  write(folder / "grid.json",
        R"({"product": {"technique": ["vsm", "evsm4"], "format": "half", "terms": [4, 8]}})");
  refused({"study", "planes", "--grid", (folder / "grid.json").string()}, "'terms' is for csm");
}

TEST_CASE("a list of techniques is told which of them an effect leaves as they are", "[app]") {
  const auto done = run_bitshade(
      {"plan", "planes", "--size", "16", "--view", "16x10", "--techniques", "vsm,msm,esm",
       "--formats", "half", "--slope-term"});
  CAPTURE(done.out, done.err);
  CHECK(done.status == 0);
  CHECK(done.out.find("Note: --slope-term changes nothing in msm, esm.") != std::string::npos);
}

TEST_CASE("study runs every technique in every format, and the command of each cell is taken",
          "[app]") {
  const temporary_folder folder;
  const auto done = run_bitshade(
      {"study", "planes", "--size", "16", "--view", "24x15", "--techniques",
       "hard,pcf,vsm,savsm,lvsm,evsm2,evsm4,esm,csm,msm,deep", "--formats",
       "unorm8,unorm16,half,bfloat16,e5m7,fixed8.16,binary32,exact", "--exponent", "2",
       "--negative-exponent", "2", "--layers", "1,4", "--one-pass", "--slope-term",
       "--bleeding-reduction", "0.1", "--no-pictures", "--out", folder.path().string()});
  CAPTURE(done.err);
  REQUIRE(done.status == 0);
  CHECK(done.out.find("96 of 96 cells") != std::string::npos);
  CHECK(done.out.find("nan") == std::string::npos);
  for (const auto technique : technique_names) {
    const auto drawn = run_bitshade({"render", "planes", "--size", "16", "--view", "24x15",
                                     "--technique", std::string(technique), "--format", "half",
                                     "--out", folder.path().string()});
    CAPTURE(std::string(technique), drawn.err);
    CHECK(drawn.status == 0);
  }
}
