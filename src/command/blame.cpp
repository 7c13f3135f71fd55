// `bitshade blame`: which stage is guilty of a format's error.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "command/commands.hpp"
#include "command/format_options.hpp"
#include "command/option_use.hpp"
#include "command/scene_options.hpp"
#include "command/study_options.hpp"
#include "io/atomic_file.hpp"
#include "io/build.hpp"
#include "io/error.hpp"
#include "io/text.hpp"
#include "report/blame.hpp"
#include "report/cell_pictures.hpp"
#include "report/plot.hpp"
#include "report/text_table.hpp"
#include "run/blame.hpp"
#include "run/study.hpp"

namespace bitshade::command {
namespace {

struct options {
  std::string scene = "garden";
  std::shared_ptr<scene_options> how;
  std::shared_ptr<study_options> cell;
  std::string out = "bitshade-out";
  std::string shading, arguments;
  int weight_bits = 0;
  bool json = false;
};

stage_choices choices_of(const options& given) {
  stage_choices choices;
  if (given.weight_bits < 0 || given.weight_bits > 23) {
    throw usage_error("--weight-bits " + std::to_string(given.weight_bits) +
                      " is outside 0 to 23: devices have 8, and 0 leaves the arithmetic's own");
  }
  choices.weight_bits = given.weight_bits;
  if (!given.shading.empty()) {
    const auto format = choose_format(given.shading);
    if (format.components.size() != 1) {
      throw usage_error("--shading " + given.shading + " is no format of one number: half, say");
    }
    choices.shading = format.components.front();
  }
  return choices;
}

std::string text_of(const blame& b, const configuration& c) {
  std::vector<text_line> lines{
      {"stage", "alone: rmse", "largest", "p99.9", "share", "all but it: rmse", "largest"}};
  const auto all = [&](const error_figures& e) {
    return text_line{brief(e.rmse), brief(e.largest), brief(e.p999)};
  };
  for (const stage_blame& s : b.stages) {
    const text_line alone = all(s.alone);
    lines.push_back({std::string(name_of(s.which)), alone[0], alone[1], alone[2],
                     percent(b.share(s)) + " %", brief(s.without.rmse), brief(s.without.largest)});
  }
  const text_line whole = all(b.whole);
  lines.push_back({"all of them", whole[0], whole[1], whole[2], "", "", ""});
  std::string out = label_of(c) + ": error against exact arithmetic, stage by stage\n" +
                    text_table(lines, {0}) + "\n";
  for (const auto& line : wrap(blame_sentence(b), 80)) out += line + "\n";
  return out;
}

void find_guilt(const options& given) {
  const std::vector<configuration> cells = given.cell->cells();
  if (cells.size() != 1) {
    throw usage_error("blame takes one configuration apart, but these options name " +
                      std::to_string(cells.size()) +
                      ": give one technique, one format and one layer count");
  }
  const configuration& c = cells.front();
  const stage_choices choices = choices_of(given);
  check_use(*given.cell->app, cells, measured::alone);
  if (given.weight_bits > 0 && (!blurs_its_map(c.method) || c.filter != texel_filter::bilinear ||
                                c.max_anisotropy > 1)) {
    throw usage_error("--weight-bits is for plain bilinear lookups: leave out --filter, "
                      "--anisotropy and savsm, or --weight-bits");
  }
  const frame input = load_for(given.scene, *given.how, cells);
  check_study_memory(input, cells);
  const blame b = blame_of(input, c, choices, given.how->threads);
  cell_pictures pictures(given.out, given.scene, c);

  const std::string command = "bitshade blame " + shell_quoted(given.scene) + given.arguments;
  const auto maps = blame_maps(b, input.view_width, input.view_height);
  for (const auto& [name, png] : maps) pictures.add("blame-" + name, "", png);
  const report_head head{command, program_version(), compiler_description(), machine_description(),
                         std::to_string(given.how->seed)};
  const report_part part = blame_part(b, maps, label_of(c), c.format, command);
  const std::string page = pictures.path_of("blame", ".html");
  write_file(page, html_page(head, part.title,
                             "<main><p>" + escaped(part.text) + "</p>" + part.body + "</main>\n"));
  nlohmann::ordered_json files = pictures.files();
  files["report"] = page;

  if (given.json) {
    nlohmann::ordered_json all{{"scene", given.scene},
                               {"configuration", c.key()},
                               {"weight_bits", given.weight_bits},
                               {"shading", given.shading}};
    all.update(blame_json(b));
    all["files"] = files;
    std::cout << all.dump(1) << '\n';
    return;
  }
  std::cout << text_of(b, c) << "Maps and bars:\n" << pictures.list() << "  " << page << '\n';
}

}  // namespace

void add_blame(CLI::App& app) {
  auto given = std::make_shared<options>();
  CLI::App* command = app.add_subcommand(
      "blame",
      "Which stage is guilty of how much of a format's error\n"
      "Runs one configuration with each stage alone in the format and with each stage alone exact: "
      "Lloyd's reduction, store, resolve, blur, mips, a summed-area table's running sums, filter "
      "weights, filter, shading. A table here; bars and maps of each stage's error as PNG and HTML "
      "in the folder of --out.");
  command->add_option("SCENE", given->scene, scene_argument_help())->capture_default_str();
  study_options initial;
  initial.techniques = "vsm";
  initial.formats = "unorm16";
  initial.layers = "2";
  given->cell = add_study_options(*command, initial);
  given->how = add_scene_options(*command);
  command
      ->add_option("--weight-bits", given->weight_bits,
                   "Bits of bilinear fractions; devices have 8, 0: as computed")
      ->capture_default_str()
      ->option_text("N");
  command
      ->add_option("--shading", given->shading,
                   "Arithmetic that shades, such as half; else as computed")
      ->option_text("FORMAT");
  command->add_option("--out", given->out, "Folder for the maps")
      ->capture_default_str()
      ->option_text("DIR");
  command->add_flag("--json", given->json, "Print JSON instead of text");
  command->footer(
      "Examples:\n"
      "  bitshade blame garden --technique vsm --format unorm16\n"
      "  bitshade blame slope --technique lvsm --layers 4 --weight-bits 8 --shading half");
  command->callback([given, command] {
    given->arguments = arguments_of(*command, {"json", "out"});
    find_guilt(*given);
  });
}

}  // namespace bitshade::command
