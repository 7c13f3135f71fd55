// What `bitshade precision SCENE` searches, and the search.
#pragma once

#include <vector>

#include "bitshade/study/configuration.hpp"
#include "bitshade/study/frame.hpp"
#include "report/precision.hpp"

namespace bitshade::command {

struct scene_question {
  configuration base;  ///< filters and the techniques' own parameters
  std::vector<technique> techniques;
  std::vector<int> layers;  ///< of lvsm; one layer is a vsm
  std::vector<double> floors;
};

/// Every technique under every floor that it has, lvsm in every number of layers.
/// Failure  usage_error for a technique whose stages cannot be told apart.
std::vector<configuration> cells_on_scene(const scene_question& question);

/// Searches each cell's stages, and adds what was found to `found.on_scene`.
void search_cells(const frame& scene, const std::vector<configuration>& cells, int threads,
                  precision_findings& found);

}  // namespace bitshade::command
