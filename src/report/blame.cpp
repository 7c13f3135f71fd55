#include "report/blame.hpp"

#include <algorithm>

#include "io/text.hpp"
#include "report/figures.hpp"
#include "report/html_table.hpp"
#include "report/maps.hpp"
#include "report/plot.hpp"

namespace bitshade {
namespace {

std::string bars_of(const blame& b, const std::string& title) {
  bar_chart chart{title, "RMSE of visibility", {}, {}};
  for (const stage_blame& s : b.stages)
    chart.bars.push_back(
        {std::string(name_of(s.which)) + " alone", {s.alone.rmse}, brief(s.alone.rmse)});
  chart.bars.push_back({"all in the format", {b.whole.rmse}, brief(b.whole.rmse)});
  for (const stage_blame& s : b.stages)
    chart.bars.push_back(
        {"all but " + std::string(name_of(s.which)), {s.without.rmse}, brief(s.without.rmse)});
  return svg(chart);
}

std::string table_of(const blame& b) {
  std::string body;
  for (const stage_blame& s : b.stages)
    body += table_row(word_cell(std::string(name_of(s.which))) + level_cell(s.alone.rmse) +
                      level_cell(s.alone.largest) + level_cell(s.alone.p999) +
                      number_cell(b.share(s), percent(b.share(s))) + level_cell(s.without.rmse) +
                      level_cell(s.without.largest));
  return sortable_table({{"stage", "", true},
                         {"alone: RMSE", "this stage in the format, the others exact"},
                         {"largest", "this stage alone, at the worst pixel"},
                         {"99.9 %", "99.9 % of the pixels have at most this error"},
                         {"share %", "of the summed squares of all stages alone"},
                         {"all but it: RMSE", "this stage exact, the others in the format"},
                         {"largest", "all but it, at the worst pixel"}},
                        body);
}

nlohmann::ordered_json figures_of(const error_figures& e) {
  return {{"rmse", e.rmse}, {"largest", e.largest}, {"p999", e.p999}, {"mean", e.signed_mean}};
}

}  // namespace

nlohmann::ordered_json blame_json(const blame& b) {
  nlohmann::ordered_json stages = nlohmann::ordered_json::array();
  for (const stage_blame& s : b.stages) {
    stages.push_back({{"stage", name_of(s.which)},
                      {"alone", figures_of(s.alone)},
                      {"without", figures_of(s.without)},
                      {"share", b.share(s)}});
  }
  return {{"whole", figures_of(b.whole)}, {"stages", stages}};
}

std::string blame_sentence(const blame& b) {
  if (b.whole.rmse == 0) return "No stage changes a bit of the picture.";
  const stage_blame& worst = b.guiltiest();
  const std::string name(name_of(worst.which));
  const bool several = name.back() == 's';  // sums, mips, weights, splits
  return "The " + name + (several ? " are guilty: alone they make " : " is guilty: alone it makes ") +
         percent(b.share(worst)) + " % of the summed squares; were " +
         (several ? "they" : "it") + " exact, " +
         brief(worst.without.rmse) + " RMSE would be left of " + brief(b.whole.rmse) + ".";
}

std::vector<std::pair<std::string, std::string>> blame_maps(const blame& b, int width, int height) {
  const auto exact = without_gaps(b.exact);
  const auto map = [&](const std::vector<double>& values) {
    return encode_png(error_map(without_gaps(values), exact, width, height));
  };
  std::vector<std::pair<std::string, std::string>> all{{"all", map(b.visibility)}};
  for (const stage_blame& s : b.stages)
    all.emplace_back(std::string(name_of(s.which)), map(s.visibility));
  return all;
}

report_part blame_part(const blame& b, const std::vector<std::pair<std::string, std::string>>& maps,
                       const std::string& label, const std::string& format,
                       const std::string& command) {
  report_part part;
  part.title = "Which stage is guilty: " + label;
  part.text = blame_sentence(b);
  part.finding = "The format error of " + label + ", stage by stage. " + part.text;
  part.body = figure(bars_of(b, "Errors of " + label + ", stage by stage"),
                     caption("Each stage alone in the format, and all but it.",
                             "Against the same run with every stage exact.", command)) +
              table_of(b);
  for (const auto& [name, png] : maps) {
    const auto at = std::find_if(b.stages.begin(), b.stages.end(), [&](const stage_blame& s) {
      return name == std::string(name_of(s.which));
    });
    if (at != b.stages.end() && at->alone.rmse == 0) continue;  // an empty map
    const std::string words = name == "all" ? "Every stage in " + format
                                            : "The " + name + " alone in the format";
    part.body +=
        figure("<img class=\"still\" alt=\"" + escaped(words) + "\" src=\"" + data_uri(png) + "\">",
               caption(words + ".", "Error of visibility against exact arithmetic.", command));
  }
  return part;
}

}  // namespace bitshade
