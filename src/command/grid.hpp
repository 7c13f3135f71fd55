// --grid FILE.json: thousands of cells, described as products of lists, exclusions and single
// cells.
#pragma once

#include <string>
#include <vector>

#include "bitshade/study/configuration.hpp"

namespace bitshade::command {

/// A cell as it was asked for.
struct asked_cell {
  configuration what;
  std::string arguments;  ///< that ask `render` for this cell alone: " --technique vsm …"
};

/// The cells of a grid file.
///
///   {"product": {"technique": ["vsm", "lvsm"], "layers": [1, 2], "format": ["unorm16", "half"]},
///    "exclude": [{"technique": "vsm", "format": "half"}],
///    "cells":   [{"technique": "lvsm", "format": "half", "layers": 2, "splits": "0.94"}]}
///
/// Fields are the options of a study by their names, values text, numbers or true; a list of
/// numbers within a list is one value of several numbers. "product" may be a list of products. A
/// cell is excluded where it has one of the values of every field that an exclusion names; "cells"
/// are never excluded. `shared` stands before every cell's own fields, which win.
///
/// Shapes   each configuration once, cells that share all but the format side by side.
/// Failure  failure with the file where it cannot be read; usage_error with the file, the JSON
///          pointer and the cure for everything else, and for a grid without a cell.
std::vector<asked_cell> read_grid(const std::string& file, const std::vector<std::string>& shared);

}  // namespace bitshade::command
