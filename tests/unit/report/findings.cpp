// What a study says in words: computed from its rows, each sentence once.
#include <algorithm>

#include "io/text.hpp"
#include "report/plot.hpp"
#include "report/summary.hpp"
#include "support/catch.hpp"

using namespace bitshade;

namespace {

row cell(const std::string& technique, int layers, const std::string& format, int bytes,
         const std::string& settings, double difference) {
  row r;
  r.technique = technique;
  r.layers = layers;
  r.format = format;
  r.configuration = technique + " format=" + format +
                    (technique == "lvsm" ? " layers=" + std::to_string(layers) + " splits=uniform" : "") +
                    settings;
  r.bytes_per_texel = bytes;
  r.vsm_difference.count = 100;
  r.vsm_difference.p999 = r.vsm_difference.largest = difference;
  r.figures.format.p999 = r.figures.format.largest = difference;
  return r;
}

}  // namespace

TEST_CASE("the headline: the cheapest that matches a binary32 VSM, else the nearest", "[report]") {
  std::vector<row> rows{cell("vsm", 1, "binary32", 8, "", 0), cell("vsm", 1, "unorm16", 4, "", 0.02),
                        cell("lvsm", 2, "unorm16", 8, "", 0.003),
                        cell("lvsm", 4, "unorm16", 16, "", 0.001)};
  rows[0].figures.total.rmse = 0.25;
  rows[2].figures.total.rmse = 0.125;
  CHECK(headline(rows) ==
        "Two uniform unorm16 layers match a binary32 VSM on this scene to within 3.00e-3 at 99.9 % "
        "of the pixels (3.00e-3 at most), in 8 bytes a texel, as many as its own; against the truth "
        "they err by 0.125 RMSE, that by 0.250.");
  rows[2].vsm_difference.p999 = 0.1;
  CHECK(headline(rows).starts_with("Four uniform unorm16 layers match"));
  rows[3].vsm_difference.p999 = 0.2;
  CHECK(headline(rows).starts_with("A VSM in unorm16 comes within 0.0200 of a binary32 VSM"));
  CHECK(findings(rows).front() == headline(rows));
  CHECK(headline(std::span(rows).first(1)).empty());
}

TEST_CASE("findings tell cells of one name apart, and say nothing twice", "[report]") {
  std::vector<row> rows{cell("vsm", 1, "binary32", 8, " min-variance=1e-05", 0)};
  for (int i = 0; i < 200; ++i) {
    rows.push_back(cell("lvsm", 2, "unorm16", 8, " overlap=0." + std::to_string(100 + i), 0.001 * i));
    rows.back().figures.bleed_area = 0.001 * i;
  }
  std::vector<std::string> said = findings(rows);
  CHECK(said.size() < 10);
  bool named = false;
  for (const std::string& s : said) {
    CAPTURE(s);
    CHECK(std::count(said.begin(), said.end(), s) == 1);
    // A name without its setting would be that of 200 cells.
    for (std::size_t at = 0; (at = s.find("LVSM with 2 layers in unorm16", at)) != std::string::npos;
         at += 4)
      CHECK(s.substr(at + 29).starts_with(" (overlap 0."));
    named = named || s.find("(overlap 0.299)") != std::string::npos;
  }
  CHECK(named);
}

TEST_CASE("ticks are short, round and apart", "[report]") {
  for (const double most : {1e-3, 0.00317, 0.07, 1.0, 3.0, 640.0, 12345.0}) {
    const std::string drawn =
        svg(bar_chart{"bars", "unit", {}, {{"a label that takes some room", {most}, ""}}});
    CAPTURE(most, drawn);
    CHECK(drawn.find("0e-") == std::string::npos);  // as in 1.000e-3
    std::size_t ticks = 0;
    for (std::size_t at = 0; (at = drawn.find("class=\"grid\"", at)) != std::string::npos; ++at)
      ++ticks;
    CHECK(ticks >= 3);
    CHECK(ticks <= 9);
  }
}
