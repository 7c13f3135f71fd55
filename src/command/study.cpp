// `bitshade study`: techniques x formats x layers on a scene, a mesh or a captured depth map.
#include <CLI/CLI.hpp>
#include <charconv>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "command/commands.hpp"
#include "command/grid.hpp"
#include "command/scene_options.hpp"
#include "command/study_options.hpp"
#include "io/atomic_file.hpp"
#include "io/build.hpp"
#include "io/error.hpp"
#include "io/text.hpp"
#include "report/folder.hpp"
#include "report/summary.hpp"
#include "run/study.hpp"

namespace bitshade::command {
namespace {

struct options {
  std::vector<std::string> scenes;
  std::shared_ptr<scene_options> scene;
  std::shared_ptr<study_options> cells;
  std::string out = "bitshade-out";
  std::string shard;  ///< "i/n": every n-th cell, from the i-th on
  bool verify_plan = false, no_pictures = false, json = false;
  std::string arguments;         ///< as given, but for the scenes
  std::string shared_arguments;  ///< those without the lists, which a single cell does not share
  std::string grid;              ///< a file that describes the cells; empty: the options do
  std::vector<std::string> shared_options;  ///< the options given, for the grid's cells
};

/// The cells that a shard computes: every n-th group of cells that share their exact reference, or
/// every n-th cell where there are fewer groups.
std::vector<asked_cell> shard_of(std::vector<asked_cell> cells, const std::string& shard) {
  if (shard.empty()) return cells;
  const std::size_t slash = shard.find('/');
  std::size_t i = 0, n = 0;
  const auto read = [&](std::size_t from, std::size_t to, std::size_t& value) {
    const auto [end, error] = std::from_chars(shard.data() + from, shard.data() + to, value);
    return error == std::errc() && end == shard.data() + to;
  };
  if (slash == std::string::npos || !read(0, slash, i) || !read(slash + 1, shard.size(), n) ||
      i < 1 || i > n)
    throw usage_error("--shard takes I/N with I from 1 to N, such as 1/4, but not '" + shard + "'");
  std::vector<std::size_t> group_of;
  std::string before;
  for (const asked_cell& cell : cells) {
    configuration twin = cell.what;
    twin.format = "exact";
    const std::string key = twin.key();
    group_of.push_back(group_of.empty() ? 0 : group_of.back() + (key == before ? 0 : 1));
    before = key;
  }
  if (group_of.back() + 1 < n)
    for (std::size_t k = 0; k < group_of.size(); ++k) group_of[k] = k;
  std::vector<asked_cell> ours;
  for (std::size_t k = 0; k < cells.size(); ++k)
    if (group_of[k] % n == i - 1) ours.push_back(std::move(cells[k]));
  if (ours.empty())
    throw usage_error("--shard " + shard + " has nothing to do: there are only " +
                      std::to_string(cells.size()) + " cells");
  return ours;
}

/// The cells of the options' lists, or of the grid.
std::vector<asked_cell> asked_cells(const options& given) {
  if (!given.grid.empty()) return read_grid(given.grid, given.shared_options);
  std::vector<asked_cell> all;
  for (const configuration& c : given.cells->cells())
    all.push_back(
        {c, given.shared_arguments + " --technique " + std::string(name_of(c.method)) +
                (c.method == technique::lvsm ? " --layers " + std::to_string(c.layers) : "") +
                " --format " + c.format});
  return all;
}

/// What heads the input in reports: sizes, and where its depths lie.
std::string describe(const frame& input) {
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
      {"occluder_histogram", occluders},
      {"receiver_histogram", receivers}}
      .dump();
}

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
  std::cout << '\n';
}

