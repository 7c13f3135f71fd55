// `bitshade pareto`: accuracy against time and bytes.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "command/commands.hpp"
#include "command/study_job.hpp"
#include "io/error.hpp"
#include "io/text.hpp"
#include "report/folder.hpp"
#include "report/pareto.hpp"
#include "report/summary.hpp"

namespace bitshade::command {
namespace {

struct options {
  study_job job;
  std::shared_ptr<cell_choice> cells;
  std::string out = "bitshade-out", measure = "total-rmse";
  bool json = false;
};

void pareto(const options& given) {
  const study_job& job = given.job;
  job_result result = run_job(job);
  nlohmann::ordered_json fronts = nlohmann::ordered_json::array();
  std::string text;
  for (report_section& s : result.sections) {
    const pareto_front front = pareto_of(s.rows, given.measure);
    s.parts.push_back(html_pareto(front, s.command));
    nlohmann::ordered_json one{{"input", s.input.name}};
    one.update(json_pareto(front));
    fronts.push_back(one);
    const std::string sizes = nlohmann::json::parse(s.input.description)["summary"];
    for (const std::string& line : wrap(s.input.name + ": " + sizes, 80)) text += line + '\n';
    text += '\n' + text_pareto(front) + '\n';
  }
  write_results(job.out, result.head, result.sections);
  if (given.json) {
    nlohmann::ordered_json all = results_json(result.head, result.sections);
    all["fronts"] = fronts;
    std::cout << all.dump(1) << '\n';
    return;
  }
  std::cout << text;
  print_end(job, result);
}

}  // namespace

void add_pareto(CLI::App& app) {
  auto given = std::make_shared<options>();
  CLI::App* command = app.add_subcommand(
      "pareto",
      "Accuracy against time and bytes: what no other configuration beats\n"
      "Runs every configuration with its texels stored as the format's own bits, several times, "
      "and says which are on the front of error and time, or of error and bytes, and what beats "
      "the others. Times are multiples of a single-layer VSM in binary32.");
  command
      ->add_option_function<std::vector<std::string>>(
          "SCENE", [given](const std::vector<std::string>& names) { given->job.scenes = names; },
          scene_argument_help())
      ->default_str("garden");
  study_options initial;
  initial.techniques = "hard,pcf,vsm,lvsm,msm";
  initial.formats = "unorm16,half,binary32";
  initial.layers = "2,4";
  given->job.request.repeats = 5;
  given->job.request.natural = true;
  given->cells = add_cell_choice(*command, initial);
  given->job.scene = add_scene_options(*command);
  command
      ->add_option("--measure", given->measure,
                   "total-rmse, total-p999, total-largest, format-rmse, format-p999, "
                   "format-largest or bleed-area")
      ->capture_default_str()
      ->option_text("NAME");
  add_run_options(*command, given->job, given->out, given->json);
  command->footer(
      "Examples:\n"
      "  bitshade pareto garden\n"
      "  bitshade pareto captured.exr --techniques vsm,evsm2,evsm4,msm --repeats 15");
  command->callback([given, command] {
    study_job& job = given->job;
    const std::vector<std::string> of_the_run{"json", "threads", "out", "repeats", "measure"};
    measured({}, given->measure);
    if (job.scenes.empty()) job.scenes.push_back("garden");
    check_repeats(job);
    job.command = "bitshade pareto";
    job.out = given->out;
    job.arguments = arguments_of(*command, {"json", "threads", "out", "repeats"});
    job.cells = cells_of(*given->cells, *command, of_the_run);
    demand_stored(job);
    pareto(*given);
  });
}

}  // namespace bitshade::command
