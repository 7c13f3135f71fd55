#include "command/study_job.hpp"

#include <CLI/CLI.hpp>

#include <chrono>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>

#include "io/atomic_file.hpp"
#include "io/build.hpp"
#include "io/error.hpp"
#include "io/text.hpp"
#include "report/folder.hpp"

namespace bitshade::command {
namespace {

/// What heads the input in reports: sizes, seed, and where its depths lie.
std::string describe(const frame& input, std::uint64_t seed) {
  constexpr std::size_t bins = 128;
  std::vector<int> occluders(bins), receivers(bins);
  const auto bin = [](double depth) {
    return std::min(bins - 1, static_cast<std::size_t>(depth * static_cast<double>(bins)));
  };
  std::size_t drawn = 0, seen = 0;
  for (const float d : input.depth.texels)
    if (d < 1) ++drawn, ++occluders[bin(static_cast<double>(d))];
  for (const receiver& r : input.receivers)
    if (r.surface != 0)
      ++seen, ++receivers[bin(std::min(1.0, std::max(0.0, static_cast<double>(r.t))))];
  const std::string map =
      std::to_string(input.depth.width) + "x" + std::to_string(input.depth.height);
  const std::string view =
      std::to_string(input.view_width) + "x" + std::to_string(input.view_height);
  return nlohmann::ordered_json{
      {"map", {input.depth.width, input.depth.height}},
      {"view", {input.view_width, input.view_height}},
      {"summary", "Depth map " + map + ", " + std::to_string(drawn) + " texels drawn; view " +
                      view + ", " + std::to_string(seen) + " receivers."},
      {"seed", seed},
      {"occluder_histogram", occluders},
      {"receiver_histogram", receivers}}
      .dump();
}

}  // namespace

std::vector<frame> load_inputs(const study_job& job) {
  std::vector<configuration> cells;
  for (const asked_cell& cell : job.cells) cells.push_back(cell.what);
  std::vector<frame> frames;
  for (const std::string& name : job.scenes) {
    frames.push_back(load_for(name, *job.scene, cells));
    check_study_memory(frames.back(), cells);
  }
  return frames;
}

job_result run_job(const study_job& job) {
  const auto start = std::chrono::steady_clock::now();
  study_request request = job.request;
  request.threads = job.scene->threads;
  std::map<std::string, std::string> arguments;  // of each cell, by its configuration
  for (const asked_cell& cell : job.cells) {
    request.cells.push_back(cell.what);
    arguments[cell.what.key()] = cell.arguments;
  }
  std::vector<frame> frames = load_inputs(job);
  std::string command = job.command;
  for (const std::string& name : job.scenes) command += " " + shell_quoted(name);
  command += job.arguments;

  // Only now, with nothing left that the arguments could get wrong, is anything written.
  make_output_folder(job.out);
  sweep_leftovers(job.out);
  database results(job.out / "results.sqlite");
  job_result all;
  all.head = {command, program_version(), compiler_description(), machine_description(),
              std::to_string(job.scene->seed)};
  progress bar;
  bar.begin(frames.size() * request.cells.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    request.description = describe(frames[i], job.scene->seed);
    all.done.push_back(run_study(frames[i], request, results, bar));
    const study_result& result = all.done.back();
    all.computed += result.computed;
    const std::string scene = shell_quoted(job.scenes[i]);
    report_section s{{result.input, job.scenes[i], request.description},
                     result.rows,
                     results.pictures(result.input),
                     {},
                     {},
                     job.command + " " + scene + job.arguments};
    for (const row& r : result.rows) {
      s.cells[r.key] = results.pictures(r.key);
      s.commands[r.key] = "bitshade render " + scene + arguments.at(r.configuration);
    }
    all.sections.push_back(std::move(s));
  }
  bar.end();
  all.frames = std::move(frames);
  all.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return all;
}

void print_end(const study_job& job, const job_result& result) {
  std::size_t cells = 0;
  for (const study_result& one : result.done) cells += one.rows.size();
  std::cout << result.computed << " of " << cells << " cells computed in " << brief(result.seconds)
            << " s";
  if (result.computed < cells)
    std::cout << ", " << cells - result.computed << " taken from results.sqlite";
  std::cout << ".\nThe report is " << (job.out / "report.html").string()
            << "; pictures, CSV, JSON and the database lie beside it.\n";
}

void add_run_options(CLI::App& app, study_job& job, std::string& out, bool& json) {
  app.add_option("--repeats", job.request.repeats,
                 "Runs of a cell, whose median and quartiles are its times")
      ->capture_default_str()
      ->option_text("N");
  app.add_option("--out", out, "Folder for the results")->capture_default_str()->option_text("DIR");
  app.add_flag("--json", json, "Print JSON instead of text");
}

void check_repeats(const study_job& job) {
  if (job.request.repeats < 1 || job.request.repeats > 1000)
    throw usage_error("--repeats takes 1 to 1000 runs, but not " +
                      std::to_string(job.request.repeats));
}

void demand_stored(const study_job& job) {
  for (const asked_cell& cell : job.cells)
    if (!cell.what.exact()) return;
  throw usage_error("no device stores exact numbers: give --formats another format than exact");
}

}  // namespace bitshade::command