void study(const options& given) {
  const auto start = std::chrono::steady_clock::now();
  const std::vector<asked_cell> asked = shard_of(asked_cells(given), given.shard);
  std::vector<configuration> cells;
  std::map<std::string, std::string> arguments;  // of each cell, by its configuration
  for (const asked_cell& cell : asked)
    cells.push_back(cell.what), arguments[cell.what.key()] = cell.arguments;
  std::vector<frame> frames;
  std::string command = "bitshade study";
  for (const std::string& name : given.scenes) {
    frames.push_back(load_for(name, *given.scene, cells));
    check_study_memory(frames.back(), cells);
    command += " " + shell_quoted(name);
  }
  command += given.arguments;

  // Only now, with nothing left that the arguments could get wrong, is anything written.
  const std::filesystem::path folder = given.out;
  make_output_folder(folder);
  sweep_leftovers(folder);
  database results(folder / "results.sqlite");
  const report_head head{command, program_version(), compiler_description(), machine_description()};
  std::vector<report_section> sections;
  progress bar;
  bar.begin(frames.size() * cells.size());
  std::size_t computed = 0;
  std::vector<study_result> done;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const std::string description = describe(frames[i]);
    done.push_back(
        run_study(frames[i],
                  {cells, description, given.scene->threads, !given.no_pictures, given.verify_plan},
                  results, bar));
    const study_result& result = done.back();
    computed += result.computed;
    report_section s{{result.input, given.scenes[i], description},
                     result.rows,
                     results.pictures(result.input),
                     {},
                     {},
                     "bitshade study " + shell_quoted(given.scenes[i]) + given.arguments};
    for (const row& r : result.rows) {
      s.cells[r.key] = results.pictures(r.key);
      s.commands[r.key] =
          "bitshade render " + shell_quoted(given.scenes[i]) + arguments.at(r.configuration);
    }
    sections.push_back(std::move(s));
  }
  bar.end();
  write_results(folder, head, sections);

  if (given.json) {
    std::cout << results_json(head, sections).dump(1) << '\n';
    return;
  }
  for (std::size_t i = 0; i < sections.size(); ++i) print(sections[i], done[i], given.verify_plan);
  const std::size_t all = frames.size() * cells.size();
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::cout << computed << " of " << all << " cells computed in " << brief(seconds) << " s";
  if (computed < all) std::cout << ", " << all - computed << " taken from results.sqlite";
  std::cout << ".\nThe report is " << (folder / "report.html").string()
            << "; pictures, CSV, JSON and the database lie beside it.\n";
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
          "SCENE", [given](const std::vector<std::string>& names) { given->scenes = names; },
          scene_argument_help())
      ->default_str("garden");
  given->cells = add_study_options(*command, {});
  given->scene = add_scene_options(*command);
  command->add_option("--out", given->out, "Folder for the results")
      ->capture_default_str()
      ->option_text("DIR");
  command
      ->add_option("--grid", given->grid,
                   "The cells as a JSON file: products of lists, exclusions, single cells")
      ->option_text("FILE");
  command
      ->add_option("--shard", given->shard, "Part I of N of the cells; 'bitshade merge' joins them")
      ->option_text("I/N");
  command->add_flag("--verify-plan", given->verify_plan,
                    "Run every effect as well, and demand the same bits");
  command->add_flag("--no-pictures", given->no_pictures,
                    "Figures alone: for grids of thousands of cells");
  command->add_flag("--json", given->json, "Print JSON instead of tables");
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
    if (given->scenes.empty()) given->scenes.push_back("garden");
    given->arguments =
        arguments_of(*command, {"json", "verify-plan", "threads", "out", "no-pictures"});
    given->shared_arguments =
        arguments_of(*command, {"json", "verify-plan", "threads", "out", "shard", "techniques",
                                "formats", "layers", "grid", "no-pictures"});
    for (const CLI::Option* option : command->get_options()) {
      if (option->count() == 0 || option->get_lnames().empty()) continue;
      const std::string name = "--" + option->get_lnames().front();
      const bool list = name == "--techniques" || name == "--formats" || name == "--layers";
      if (list && !given->grid.empty())
        throw usage_error(name + " and --grid contradict each other: put the list into the grid");
      for (const std::string& value : option->results())
        given->shared_options.push_back(option->get_expected_max() == 0 ? name
                                                                        : name + "=" + value);
    }
    study(*given);
  });
}

}  // namespace bitshade::command
