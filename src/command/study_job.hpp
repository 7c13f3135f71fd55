// Cells run on inputs, with what a report shows of them: what study, pareto and advise share.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "command/asked_cells.hpp"
#include "command/scene_options.hpp"
#include "report/html.hpp"
#include "run/study.hpp"

namespace bitshade::command {

struct study_job {
  std::string command;  ///< "bitshade study"
  std::vector<std::string> scenes;
  std::string arguments;  ///< as given, but for the scenes
  std::shared_ptr<scene_options> scene;
  std::vector<asked_cell> cells;
  std::filesystem::path out;
  study_request request;  ///< but for cells and description
};

struct job_result {
  report_head head;
  std::vector<report_section> sections;  ///< one an input
  std::vector<study_result> done;        ///< likewise
  std::vector<frame> frames;             ///< likewise
  std::size_t computed = 0;              ///< cells that the database lacked
  double seconds = 0;
};

/// Adds --repeats, --out and --json, which every command that runs cells has.
void add_run_options(CLI::App& app, study_job& job, std::string& out, bool& json);

/// Loads the inputs, runs the missing cells and commits each at once to OUT/results.sqlite; the
/// caller writes the results. Nothing is written before all inputs are loaded.
job_result run_job(const study_job& job);

/// The inputs alone, refused where the study would not fit into memory.
std::vector<frame> load_inputs(const study_job& job);

/// "3 of 16 cells computed in 0.2 s, 13 taken from results.sqlite. The report is …"
void print_end(const study_job& job, const job_result& result);

/// Failure  usage_error where --repeats makes no sense.
void check_repeats(const study_job& job);
/// Failure  usage_error where all cells are exact: no device stores such a texel.
void demand_stored(const study_job& job);

}  // namespace bitshade::command
