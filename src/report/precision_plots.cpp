#include "report/precision.hpp"

#include <algorithm>

#include "io/text.hpp"
#include "report/figures.hpp"
#include "report/html_table.hpp"
#include "report/plot.hpp"

namespace bitshade {

using bit_search::joint_cell;
using bit_search::needed_bits;
using bit_search::scene_bits;
using bit_search::stage_bits;

namespace {

axis layer_axis(const std::vector<double>& ticks) { return {"layers N", true, ticks}; }

std::string curve_name(const needed_bits& p) {
  return "floor " + brief(p.question.floor_deviation * p.question.floor_deviation, 2) +
         ", K = " + std::to_string(p.question.roundings) + (p.floating ? ", significand" : "");
}

std::vector<double> layers_in(const precision_findings& found) {
  std::vector<double> all;
  for (const auto& curve : found.curves) {
    for (const needed_bits& p : curve) all.push_back(p.layers);
  }
  for (const joint_cell& c : found.chart) all.push_back(c.layers);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

report_part curves_part(const precision_findings& found, const std::string& command) {
  plot p{"Bits against layers",
         layer_axis(layers_in(found)),
         {"bits of a stored moment", false, {}},
         {},
         {{16, "16 bits"}}};
  std::string rows;
  std::vector<std::string> said;
  int colour = 0;
  for (const auto& curve : found.curves) {
    series line{curve_name(curve.front()), colour, true, {}, {}};
    series bound{"", colour, true, {}, {}, {}, false};
    for (const needed_bits& at : curve) {
      const double n = at.layers;
      line.points.emplace_back(n, at.found);
      line.labels.push_back("N = " + std::to_string(at.layers) + ": " + brief(at.found, 4) +
                            " bits found, " + brief(at.predicted, 4) + " by the bound");
      bound.points.emplace_back(n, at.predicted);
      rows += table_row(word_cell(curve_name(at)) + number_cell(n, std::to_string(at.layers)) +
                        number_cell(at.predicted, brief(at.predicted, 4)) +
                        number_cell(at.found, brief(at.found, 4)) +
                        number_cell(at.predicted_whole, std::to_string(at.predicted_whole)) +
                        number_cell(at.found_whole, std::to_string(at.found_whole)) +
                        level_cell(at.witness.error.size()));
    }
    bound.name = "its bound";
    p.lines.push_back(line);
    p.lines.push_back(bound);
    ++colour;
    if (curve.size() > 1) {
      said.push_back(curve_name(curve.front()) + ": slope " +
                     brief(line_through(curve, &needed_bits::found).slope, 4) + " found and " +
                     brief(line_through(curve, &needed_bits::predicted).slope, 4) +
                     " by the bound, over log2 N; -2 is the law.");
      for (const auto& sentence : deviations(curve)) said.push_back(sentence);
    }
  }
  std::string words = "<ul>";
  for (const auto& s : said) words += "<li>" + escaped(s) + "</li>";
  words += "</ul>";
  return {
      "Bits against layers",
      "Marks: the fewest bits below which a footprint was found that breaks the error, judged in "
      "exact arithmetic. Lines without marks: the bound, which suffices for every footprint.",
      figure(svg(p), caption("Bits of a stored moment against layers.", "K: roundings on the way.",
                             command)) +
          words +
          sortable_table({{"curve", "", true},
                          {"layers", ""},
                          {"bound", "real bits"},
                          {"found", "real bits"},
                          {"bound, bits", ""},
                          {"found, bits", ""},
                          {"error, one bit fewer", "of the witness"}},
                         rows)};
}

report_part stages_part(const precision_findings& found) {
  std::string rows;
  const auto add = [&](const std::string& where, const auto& s, bool bounded, double error) {
    rows += table_row(
        word_cell(where) + word_cell(s.technique) + word_cell(s.stage) +
        number_cell(s.layers, std::to_string(s.layers)) + word_cell(s.unit) +
        number_cell(s.predicted, !bounded           ? "-"
                                 : s.predicted == 0 ? "none"
                                                    : std::to_string(s.predicted)) +
        number_cell(s.found, s.found == 0 ? "none" : std::to_string(s.found)) + level_cell(error));
  };
  for (const stage_bits& s : found.stages) {
    add("floor " + brief(s.floor_deviation * s.floor_deviation, 2), s, true, s.witness_error);
  }
  for (const scene_bits& s : found.on_scene) add(found.scene, s, s.bounded, s.error_below);
  return {"Bits of each stage",
          "The fewest bits that keep the error: of a filter weight's fraction, of a significand in "
          "shading, in running sums or in an exponential map's store, of a unorm. Predicted for "
          "every footprint, and found; no bound predicts all stages together, nor four moments.",
          sortable_table({{"where", "", true},
                          {"technique", "", true},
                          {"stage", "", true},
                          {"layers", ""},
                          {"bits of", "", true},
                          {"bound", ""},
                          {"found", ""},
                          {"error, one bit fewer", ""}},
                         rows)};
}

report_part joint_part(const precision_findings& found, const std::string& command) {
  plot p{"Floor, overlap, layers and bits",
         layer_axis(layers_in(found)),
         {"bits of a unorm", false, {}},
         {},
         {{16, "16 bits"}}};
  int colour = 0;
  for (const double deviation : found.joint.deviations) {
    series full{"sigma_min " + brief(deviation), colour, true, {}, {}};
    series apart{"no overlap", colour, true, {}, {}, {}, false};
    for (const joint_cell& c : found.chart) {
      if (c.floor_deviation != deviation) continue;
      if (c.bits > 0) {
        full.points.emplace_back(c.layers, c.bits);
        full.labels.push_back("N = " + std::to_string(c.layers) + ", overlap " + brief(c.overlap) +
                              ": " + std::to_string(c.bits) + " bits");
      }
      if (c.bits_apart > 0) apart.points.emplace_back(c.layers, c.bits_apart);
    }
    p.lines.push_back(full);
    p.lines.push_back(apart);
    ++colour;
  }
  std::string words = "<ul>";
  for (const auto& s : joint_findings(found.joint, found.chart, 16))
    words += "<li>" + escaped(s) + "</li>";
  words += "</ul>";
  return {
      "Where the overlap and 16 bits meet",
      "Marks: bits with the overlap that hides the layers' edges, sigma_min sqrt(1/eps - 1). Lines "
      "without marks: no overlap; they end where a layer is too thin for its floor's light to "
      "fade.",
      figure(svg(p), caption("Bits against layers, with overlaps and without.",
                             "Every footprint is kept within the error.", command)) +
          words};
}

}  // namespace

std::vector<report_part> precision_parts(const precision_findings& found,
                                         const std::string& command) {
  std::vector<report_part> parts;
  if (!found.curves.empty()) parts.push_back(curves_part(found, command));
  if (!found.stages.empty() || !found.on_scene.empty()) parts.push_back(stages_part(found));
  if (!found.chart.empty()) parts.push_back(joint_part(found, command));
  return parts;
}

}  // namespace bitshade
