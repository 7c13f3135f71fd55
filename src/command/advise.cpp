// `bitshade advise`: the cheapest configuration that keeps an error, as a shader takes it.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <set>

#include "command/commands.hpp"
#include "command/study_job.hpp"
#include "io/error.hpp"
#include "io/text.hpp"
#include "report/advice.hpp"
#include "report/folder.hpp"
#include "report/pareto.hpp"
#include "report/shader.hpp"
#include "run/timing.hpp"

namespace bitshade::command {
namespace {

struct options {
  study_job job;
  std::shared_ptr<cell_choice> cells;
  std::optional<double> most_error;
  std::string measure = "total-rmse", cost = "bytes", out = "bitshade-out";
  bool json = false;
};

/// The cells asked for; those with a floor once more with the one that their format's noise needs;
/// and what they are compared with, a single-layer VSM in binary32.
std::vector<asked_cell> candidates(const std::vector<asked_cell>& asked,
                                   const std::string& shared) {
  std::vector<asked_cell> all;
  std::set<std::string> known;
  const auto add = [&](asked_cell cell) {
    if (known.insert(cell.what.key()).second) all.push_back(std::move(cell));
  };
  for (const asked_cell& cell : asked) add(cell);
  for (asked_cell cell : asked) {
    const bool wide = cell.what.format == "binary32" || cell.what.format == "binary64";
    if (wide || cell.what.exact() || !uses_floor(cell.what.method)) continue;
    if (cell.what.method == technique::savsm) continue;  // its sums' noise has no derived floor
    cell.what.noise_floor = true, cell.arguments += " --noise-floor";
    add(std::move(cell));
  }
  add({reference_of(asked.front().what), shared + " --technique vsm --format binary32"});
  // Cells that share all but the format stand side by side: their exact twin is computed once.
  std::map<std::string, std::vector<asked_cell>> groups;
  std::vector<std::string> order;
  for (asked_cell& cell : all) {
    configuration twin = cell.what;
    twin.format = "exact";
    std::vector<asked_cell>& group = groups[twin.key()];
    if (group.empty()) order.push_back(twin.key());
    group.push_back(std::move(cell));
  }
  std::vector<asked_cell> grouped;
  for (const std::string& twin : order)
    for (asked_cell& cell : groups[twin]) grouped.push_back(std::move(cell));
  return grouped;
}

const row& reference_row(const study_job& job, const std::vector<row>& rows) {
  const std::string key = reference_of(job.cells.front().what).key();
  return *std::find_if(rows.begin(), rows.end(),
                       [&](const row& r) { return r.configuration == key; });
}

void answer(const options& given) {
  const study_job& job = given.job;
  job_result result = run_job(job);
  report_section& section = result.sections.front();
  const std::vector<row>& rows = section.rows;
  advice_question question{given.measure, 0, given.cost};
  question.most_error = given.most_error ? *given.most_error
                                         : measured(reference_row(job, rows), given.measure);
  const advice found = advise(rows, question);
  section.parts.push_back(html_pareto(pareto_of(rows, given.measure), section.command));
  write_results(job.out, result.head, result.sections);

  std::string shader, reproduce;
  if (const auto best = found.chosen()) {
    const row& r = rows[*best];
    const auto cell = std::find_if(job.cells.begin(), job.cells.end(), [&](const asked_cell& c) {
      return c.what.key() == r.configuration;
    });
    reproduce = section.commands.at(r.key);
    shader = glsl_of(cell->what, constants_of(result.frames.front(), cell->what, r.splits));
  }
  if (given.json) {
    nlohmann::ordered_json all{{"input", section.input.name}, {"command", section.command}};
    all.update(json_advice(found, rows));
    all["render"] = reproduce;
    all["glsl"] = shader;
    std::cout << all.dump(1) << '\n';
  } else {
    if (!given.most_error)
      for (const std::string& line :
           wrap("The error to keep is that of a single-layer VSM in binary32; --max-error gives "
                "another.",
                80))
        std::cout << line << '\n';
    std::cout << text_advice(found, rows);
    if (!shader.empty())
      std::cout << "\nSee it: " << reproduce << "\nPaste it:\n\n" << shader << '\n';
    print_end(job, result);
  }
  if (!found.chosen()) {
    const advised& nearest = found.order.front();
    throw failure("nothing keeps " + given.measure + " within " + brief(question.most_error) +
                  "; nearest comes " + nearest.label + " with " +
                  brief(measured(rows[nearest.row], given.measure)) +
                  ": allow more with --max-error, or offer more with --techniques, --formats "
                  "or --layers");
  }
}

}  // namespace

void add_advise(CLI::App& app) {
  auto given = std::make_shared<options>();
  CLI::App* command = app.add_subcommand(
      "advise",
      "The cheapest configuration that keeps an error, as a shader takes it\n"
      "Runs techniques that are filtered in advance in every format and layer count, with the floor "
      "asked for and with the one that the format's noise needs; says which is the cheapest that "
      "keeps the error on this scene and why the others lost; and prints its GLSL with all "
      "constants. Percentage-closer filtering, which no cost in bytes holds against, takes part "
      "where --techniques names it.");
  command
      ->add_option_function<std::string>(
          "SCENE", [given](const std::string& name) { given->job.scenes = {name}; },
          scene_argument_help())
      ->default_str("garden");
  study_options initial;
  initial.techniques = "vsm,lvsm,evsm2,evsm4,msm";
  initial.formats = "unorm16,half,binary32";
  initial.layers = "2,4";
  given->job.request.repeats = 3;
  given->job.request.natural = true;
  command
      ->add_option_function<double>(
          "--max-error", [given](double e) { given->most_error = e; },
          "The largest error to keep; without it, that of a single-layer VSM in binary32")
      ->option_text("N");
  command
      ->add_option("--measure", given->measure,
                   "The error: total-rmse, total-p999, total-largest, format-rmse, format-p999, "
                   "format-largest or bleed-area")
      ->capture_default_str()
      ->option_text("NAME");
  command
      ->add_option("--cost", given->cost,
                   "The cost: bytes (of a texel), traffic (bytes of a frame) or time (of a frame)")
      ->capture_default_str()
      ->option_text("NAME");
  given->cells = add_cell_choice(*command, initial);
  given->job.scene = add_scene_options(*command);
  add_run_options(*command, given->job, given->out, given->json);
  command->footer(
      "Examples:\n"
      "  bitshade advise garden\n"
      "  bitshade advise captured.exr --max-error 0.02 --cost time\n"
      "  bitshade advise garden --measure format-largest --max-error 0.0039 --techniques lvsm");
  command->callback([given, command] {
    study_job& job = given->job;
    if (given->most_error && !(*given->most_error >= 0 && *given->most_error <= 1))
      throw usage_error("--max-error " + shortest(*given->most_error) +
                        " is outside 0 to 1, where errors of visibility lie");
    measured({}, given->measure);
    cost_of({}, given->cost);
    check_repeats(job);
    if (job.scenes.empty()) job.scenes.push_back("garden");
    const std::vector<std::string> of_the_run{"json",    "threads", "out",      "repeats",
                                              "measure", "cost",    "max-error"};
    job.command = "bitshade advise";
    job.out = given->out;
    job.arguments = arguments_of(*command, {"json", "threads", "out"});
    std::vector<std::string> left_out{"techniques", "formats", "layers", "splits", "grid", "shard"};
    left_out.insert(left_out.end(), of_the_run.begin(), of_the_run.end());
    job.cells = cells_of(*given->cells, *command, of_the_run);
    demand_stored(job);
    job.cells = candidates(job.cells, arguments_of(*command, left_out, reference_of(job.cells.front().what)));
    answer(*given);
  });
}

}  // namespace bitshade::command
