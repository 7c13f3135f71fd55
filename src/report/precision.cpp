#include "report/precision.hpp"

#include <cmath>

#include "io/text.hpp"
#include "report/text_table.hpp"

namespace bitshade {

using bit_search::joint_cell;
using bit_search::needed_bits;
using bit_search::scene_bits;
using bit_search::stage_bits;

namespace {

std::string fixed(double x, int decimals = 2) {
  const double scale = std::pow(10.0, decimals);
  std::string text = shortest(std::nearbyint(x * scale) / scale);
  const auto point = text.find('.');
  if (point == std::string::npos)
    return text + "." + std::string(static_cast<std::size_t>(decimals), '0');
  const auto digits = text.size() - point - 1;
  if (digits < static_cast<std::size_t>(decimals))
    text.append(static_cast<std::size_t>(decimals) - digits, '0');
  return text;
}

std::string bits_or_none(int bits) { return bits == 0 ? "none" : std::to_string(bits); }

std::string paragraph(const std::string& text) {
  std::string out;
  for (const auto& line : wrap(text, 78)) out += "  " + line + "\n";
  return out;
}

const char* technique_of(const needed_bits& p) { return p.layers == 1 ? "vsm" : "lvsm"; }

std::string variance_of(double deviation) { return brief(deviation * deviation, 2); }

std::string curve_text(const std::vector<needed_bits>& curve) {
  const needed_bits& first = curve.front();
  std::string out = "Store of both moments: floor " + variance_of(first.question.floor_deviation) +
                    " (sigma_min " + brief(first.question.floor_deviation) + "), " +
                    std::to_string(first.question.roundings) +
                    (first.question.roundings == 1 ? " rounding" : " roundings") + ", overlap " +
                    brief(first.overlap) + ", " +
                    (first.floating ? "significand bits\n" : "unorm bits\n");
  std::vector<text_line> lines{
      {"N", "bound", "2 log2 N", "found", "bits: bound", "bits: found", "error - 1 bit"}};
  for (const needed_bits& p : curve) {
    const double law =
        first.predicted - 2 * std::log2(static_cast<double>(p.layers) / first.layers);
    lines.push_back({std::to_string(p.layers), fixed(p.predicted), fixed(law), fixed(p.found),
                     bits_or_none(p.predicted_whole), bits_or_none(p.found_whole),
                     brief(p.witness.error.size())});
  }
  out += text_table(lines, {});
  if (curve.size() > 1) {
    const auto found = line_through(curve, &needed_bits::found);
    const auto bound = line_through(curve, &needed_bits::predicted);
    out += paragraph("Slope over log2 N: " + fixed(found.slope, 3) + " found, " +
                     fixed(bound.slope, 3) + " by the bound; -2 is the law.");
    for (const auto& sentence : deviations(curve)) out += paragraph(sentence);
  }
  return out + "\n";
}

std::string stages_text(const precision_findings& found) {
  std::vector<text_line> lines{
      {"name", "stage", "N", "floor", "bits of", "bound", "found", "error - 1 bit"}};
  for (const stage_bits& s : found.stages) {
    lines.push_back({s.technique, s.stage, std::to_string(s.layers), variance_of(s.floor_deviation),
                     s.unit, bits_or_none(s.predicted), bits_or_none(s.found),
                     brief(s.witness_error)});
  }
  return "Other stages, on adversarial footprints\n" + text_table(lines, {0, 1, 4}) + "\n";
}

std::string scene_text(const precision_findings& found) {
  std::vector<text_line> lines{
      {"name", "stage", "N", "floor", "bits of", "bound", "found", "error", "- 1 bit"}};
  for (const scene_bits& s : found.on_scene) {
    lines.push_back({s.technique, s.stage, std::to_string(s.layers),
                     s.min_variance == 0 ? "-" : brief(s.min_variance, 2), s.unit,
                     s.bounded ? bits_or_none(s.predicted) : "-",
                     bits_or_none(s.found), brief(s.error),
                     brief(s.error_below)});
  }
  return "On " + found.scene +
         ": the fewest bits that keep every receiver, each stage alone in them or all\n" +
         text_table(lines, {0, 1, 4}) + "\n";
}

std::string chart_text(const precision_findings& found) {
  std::vector<text_line> lines{
      {"sigma_min", "floor", "N", "overlap", "width", "bits", "bits, no overlap"}};
  for (const joint_cell& c : found.chart) {
    lines.push_back({brief(c.floor_deviation), variance_of(c.floor_deviation),
                     std::to_string(c.layers), c.layers == 1 ? "-" : fixed(c.overlap, 3),
                     fixed(c.width, 3), bits_or_none(c.bits),
                     c.thick_enough ? bits_or_none(c.bits_apart) : "too thin"});
  }
  std::string out =
      "Floor, overlap, layers and bits: the overlap that hides the edges, and none\n" +
      text_table(lines, {});
  for (const auto& sentence : joint_findings(found.joint, found.chart, 16))
    out += paragraph(sentence);
  return out + "\n";
}

}  // namespace

std::string precision_text(const precision_findings& found) {
  std::string out =
      "The fewest bits that keep every visibility within " + brief(found.tolerated) + "\n\n";
  for (const auto& curve : found.curves) out += curve_text(curve);
  if (!found.stages.empty()) out += stages_text(found);
  if (!found.on_scene.empty()) out += scene_text(found);
  if (!found.chart.empty()) out += chart_text(found);
  return out;
}

nlohmann::ordered_json precision_json(const precision_findings& found) {
  using nlohmann::ordered_json;
  ordered_json all{{"tolerated", found.tolerated}};
  all["curves"] = ordered_json::array();
  for (const auto& curve : found.curves) {
    ordered_json points = ordered_json::array();
    for (const needed_bits& p : curve) {
      points.push_back({{"technique", technique_of(p)},
                        {"layers", p.layers},
                        {"predicted", p.predicted},
                        {"variance_share", p.variance_share},
                        {"found", p.found},
                        {"predicted_bits", p.predicted_whole},
                        {"found_bits", p.found_whole},
                        {"witness",
                         {{"near", p.witness.texels.near},
                          {"far", p.witness.texels.far},
                          {"receiver", p.witness.texels.receiver},
                          {"stored", p.witness.error.stored},
                          {"exact", p.witness.error.exact}}}});
    }
    const needed_bits& first = curve.front();
    all["curves"].push_back(
        {{"floor_deviation", first.question.floor_deviation},
         {"roundings", first.question.roundings},
         {"overlap", first.overlap},
         {"unit", first.floating ? "significand" : "unorm"},
         {"slope_found", line_through(curve, &needed_bits::found).slope},
         {"slope_predicted", line_through(curve, &needed_bits::predicted).slope},
         {"deviations", deviations(curve)},
         {"points", points}});
  }
  all["stages"] = ordered_json::array();
  for (const stage_bits& s : found.stages) {
    all["stages"].push_back({{"technique", s.technique},
                             {"stage", s.stage},
                             {"layers", s.layers},
                             {"floor_deviation", s.floor_deviation},
                             {"unit", s.unit},
                             {"predicted_bits", s.predicted},
                             {"found_bits", s.found},
                             {"witness_error", s.witness_error}});
  }
  if (!found.scene.empty()) {
    all["scene"] = found.scene;
    all["on_scene"] = ordered_json::array();
    for (const scene_bits& s : found.on_scene) {
      const ordered_json predicted = s.bounded ? ordered_json(s.predicted) : ordered_json();
      all["on_scene"].push_back({{"technique", s.technique},
                                 {"stage", s.stage},
                                 {"layers", s.layers},
                                 {"min_variance", s.min_variance},
                                 {"unit", s.unit},
                                 {"predicted_bits", predicted},
                                 {"found_bits", s.found},
                                 {"error", s.error},
                                 {"error_below", s.error_below}});
    }
  }
  all["joint"] = ordered_json::array();
  for (const joint_cell& c : found.chart) {
    all["joint"].push_back({{"floor_deviation", c.floor_deviation},
                            {"layers", c.layers},
                            {"overlap", c.overlap},
                            {"width", c.width},
                            {"bits", c.bits},
                            {"bits_without_overlap", c.bits_apart},
                            {"thick_enough", c.thick_enough}});
  }
  if (!found.chart.empty()) all["joint_findings"] = joint_findings(found.joint, found.chart, 16);
  return all;
}

std::string precision_csv(const precision_findings& found) {
  std::string out =
      "where,technique,stage,layers,floor_deviation,roundings,unit,predicted,found,predicted_bits,"
      "found_bits\n";
  const auto line = [&](std::initializer_list<std::string> cells) {
    std::string text;
    for (const auto& cell : cells) text += (text.empty() ? "" : ",") + cell;
    out += text + "\n";
  };
  for (const auto& curve : found.curves) {
    for (const needed_bits& p : curve) {
      line({"footprints", technique_of(p), "store", std::to_string(p.layers),
            shortest(p.question.floor_deviation), std::to_string(p.question.roundings),
            p.floating ? "significand" : "unorm", shortest(p.predicted), shortest(p.found),
            std::to_string(p.predicted_whole), std::to_string(p.found_whole)});
    }
  }
  const auto whole = [&](const std::string& where, const auto& s, double deviation,
                         const std::string& predicted) {
    line({where, s.technique, s.stage, std::to_string(s.layers), shortest(deviation), "1", s.unit,
          predicted, std::to_string(s.found), predicted, std::to_string(s.found)});
  };
  for (const stage_bits& s : found.stages)
    whole("footprints", s, s.floor_deviation, std::to_string(s.predicted));
  for (const scene_bits& s : found.on_scene)
    whole(found.scene, s, std::sqrt(s.min_variance), s.bounded ? std::to_string(s.predicted) : "");
  return out;
}

}  // namespace bitshade
