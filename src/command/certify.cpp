// `bitshade certify`: intervals that certainly hold what exact arithmetic would give.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "command/commands.hpp"
#include "command/option_use.hpp"
#include "command/scene_options.hpp"
#include "command/study_options.hpp"
#include "io/error.hpp"
#include "io/text.hpp"
#include "report/cell_pictures.hpp"
#include "report/maps.hpp"
#include "report/text_table.hpp"
#include "run/certify.hpp"
#include "run/study.hpp"

namespace bitshade::command {
namespace {

struct options {
  std::string scene = "garden";
  std::shared_ptr<scene_options> how;
  std::shared_ptr<study_options> cell;
  std::string out = "bitshade-out";
  bool json = false;
};

struct width_figures {
  double median = 0, p999 = 0, largest = 0;
};

width_figures widths_of(const std::vector<light_interval>& intervals) {
  std::vector<double> widths;
  for (const light_interval& i : intervals) {
    if (i.low == i.low) widths.push_back(i.width());
  }
  if (widths.empty()) return {};
  std::sort(widths.begin(), widths.end());
  const auto at = [&](std::size_t share) {
    return widths[(widths.size() * share + 999) / 1000 - 1];
  };
  return {at(500), at(999), widths.back()};
}

nlohmann::ordered_json json_of(const width_figures& w) {
  return {{"median", w.median}, {"p999", w.p999}, {"largest", w.largest}};
}

void certify_scene(const options& given) {
  const std::vector<configuration> cells = given.cell->cells();
  if (cells.size() != 1) {
    throw usage_error("certify takes one configuration, but these options name " +
                      std::to_string(cells.size()) +
                      ": give one technique, one format and one layer count");
  }
  const configuration& c = cells.front();
  check_use(*given.cell->app, cells, measured::alone);
  const frame input = load_for(given.scene, *given.how, cells);
  check_study_memory(input, cells);
  const certificates all = certify(input, c, given.how->threads);
  const width_figures global = widths_of(all.global), stored = widths_of(all.stored),
                      running = widths_of(all.running);

  cell_pictures pictures(given.out, given.scene, c);
  std::vector<double> widths, nothing(all.running.size(), 0.0);
  for (const light_interval& i : all.running) widths.push_back(i.low == i.low ? i.width() : 0);
  pictures.add("certificate", "widths of the last",
               error_map(widths, nothing, input.view_width, input.view_height));

  if (given.json) {
    std::cout << nlohmann::ordered_json{{"scene", given.scene},       {"configuration", c.key()},
                                        {"roundings", all.roundings}, {"global", json_of(global)},
                                        {"stored", json_of(stored)},  {"running", json_of(running)},
                                        {"files", pictures.files()}}
                     .dump(1)
              << '\n';
    return;
  }
  const auto line = [](const std::string& name, const width_figures& w) {
    return text_line{name, brief(w.median), brief(w.p999), brief(w.largest)};
  };
  std::cout << label_of(c) << ": widths of the intervals that hold the exact visibility\n"
            << text_table({{"certificate from", "median", "p99.9", "largest"},
                           line("the format alone, " + std::to_string(all.roundings) +
                                    (all.roundings == 1 ? " rounding" : " roundings"),
                                global),
                           line("the stored moments", stored),
                           line("the roundings that happened", running)},
                          {0})
            << pictures.list();
}

}  // namespace

void add_certify(CLI::App& app) {
  auto given = std::make_shared<options>();
  CLI::App* command = app.add_subcommand(
      "certify",
      "Intervals that certainly hold the exact visibility\n"
      "Says how far each pixel of a vsm, savsm or lvsm in a format can lie from exact arithmetic, "
      "from the format's own numbers and without an exact run: from the format alone, from the "
      "moments as stored, and from the roundings that really happened, those of a summed-area "
      "table's sums included. Draws the widths as PNG.");
  command->add_option("SCENE", given->scene, scene_argument_help())->capture_default_str();
  study_options initial;
  initial.techniques = "vsm";
  initial.formats = "unorm16";
  initial.layers = "2";
  given->cell = add_study_options(*command, initial);
  given->how = add_scene_options(*command);
  command->add_option("--out", given->out, "Folder for the picture")
      ->capture_default_str()
      ->option_text("DIR");
  command->add_flag("--json", given->json, "Print JSON instead of text");
  command->footer(
      "Examples:\n"
      "  bitshade certify garden --technique vsm --format unorm16\n"
      "  bitshade certify slope --technique lvsm --layers 4 --format half --min-variance 1e-4");
  command->callback([given] { certify_scene(*given); });
}

}  // namespace bitshade::command
