// `bitshade merge`: the databases of several runs as one, with its report.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>

#include "command/commands.hpp"
#include "io/atomic_file.hpp"
#include "io/build.hpp"
#include "io/error.hpp"
#include "report/folder.hpp"
#include "report/labels.hpp"

namespace bitshade::command {
namespace {

struct options {
  std::vector<std::string> sources;
  std::string out = "bitshade-out";
  bool json = false;
};

/// The database that a folder or a file name means.
std::filesystem::path database_of(const std::string& name) {
  const std::filesystem::path path = name;
  return std::filesystem::is_directory(path) ? path / "results.sqlite" : path;
}

void merge(const options& given) {
  for (const std::string& source : given.sources)
    const database check(database_of(source), database::access::read);
  const std::filesystem::path folder = given.out;
  make_output_folder(folder);
  sweep_leftovers(folder);
  database results(folder / "results.sqlite");
  std::size_t added = 0;
  std::string command = "bitshade merge";
  for (const std::string& source : given.sources) {
    added += results.merge(database_of(source));
    command += " " + shell_quoted(source);
  }
  command += " --out " + shell_quoted(given.out);

  std::vector<report_section> sections;
  std::size_t cells = 0;
  for (const input_description& input : results.inputs()) {
    report_section s{input, {}, results.pictures(input.digest), {}, {}, command};
    for (row& r : results.rows()) {
      if (r.input != input.digest) continue;
      s.cells[r.key] = results.pictures(r.key);
      s.rows.push_back(std::move(r));
    }
    std::sort(s.rows.begin(), s.rows.end(), shown_before);
    cells += s.rows.size();
    sections.push_back(std::move(s));
  }
  const report_head head{command, program_version(), compiler_description(), machine_description()};
  write_results(folder, head, sections);
  if (given.json) {
    std::cout << results_json(head, sections).dump(1) << '\n';
    return;
  }
  std::cout << added << " cells taken over, " << cells << " in all.\nThe report is "
            << (folder / "report.html").string() << ".\n";
}

}  // namespace

void add_merge(CLI::App& app) {
  auto given = std::make_shared<options>();
  CLI::App* command = app.add_subcommand(
      "merge",
      "Join the results of several runs\n"
      "Takes over into the folder of --out every cell that it lacks, with its pictures, and writes "
      "tables and report of all. Nothing is computed, nothing is lost, and doing it twice changes "
      "nothing.");
  command->add_option("RESULTS", given->sources, "Folders of studies, or their results.sqlite")
      ->required();
  command->add_option("--out", given->out, "Folder for the joined results")
      ->capture_default_str()
      ->option_text("DIR");
  command->add_flag("--json", given->json, "Print JSON instead of text");
  command->footer(
      "Example:\n"
      "  bitshade merge part1 part2 --out all");
  command->callback([given] { merge(*given); });
}

}  // namespace bitshade::command
