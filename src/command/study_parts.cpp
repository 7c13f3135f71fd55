#include "command/study_parts.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "command/precision_scene.hpp"
#include "io/build.hpp"
#include "io/error.hpp"
#include "io/text.hpp"
#include "report/blame.hpp"
#include "report/precision.hpp"

namespace bitshade::command {
namespace {

std::string bits_or_none(int bits) { return bits == 0 ? "none" : std::to_string(bits); }

/// "Bits of a unorm that keep every visibility within 0.00392, whatever the footprint: 25 for 1
/// layer, ..; on this scene: ..; of a summed-area table on this scene: store 17, sums 31 .."
std::string sentence_of(const precision_findings& found) {
  std::string text = "Bits of a unorm that keep every visibility within " + brief(found.tolerated);
  if (!found.curves.empty()) {
    const auto& curve = found.curves.front();
    text += ", whatever the footprint:";
    for (std::size_t i = 0; i < curve.size(); ++i)
      text += (i ? ", " : " ") + std::to_string(curve[i].predicted_whole) + " for " +
              std::to_string(curve[i].layers) + (curve[i].layers == 1 ? " layer" : " layers");
  }
  std::string layers, table;
  for (const bit_search::scene_bits& s : found.on_scene) {
    if (s.technique == name_of(technique::savsm)) {
      table += (table.empty() ? " " : ", ") + bits_or_none(s.found) + " of a " + s.unit +
               (s.stage == "all" ? " for all stages" : " for the " + s.stage);
    } else {
      layers += (layers.empty() ? " " : ", ") + bits_or_none(s.found) + " for " +
                std::to_string(s.layers);
    }
  }
  if (!layers.empty()) text += "; on this scene:" + layers;
  if (!table.empty()) text += "; of a summed-area table on this scene:" + table;
  return text + ".";
}

/// Whether bits are searched with this floor.
bool searchable(double floor) { return floor >= 1e-12 && floor <= 0.01; }

/// Bits against layers, on footprints.
void search_curves(const configuration& base, const std::vector<int>& layers,
                   precision_findings& found) {
  for (const int roundings : {1, 3}) {
    std::vector<bit_search::needed_bits> curve;
    for (const int n : layers) {
      precision_question question;
      question.tolerated = found.tolerated;
      question.floor_deviation = std::sqrt(base.min_variance);
      question.roundings = roundings;
      try {
        curve.push_back(bit_search::bits_needed(question, n, base.overlap));
      } catch (const std::invalid_argument&) {
        continue;  // the floor fills the layer
      }
    }
    if (!curve.empty()) found.curves.push_back(std::move(curve));
  }
}

}  // namespace

report_part blamed(const study_job& job, const job_result& result, std::size_t input) {
  std::vector<std::pair<double, const asked_cell*>> cells;
  std::map<std::string, double> errors;
  for (const row& r : result.sections[input].rows)
    errors[r.configuration] = r.figures.format.rmse;
  for (const asked_cell& cell : job.cells)
    if (!cell.what.exact()) cells.emplace_back(errors.at(cell.what.key()), &cell);
  std::stable_sort(cells.begin(), cells.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  const frame& scene = result.frames[input];
  std::string why = "give --formats one that is stored, such as unorm16";
  for (const auto& [error, cell] : cells) {
    try {
      const blame found = blame_of(scene, cell->what, {}, job.scene->threads);
      const std::string command =
          "bitshade blame " + shell_quoted(job.scenes[input]) + cell->arguments;
      report_part part = blame_part(found, blame_maps(found, scene.view_width, scene.view_height),
                                    label_of(cell->what), cell->what.format, command);
      nlohmann::ordered_json data{{"configuration", cell->what.key()}, {"command", command}};
      data.update(blame_json(found));
      part.name = "blame";
      part.data = data.dump();
      return part;
    } catch (const usage_error& e) {
      why = e.what();
    }
  }
  throw usage_error("--blame has no configuration here that it can take apart: " + why);
}

std::vector<report_part> bits_needed(const study_job& job, const job_result& result,
                                     std::size_t input) {
  std::vector<int> layers;
  std::optional<configuration> layered, summed;  // the first of each
  for (const asked_cell& cell : job.cells) {
    const configuration& c = cell.what;
    if (c.method == technique::savsm && !summed) summed = c;
    if (c.method != technique::vsm && c.method != technique::lvsm) continue;
    if (!layered) layered = c;
    layers.push_back(c.layers);
  }
  std::sort(layers.begin(), layers.end());
  layers.erase(std::unique(layers.begin(), layers.end()), layers.end());
  if (!layered && !summed)
    throw usage_error("--precision needs a VSM, an LVSM or a SAT-VSM: add one to --techniques");
  const configuration& any = layered ? *layered : *summed;
  if (!searchable(any.min_variance) || (summed && !searchable(summed->min_variance)))
    throw usage_error("--precision needs a floor from 1e-12 to 0.01: give --min-variance");

  const frame& scene = result.frames[input];
  precision_findings found;
  found.scene = job.scenes[input];
  std::string command = "bitshade precision " + shell_quoted(found.scene);
  if (layered) {
    command += " --adversarial --layers ";
    for (std::size_t i = 0; i < layers.size(); ++i)
      command += (i ? "," : "") + std::to_string(layers[i]);
    search_curves(*layered, layers, found);
  }
  command += std::string(" --min-variance ") + shortest(any.min_variance) + " --techniques " +
             (layered ? summed ? "lvsm,savsm" : "lvsm" : "savsm");
  for (const int n : layers) {
    configuration c = *layered;
    c.method = n == 1 ? technique::vsm : technique::lvsm;
    c.layers = n;
    c.noise_floor = false;
    if (n == 1 || c.splits == split_rule::manual)
      c.splits = split_rule::uniform, c.manual_splits.clear();
    found.on_scene.push_back(
        bit_search::search_scene(scene, c, {{stage::store, bit_search::bit_unit::unorm}},
                                 found.tolerated, job.scene->threads)
            .front());
  }
  if (summed) {
    summed->noise_floor = false;
    search_cells(scene, {*summed}, job.scene->threads, found);
  }
  std::vector<report_part> parts = precision_parts(found, command);
  nlohmann::ordered_json data{{"command", command}};
  data.update(precision_json(found));
  parts.front().finding = sentence_of(found);
  parts.front().name = "precision";
  parts.front().data = data.dump();
  return parts;
}

}  // namespace bitshade::command
