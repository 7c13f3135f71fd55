// render --animate: a numbered series, the splits' path, and going on where a run was stopped.
#include <filesystem>
#include <nlohmann/json.hpp>

#include "io/text.hpp"
#include "support/catch.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

using namespace bitshade;
using namespace bitshade::test;
using nlohmann::json;

namespace {

std::vector<std::string> series(const std::string& out, std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{"render",   "beams", "--size",    "64",    "--view",
                                     "64x40",    "--layers", "4",      "--splits", "lloyd",
                                     "--lloyd-splits", "2",  "--animate", "4",  "--out", out};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

}  // namespace

TEST_CASE("a series is numbered pictures, a table and a plot, and goes on where it was", "[app]") {
  const temporary_folder folder;
  const std::string out = (folder / "out").string();
  const outcome first = run_bitshade(series(out));
  INFO(first.err);
  REQUIRE(first.status == 0);
  CHECK(first.out.find("4 computed, 0 taken") != std::string::npos);
  for (const char* kind : {"shaded", "layers", "visibility", "error", "format-error"})
    for (const char* number : {"0000", "0001", "0002", "0003"}) {
      const std::string name = std::string("beams-lvsm4-unorm16-") + number + "-" + kind + ".png";
      CAPTURE(name);
      CHECK(contents(folder / "out" / name).starts_with("\x89PNG"));
    }
  CHECK(contents(folder / "out/beams-lvsm4-unorm16-splits.svg")
            .starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\""));

  const std::string table = contents(folder / "out/beams-lvsm4-unorm16-series.csv");
  const auto lines = split(table, '\n');
  REQUIRE(lines.size() == 6);  // a head, four frames and the end
  for (std::size_t k = 1; k <= 4; ++k) {
    const auto values = split(lines[k], ',');
    REQUIRE(values.size() == split(lines[0], ',').size());
    double before = 0;
    for (std::size_t i = 2; i < 5; ++i) {  // three splits, in order and inside
      const double s = std::stod(values[i]);
      CHECK((s >= before && s <= 1));
      before = s;
    }
    CHECK(std::stod(values[7]) >= std::stod(values[8]));  // no cost under the least
  }
  // The beams turn: their pictures differ.
  CHECK(contents(folder / "out/beams-lvsm4-unorm16-0000-shaded.png") !=
        contents(folder / "out/beams-lvsm4-unorm16-0001-shaded.png"));

  // Half of the frames are lost; what comes back is the same on another number of threads.
  const auto lost = folder / "out/beams-lvsm4-unorm16-0002-shaded.png";
  const std::string picture = contents(lost);
  std::filesystem::remove(lost);
  const outcome again = run_bitshade(series(out, {"--threads", "1"}));
  CHECK(again.out.find("0 computed, 4 taken") != std::string::npos);
  CHECK(contents(lost) == picture);
  CHECK(contents(folder / "out/beams-lvsm4-unorm16-series.csv") == table);
  CHECK(run_bitshade(series((folder / "alone").string(), {"--threads", "1"})).status == 0);
  CHECK(contents(folder / "alone/beams-lvsm4-unorm16-series.csv") == table);
  CHECK(contents(folder / "alone/beams-lvsm4-unorm16-0002-shaded.png") == picture);
}

TEST_CASE("a light moves there and back", "[app]") {
  const temporary_folder folder;
  const outcome o = run_bitshade({"render", "planes", "--size", "48", "--view", "48x30",
                                  "--technique", "vsm", "--light-to", "0.5,-1,0.2", "--animate",
                                  "4", "--json", "--out", (folder / "out").string()});
  INFO(o.err);
  REQUIRE(o.status == 0);
  CHECK(json::parse(o.out).at("frames").size() == 4);
  const auto picture = [&](const char* number) {
    return contents(folder / "out" /
                    ("planes-vsm-unorm16-" + std::string(number) + "-visibility.png"));
  };
  CHECK(picture("0000") != picture("0002"));
  CHECK(picture("0001") == picture("0003"));  // planes, too, are where they were: there and back
}

TEST_CASE("what cannot move says so", "[app]") {
  const temporary_folder folder;
  const auto refused = [&](std::vector<std::string> arguments, const std::string& why) {
    arguments.insert(arguments.begin(), "render");
    const outcome o = run_bitshade(arguments);
    CAPTURE(o.err, why);
    CHECK(o.status == 2);
    CHECK(o.err.find(why) != std::string::npos);
  };
  refused({"garden", "--light-to", "1,-1,0"}, "--animate");
  refused({"garden", "--animate", "2", "--param", "animation=0.5"}, "animation");
  refused({"garden", "--animate", "0"}, "--animate");
  refused({"garden", "--steps", "2"}, "--animate");
  write(folder / "flat.pfm", "Pf\n1 1\n-1\n" + std::string("\0\0\0\x3f", 4));
  refused({(folder / "flat.pfm").string(), "--animate", "2"}, "does not move");
}

TEST_CASE("render prints Lloyd's cost against the optimum, for all and for two a frame", "[app]") {
  const temporary_folder folder;
  const std::vector<std::string> arguments{"render", "beams", "--size",   "64",    "--view",
                                           "64x40",  "--layers", "5",     "--splits", "lloyd",
                                           "--out",  (folder / "out").string()};
  const outcome o = run_bitshade(arguments);
  INFO(o.err);
  REQUIRE(o.status == 0);
  CHECK(o.out.find("all a frame") != std::string::npos);
  CHECK(o.out.find("two a frame") != std::string::npos);
  auto as_json = arguments;
  as_json.push_back("--json");
  const json all = json::parse(run_bitshade(as_json).out);
  REQUIRE(all.at("lloyd").size() == 2);
  for (const json& way : all.at("lloyd"))
    CHECK(way.at("cost").get<double>() >= way.at("least_cost").get<double>());
}

TEST_CASE("every choice of Lloyd relaxation has a bad value that is refused", "[app]") {
  for (const auto& [option, value] : std::vector<std::pair<std::string, std::string>>{
           {"--lloyd-weights", "0.1"},
           {"--lloyd-weights", "0.1,0.01"},
           {"--lloyd-splits", "none"},
           {"--lloyd-sums", "haff"},
           {"--lloyd-latency", "-1"},
           {"--lloyd-teleport", "on"},
           {"--lloyd-scope", "some"},
           {"--lloyd-hysteresis", "1"},
           {"--lloyd-measure", "time"},
           {"--lloyd-rest", "-1"},
           {"--lloyd-frames", "0"}}) {
    const outcome o = run_bitshade({"render", "garden", "--splits", "lloyd", option, value});
    CAPTURE(option, value, o.err);
    CHECK(o.status == 2);
    CHECK(split(o.err, '\n').size() <= 3);
  }
}
