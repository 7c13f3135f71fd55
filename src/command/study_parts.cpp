#include "command/study_parts.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "io/build.hpp"
#include "io/error.hpp"
#include "io/text.hpp"
#include "report/blame.hpp"
#include "report/precision.hpp"

namespace bitshade::command {
namespace {

/// "A unorm's bits that keep every visibility within 0.00392, with a floor of 1e-5: 1 layer 25, ..."
std::string sentence_of(const precision_findings& found) {
  std::string text = "Bits of a unorm that keep every visibility within " + brief(found.tolerated);
  if (!found.curves.empty()) {
    const auto& curve = found.curves.front();
    text += ", whatever the footprint:";
    for (std::size_t i = 0; i < curve.size(); ++i)
      text += (i ? ", " : " ") + std::to_string(curve[i].predicted_whole) + " for " +
              std::to_string(curve[i].layers) + (curve[i].layers == 1 ? " layer" : " layers");
  }
  text += "; on this scene:";
  for (std::size_t i = 0; i < found.on_scene.size(); ++i) {
    const auto& s = found.on_scene[i];
    text += (i ? ", " : " ") + (s.found == 0 ? "none" : std::to_string(s.found)) + " for " +
            std::to_string(s.layers);
  }
  return text + ".";
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
      return blame_part(found, blame_maps(found, scene.view_width, scene.view_height),
                        label_of(cell->what), cell->what.format, command);
    } catch (const usage_error& e) {
      why = e.what();
    }
  }
  throw usage_error("--blame has no configuration here that it can take apart: " + why);
}

std::vector<report_part> bits_needed(const study_job& job, const job_result& result,
                                     std::size_t input) {
  std::vector<int> layers;
  configuration base;
  for (const asked_cell& cell : job.cells)
    if (cell.what.method == technique::vsm || cell.what.method == technique::lvsm) {
      if (layers.empty()) base = cell.what;
      layers.push_back(cell.what.layers);
    }
  std::sort(layers.begin(), layers.end());
  layers.erase(std::unique(layers.begin(), layers.end()), layers.end());
  if (layers.empty())
    throw usage_error("--precision needs a VSM or an LVSM: add one to --techniques");
  if (!(base.min_variance >= 1e-12 && base.min_variance <= 0.01))
    throw usage_error("--precision needs a floor from 1e-12 to 0.01: give --min-variance");

  precision_findings found;
  std::string command = "bitshade precision " + shell_quoted(job.scenes[input]) +
                        " --adversarial --min-variance " + shortest(base.min_variance) +
                        " --layers ";
  for (std::size_t i = 0; i < layers.size(); ++i)
    command += (i ? "," : "") + std::to_string(layers[i]);
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
  found.scene = job.scenes[input];
  for (const int n : layers) {
    configuration c = base;
    c.method = n == 1 ? technique::vsm : technique::lvsm;
    c.layers = n;
    c.noise_floor = false;
    if (n == 1 || c.splits == split_rule::manual)
      c.splits = split_rule::uniform, c.manual_splits.clear();
    found.on_scene.push_back(bit_search::search_scene(result.frames[input], c, stage::store,
                                                      found.tolerated, job.scene->threads));
  }
  std::vector<report_part> parts = precision_parts(found, command);
  parts.front().finding = sentence_of(found);
  return parts;
}

}  // namespace bitshade::command
