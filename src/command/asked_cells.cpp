#include "command/asked_cells.hpp"

#include <CLI/CLI.hpp>
#include <charconv>

#include "command/option_use.hpp"
#include "io/error.hpp"

namespace bitshade::command {
namespace {

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

/// The options given on the command line, as a grid's cells take them: "--overlap=0.02".
std::vector<std::string> options_given(const CLI::App& app) {
  std::vector<std::string> all;
  for (const CLI::Option* option : app.get_options()) {
    if (option->count() == 0 || option->get_lnames().empty()) continue;
    const std::string name = "--" + option->get_lnames().front();
    if (name == "--techniques" || name == "--formats" || name == "--layers")
      throw usage_error(name + " and --grid contradict each other: put the list into the grid");
    for (const std::string& value : option->results())
      all.push_back(option->get_expected_max() == 0 ? name : name + "=" + value);
  }
  return all;
}

}  // namespace

std::shared_ptr<cell_choice> add_cell_choice(CLI::App& app, const study_options& initial) {
  auto choice = std::make_shared<cell_choice>();
  choice->options = add_study_options(app, initial);
  app.add_option_function<std::string>(
         "--grid", [choice](const std::string& file) { choice->grid = file; },
         "The cells as a JSON file: products of lists, exclusions, single cells")
      ->option_text("FILE");
  app.add_option_function<std::string>(
         "--shard", [choice](const std::string& part) { choice->shard = part; },
         "Part I of N of the cells; 'bitshade merge' joins them")
      ->option_text("I/N");
  return choice;
}

std::vector<asked_cell> cells_of(cell_choice& choice, const CLI::App& app,
                                 const std::vector<std::string>& not_shared) {
  std::vector<asked_cell> all;
  if (!choice.grid.empty()) all = read_grid(choice.grid, options_given(app));
  std::vector<std::string> left_out{"shard", "grid", "techniques", "formats", "layers"};
  left_out.insert(left_out.end(), not_shared.begin(), not_shared.end());
  if (choice.grid.empty()) {
    for (const configuration& c : choice.options->cells())
      all.push_back(
          {c, arguments_of(app, left_out, c) + " --technique " + std::string(name_of(c.method)) +
                  (c.method == technique::lvsm ? " --layers " + std::to_string(c.layers) : "") +
                  " --format " + c.format});
  }
  std::vector<configuration> cells;
  for (const asked_cell& cell : all) cells.push_back(cell.what);
  choice.notes = check_use(app, cells);
  return shard_of(std::move(all), choice.shard);
}

}  // namespace bitshade::command
