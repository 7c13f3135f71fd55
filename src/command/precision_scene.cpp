#include "command/precision_scene.hpp"

#include <algorithm>
#include <utility>

#include "precision/scene_bits.hpp"

namespace bitshade::command {

std::vector<configuration> cells_on_scene(const scene_question& question) {
  std::vector<configuration> all;
  const auto add = [&](const configuration& c) {
    const auto same = [&](const configuration& other) { return other.key() == c.key(); };
    if (std::none_of(all.begin(), all.end(), same)) all.push_back(c);
  };
  for (const double floor : question.floors) {
    configuration c = question.base;
    c.min_variance = floor;
    for (const technique t : question.techniques) {
      c.method = t;
      if (t != technique::lvsm) {
        c.layers = 1;
        add(c);
        continue;
      }
      for (const int n : question.layers) {
        c.method = n == 1 ? technique::vsm : t;
        c.layers = n;
        add(c);
      }
    }
  }
  for (const configuration& c : all) require_stages(c);
  return all;
}

void search_cells(const frame& scene, const std::vector<configuration>& cells, int threads,
                  precision_findings& found) {
  for (const configuration& c : cells)
    for (bit_search::scene_bits& one : bit_search::search_scene(
             scene, c, bit_search::searches_of(c), found.tolerated, threads))
      found.on_scene.push_back(std::move(one));
}

}  // namespace bitshade::command
