// How many bits a map needs: as tables for a terminal, JSON, CSV and parts of a report.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "precision/joint.hpp"
#include "precision/needed.hpp"
#include "precision/scene_bits.hpp"
#include "precision/stages.hpp"
#include "report/html.hpp"

namespace bitshade {

/// Everything that `bitshade precision` found.
struct precision_findings {
  double tolerated = 1.0 / 255;
  std::vector<std::vector<bit_search::needed_bits>> curves;  ///< over layers, one a floor and K
  std::vector<bit_search::stage_bits> stages;
  std::string scene;
  std::vector<bit_search::scene_bits> on_scene;
  bit_search::joint_question joint;
  std::vector<bit_search::joint_cell> chart;
};

/// Tables of at most 80 columns, with sentences.
std::string precision_text(const precision_findings& found);
nlohmann::ordered_json precision_json(const precision_findings& found);
/// One line a question: technique, stage, layers, floor, roundings, predicted (empty where no bound
/// predicts) and found.
std::string precision_csv(const precision_findings& found);
/// Tables and plots for a report: bits against layers, stages, the joint chart.
std::vector<report_part> precision_parts(const precision_findings& found,
                                         const std::string& command);

}  // namespace bitshade
