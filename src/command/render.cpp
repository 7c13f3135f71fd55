// `bitshade render`: one configuration of a scene as pictures.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "command/animate.hpp"
#include "command/commands.hpp"
#include "command/option_use.hpp"
#include "command/scene_options.hpp"
#include "command/study_options.hpp"
#include "io/error.hpp"
#include "io/text.hpp"
#include "report/cell_pictures.hpp"
#include "report/maps.hpp"
#include "run/lloyd.hpp"
#include "run/pipeline.hpp"
#include "run/study.hpp"

namespace bitshade::command {
namespace {

struct options {
  std::string scene = "garden";
  std::shared_ptr<scene_options> how;
  std::shared_ptr<study_options> cell;
  std::string out = "bitshade-out";
  int frames = 0, steps = 1;  ///< of a series
  bool steps_given = false, json = false;
};

/// How long relaxation takes and how far from the optimum it ends, all or two splits a frame.
std::string lloyd_table(const std::vector<lloyd_comparison>& list) {
  std::string out = "Lloyd relaxation   frames  teleports        cost  / least cost\n";
  for (const lloyd_comparison& c : list)
    out += pad_right("  " + c.name, 17) + pad_left(std::to_string(c.result.frames), 8) +
           pad_left(std::to_string(c.result.teleportations), 11) + pad_left(brief(c.cost, 4), 12) +
           pad_left(brief(c.ratio(), 5), 14) + '\n';
  return out;
}

nlohmann::ordered_json to_json(const std::vector<lloyd_comparison>& list) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const lloyd_comparison& c : list)
    out.push_back({{"splits", c.name},
                   {"frames", c.result.frames},
                   {"teleportations", c.result.teleportations},
                   {"cost", c.cost},
                   {"least_cost", c.least}});
  return out;
}

void render(const options& given) {
  const std::vector<configuration> cells = given.cell->cells();
  if (cells.size() != 1)
    throw usage_error("render draws one configuration, but these options name " +
                      std::to_string(cells.size()) +
                      ": give one technique, one format and one layer count, or use study");
  const configuration& c = cells.front();
  check_use(*given.cell->app, cells);
  if (given.steps_given && !(c.method == technique::lvsm && c.layers > 1 && relaxes(c.splits)))
    throw usage_error("--steps are of Lloyd relaxation: give --splits lloyd, or leave it out");
  if (given.frames > 0) {
    animate({given.scene, *given.how, c, given.out, given.frames, given.steps, given.json});
    return;
  }
  const frame input = load_for(given.scene, *given.how, cells);
  const int threads = given.how->threads, w = input.view_width, h = input.view_height;
  check_study_memory(input, cells);

  configuration twin = c, kernel = c;
  twin.format = "exact";
  kernel.method = technique::pcf;
  const cell exact = run_pipeline(input, twin, make_plan(input, twin, threads), threads);
  const cell done =
      c.exact() ? exact : run_pipeline(input, c, make_plan(input, c, threads), threads);
  const std::vector<double> geometric = truth_geometric(input, kernel, threads);
  const std::vector<double> pcf = truth_pcf(input, kernel, threads);
  const measures m =
      measure(input, {done.visibility, exact.visibility, geometric, pcf, done.layer});

  const auto seen = without_gaps(done.visibility), truth = without_gaps(geometric);
  cell_pictures pictures(given.out, given.scene, c);
  pictures.add("shaded", "the scene with this shadow", shaded_map(input, seen));
  pictures.add("visibility", "black: no light, white: all of it", visibility_map(seen, w, h));
  pictures.add("layers", "a colour a layer, darkened by the shadow",
               layer_map(input, seen, done.layer));
  pictures.add("error", "against the geometric truth", error_map(seen, truth, w, h));
  if (!c.exact())
    pictures.add("format-error", "against itself in exact arithmetic",
                 error_map(seen, without_gaps(exact.visibility), w, h));

  std::vector<lloyd_comparison> relaxed;
  if (relaxes(c.splits) && c.layers > 1) relaxed = compare_with_optimum(input, c, threads);
  if (given.json) {
    nlohmann::ordered_json all{{"scene", given.scene},
                               {"configuration", c.key()},
                               {"files", pictures.files()},
                               {"splits", done.splits},
                               {"format_error_rmse", m.format.rmse},
                               {"format_error_largest", m.format.largest},
                               {"total_error_rmse", m.total.rmse},
                               {"bleed_area", m.bleed_area},
                               {"bleed_integral", m.bleed_integral},
                               {"acne_area", m.acne_area},
                               {"notes", done.notes}};
    if (!relaxed.empty()) all["lloyd"] = to_json(relaxed);
    std::cout << all.dump(1) << '\n';
    return;
  }
  std::cout << label_of(c) << ": format error " << brief(m.format.rmse) << " RMSE, at most "
            << brief(m.format.largest) << "; bleeds over " << percent(m.bleed_area) << " %"
            << (m.bleed_area > 0 ? " (mean light there " + brief(m.bleed_integral / m.bleed_area) + ")"
                                 : std::string())
            << ", acne over " << percent(m.acne_area) << " % of the receivers\n";
  if (done.splits.size() > 2) {
    std::cout << "splits:";
    for (const double s : done.splits) std::cout << ' ' << brief(s, 5);
    std::cout << '\n';
  }
  if (!relaxed.empty()) std::cout << lloyd_table(relaxed);
  for (const std::string& note : done.notes)
    for (const std::string& line : wrap("Note: " + note + ".", 80)) std::cout << line << '\n';
  std::cout << pictures.list();
}

}  // namespace

void add_render(CLI::App& app) {
  auto given = std::make_shared<options>();
  CLI::App* command = app.add_subcommand(
      "render",
      "One configuration as pictures: shading, visibility, layers, error maps\n"
      "Draws one technique in one format: the shaded scene, the visibility, the layers in colours "
      "and the error against the truth and against exact arithmetic, as PNG files.");
  command->add_option("SCENE", given->scene, scene_argument_help())->capture_default_str();
  study_options initial;
  initial.techniques = "lvsm";
  initial.formats = "unorm16";
  initial.layers = "2";
  given->cell = add_study_options(*command, initial);
  given->how = add_scene_options(*command);
  command->add_option("--out", given->out, "Folder for the pictures")
      ->capture_default_str()
      ->option_text("DIR");
  command
      ->add_option("--animate", given->frames,
                   "Pictures of a moving scene: so many, numbered, with the splits' path as a plot")
      ->check(CLI::Range(1, 1000000))
      ->option_text("FRAMES");
  command->add_option("--steps", given->steps, "Steps of Lloyd relaxation between two of them")
      ->needs("--animate")
      ->check(CLI::Range(0, 1000000))
      ->capture_default_str()
      ->option_text("N");
  command->add_flag("--json", given->json, "Print JSON instead of text");
  command->footer(
      "Examples:\n"
      "  bitshade render garden --technique vsm --format half\n"
      "  bitshade render garden --layers 2 --splits 0.94 --overlap 0 --min-variance 1e-7\n"
      "  bitshade render beams --layers 4 --splits lloyd --lloyd-splits 2 --animate 48");
  command->callback([given, command] {
    given->steps_given = command->count("--steps") > 0;
    render(*given);
  });
}

}  // namespace bitshade::command
