// `bitshade study`: techniques x formats x layers on a scene, a mesh or a captured depth map.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "command/commands.hpp"
#include "command/option_use.hpp"
#include "command/study_job.hpp"
#include "command/study_parts.hpp"
#include "io/error.hpp"
#include "io/text.hpp"
#include "report/folder.hpp"
#include "report/summary.hpp"

namespace bitshade::command {
namespace {

struct options {
  study_job job;
  std::shared_ptr<cell_choice> cells;
  std::string out = "bitshade-out";
  bool no_pictures = false, json = false;
  bool blame = false, precision = false;  ///< parts of the report
};

void print(const report_section& s, const study_result& result, bool verified) {
  const std::string sizes = nlohmann::json::parse(s.input.description)["summary"];
  for (const std::string& text : wrap(s.input.name + ": " + sizes, 80)) std::cout << text << '\n';
  std::cout << '\n' << text_tables(s.rows) << '\n' << text_effects(s.rows) << '\n';
  if (verified) {
    double planned = 0, everything = 0;
    for (const verification& v : result.verified)
      planned += v.planned_seconds, everything += v.everything_seconds;
    std::cout << "Plan verified: " << result.verified.size() << " of " << result.rows.size()
              << " cells give the same bits with every effect simulated.\nThe plan took "
              << brief(planned) << " s, everything " << brief(everything)
              << " s: " << brief(everything - planned) << " s saved.\n\n";
  }
  for (const std::string& f : findings(s.rows))
    for (const std::string& text : wrap(f, 80)) std::cout << text << '\n';
  for (const report_part& p : s.parts)
    if (!p.finding.empty())
      for (const std::string& text : wrap(p.finding, 80)) std::cout << text << '\n';
  std::cout << '\n';
}

void study(const options& given) {
  const study_job& job = given.job;
  job_result result = run_job(job);
  for (std::size_t i = 0; i < result.sections.size(); ++i) {
    std::vector<report_part>& parts = result.sections[i].parts;
    if (given.blame) parts.push_back(blamed(job, result, i));
    if (given.precision)
      for (report_part& part : bits_needed(job, result, i)) parts.push_back(std::move(part));
  }
  write_results(job.out, result.head, result.sections);
  if (given.json) {
    std::cout << results_json(result.head, result.sections).dump(1) << '\n';
    return;
  }
  for (std::size_t i = 0; i < result.sections.size(); ++i)
    print(result.sections[i], result.done[i], job.request.verify_plan);
  print_notes(given.cells->notes);
  print_end(job, result);
}

}  // namespace

void add_study(CLI::App& app) {
  auto given = std::make_shared<options>();
  CLI::App* command = app.add_subcommand(
      "study",
      "The main job: techniques x formats x layers on a scene\n"
      "Runs every technique in every format and layer count on a scene, a mesh or a captured depth "
      "map, and says what each costs in error and in time: a table here; results.sqlite, CSV, "
      "JSON, "
      "pictures and report.html in the folder of --out. A run that was stopped goes on where it "
      "was.");
  command
      ->add_option_function<std::vector<std::string>>(
          "SCENE", [given](const std::vector<std::string>& names) { given->job.scenes = names; },
          scene_argument_help())
      ->default_str("garden");
  given->cells = add_cell_choice(*command, {});
  given->job.scene = add_scene_options(*command);
  add_run_options(*command, given->job, given->out, given->json);
  command->add_flag("--blame", given->blame,
                    "Also say which stage is guilty of the largest format error");
  command->add_flag("--precision", given->precision,
                    "Also say how many bits the layers need, with the floor asked for");
  command->add_flag("--verify-plan", given->job.request.verify_plan,
                    "Run every effect as well, and demand the same bits");
  command->add_flag("--no-pictures", given->no_pictures,
                    "Figures alone: for grids of thousands of cells");
  command->footer(
      "Examples:\n"
      "  bitshade study garden --layers 1,2,4 --formats unorm16,half,binary32,exact\n"
      "  bitshade study garden --splits 0.94 --overlap 0 --min-variance 1e-7\n"
      "  bitshade study model.obj --size 2048 --light 0.3,-1,0.2 --out results\n"
      "  bitshade study captured.exr\n"
      "  bitshade study garden --grid grid.json --shard 1/4 --out part1\n"
      "A grid: {\"product\": {\"technique\": [\"vsm\", \"lvsm\"], \"layers\": [1, 2, 4],\n"
      "\"format\": [\"unorm16\", \"half\"], \"overlap\": [0, 0.01]}, \"exclude\": [{…}],\n"
      "\"cells\": [{…}]}; its fields are the options above.");
  command->callback([given, command] {
    study_job& job = given->job;
    const std::vector<std::string> of_the_run{
        "json", "verify-plan", "threads", "out", "no-pictures", "repeats", "blame", "precision"};
    if (job.scenes.empty()) job.scenes.push_back("garden");
    check_repeats(job);
    job.command = "bitshade study";
    job.out = given->out;
    job.request.pictures = !given->no_pictures;
    job.arguments = arguments_of(
        *command, {"json", "verify-plan", "threads", "out", "no-pictures", "repeats"});
    job.cells = cells_of(*given->cells, *command, of_the_run);
    study(*given);
  });
}

}  // namespace bitshade::command
