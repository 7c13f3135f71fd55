// `bitshade plan`: which effects a scene calls for, with the evidence.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "command/commands.hpp"
#include "command/option_use.hpp"
#include "command/scene_options.hpp"
#include "command/study_options.hpp"
#include "io/text.hpp"
#include "report/summary.hpp"
#include "run/listing.hpp"
#include "run/pipeline.hpp"

namespace bitshade::command {
namespace {

struct options {
  std::string scene = "garden";
  std::shared_ptr<scene_options> how;
  std::shared_ptr<study_options> cells;
  bool json = false;
};

void print_plan(const options& given) {
  const std::vector<configuration> cells = given.cells->cells();
  const auto notes = check_use(*given.cells->app, cells, measured::alone);
  const frame input = load_for(given.scene, *given.how, cells);
  std::vector<row> rows;
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const configuration& c : cells) {
    const plan p = make_plan(input, c, given.how->threads);
    row r;
    r.scene = given.scene;
    r.technique = name_of(c.method);
    r.format = c.format;
    r.layers = c.method == technique::lvsm ? c.layers : 1;
    r.splits = p.splits;
    r.effects = p.effects;
    auto object = nlohmann::ordered_json::parse(lists_of(r));
    object.erase("notes");
    object["layer_users"] = p.layer_users;
    all.push_back({{"technique", r.technique}, {"format", r.format}, {"layers", r.layers}});
    all.back().update(object);
    rows.push_back(std::move(r));
  }
  if (given.json) {
    std::cout << nlohmann::ordered_json{{"scene", given.scene}, {"plans", all}}.dump(1) << '\n';
    return;
  }
  std::cout << text_effects(rows);
  print_notes(notes);
}

}  // namespace

void add_plan(CLI::App& app) {
  auto given = std::make_shared<options>();
  CLI::App* command = app.add_subcommand(
      "plan",
      "Which effects a scene calls for, with the evidence\n"
      "Says of overlap, transition, mips, anisotropy, subnormals and layers without receivers "
      "whether they can change a pixel of this scene in these configurations; a study leaves out "
      "those that cannot, and 'bitshade study --verify-plan' shows that the bits stay the same.");
  command->add_option("SCENE", given->scene, scene_argument_help())->capture_default_str();
  given->cells = add_study_options(*command, {});
  given->how = add_scene_options(*command);
  command->add_flag("--json", given->json, "Print JSON instead of text");
  command->footer(
      "Example:\n"
      "  bitshade plan garden --layers 2,4 --filter trilinear --anisotropy 8");
  command->callback([given] { print_plan(*given); });
}

}  // namespace bitshade::command
