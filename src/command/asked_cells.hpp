// Which cells a command runs: the product of its lists, or a grid file; all of them, or a shard.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "command/grid.hpp"
#include "command/study_options.hpp"

namespace bitshade::command {

struct cell_choice {
  std::shared_ptr<study_options> options;
  std::string grid;   ///< a file that describes the cells; empty: the options do
  std::string shard;  ///< "i/n"
  std::vector<std::string> notes;  ///< which options leave some of the cells as they are
};

/// Adds the options of a study, --grid and --shard; `initial` holds the defaults.
std::shared_ptr<cell_choice> add_cell_choice(CLI::App& app, const study_options& initial);

/// The cells that `app` was asked for; `not_shared` names options that are none of a cell's.
/// Failure  those of study_options::cells, read_grid and check_use; usage_error for a shard without
///          a cell.
std::vector<asked_cell> cells_of(cell_choice& choice, const CLI::App& app,
                                 const std::vector<std::string>& not_shared);

}  // namespace bitshade::command
