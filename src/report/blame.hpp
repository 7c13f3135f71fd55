// Which stage is guilty, as a part of a report.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "report/html.hpp"
#include "run/blame.hpp"

namespace bitshade {

/// "The store is guilty: alone it makes 81 % of the summed squares; …"
std::string blame_sentence(const blame& found);

/// All stages in the format ("whole"), and each alone and alone exact, with its share ("stages").
nlohmann::ordered_json blame_json(const blame& found);

/// Error maps as PNG by their names: "all" and each stage's, in the order that they are shown.
std::vector<std::pair<std::string, std::string>> blame_maps(const blame& found, int width,
                                                            int height);

/// A sortable table, a bar chart and the maps; `label` names the configuration, `format` its
/// format, `command` reproduces them.
report_part blame_part(const blame& found,
                       const std::vector<std::pair<std::string, std::string>>& maps,
                       const std::string& label, const std::string& format,
                       const std::string& command);

}  // namespace bitshade
