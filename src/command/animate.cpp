#include "command/animate.hpp"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "command/scene_options.hpp"
#include "io/atomic_file.hpp"
#include "io/error.hpp"
#include "io/text.hpp"
#include "report/cell_pictures.hpp"
#include "report/drawing.hpp"
#include "report/folder.hpp"
#include "run/split_path.hpp"
#include "run/study.hpp"

namespace bitshade::command {
namespace {

namespace fs = std::filesystem;

/// One frame as the CSV, the plot and the summary need it.
struct finished_frame {
  double time = 0;
  split_place place;
  measures figures;
};

/// "0007": wide enough for the last frame, four digits at least.
std::string number_of(int frame, int frames) {
  const std::string last = std::to_string(frames - 1), text = std::to_string(frame);
  return std::string(std::max<std::size_t>(4, last.size()) - text.size(), '0') + text;
}

std::string csv_of(const std::vector<finished_frame>& frames) {
  std::size_t splits = 0;
  for (const auto& f : frames) splits = std::max(splits, f.place.interior.size());
  std::string out = "frame,time";
  for (std::size_t i = 1; i <= splits; ++i) out += ",split_" + std::to_string(i);
  out += ",largest_move,teleportations,cost,least_cost,total_error_rmse,format_error_rmse,"
         "bleed_area,acne_area\n";
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const auto& f = frames[k];
    out += std::to_string(k) + "," + shortest(f.time);
    for (std::size_t i = 0; i < splits; ++i)  // a rule may find fewer splits than asked for
      out += "," + (i < f.place.interior.size() ? shortest(f.place.interior[i]) : "");
    out += "," + shortest(f.place.move) + "," + std::to_string(f.place.teleportations);
    for (const double x : {f.place.cost, f.place.least, f.figures.total.rmse, f.figures.format.rmse,
                           f.figures.bleed_area, f.figures.acne_area})
      out += "," + shortest(x);
    out += '\n';
  }
  return out;
}

std::string drawing_of(const std::string& title, const std::vector<finished_frame>& frames) {
  plot path{title + ": the splits' path", {"frame", false, {}}, {"depth of a split", false, {}}, {}};
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const auto& splits = frames[k].place.interior;
    for (std::size_t i = 0; i < splits.size(); ++i) {
      if (path.lines.size() <= i)
        path.lines.push_back({"split " + std::to_string(i + 1), static_cast<int>(i), true, {}, {}});
      path.lines[i].points.emplace_back(static_cast<double>(k), splits[i]);
    }
  }
  for (series& s : path.lines) s.marks = frames.size() <= 48;
  return svg_file(path);
}

nlohmann::ordered_json json_of(const std::vector<finished_frame>& frames) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const auto& f : frames)
    list.push_back({{"time", f.time},
                    {"splits", f.place.interior},
                    {"largest_move", f.place.move},
                    {"teleportations", f.place.teleportations},
                    {"cost", f.place.cost},
                    {"least_cost", f.place.least},
                    {"total_error_rmse", f.figures.total.rmse},
                    {"format_error_rmse", f.figures.format.rmse},
                    {"bleed_area", f.figures.bleed_area},
                    {"acne_area", f.figures.acne_area}});
  return list;
}

/// The cost over the least cost, on average and at most, over frames where there is any.
std::string cost_of(const std::vector<finished_frame>& frames) {
  double sum = 0, most = 0;
  int count = 0;
  for (const auto& f : frames) {
    if (!(f.place.least > 0)) continue;
    const double ratio = f.place.cost / f.place.least;
    sum += ratio;
    most = std::max(most, ratio);
    ++count;
  }
  if (count == 0) return "";
  return "splits: " + brief(sum / count, 4) + " x the least cost on average, at most " +
         brief(most, 4) + " x; " + std::to_string(frames.back().place.teleportations) +
         " teleportations\n";
}

}  // namespace

void animate(const animation& given) {
  const configuration& c = given.cell;
  const std::string name = label_of(c);
  const std::string stem = cell_stem(given.scene, c);
  scene_options how = given.how;
  how.time = 0;
  check_study_memory(load_for(given.scene, how, {c}), {c});

  const fs::path folder = given.out;
  make_output_folder(folder);
  sweep_leftovers(folder);
  database results(folder / "series.sqlite");
  split_follower follower(c, given.steps);
  std::vector<finished_frame> frames;
  std::vector<std::string> kinds;
  std::size_t computed = 0;
  progress bar;
  bar.begin(static_cast<std::size_t>(given.frames));
  for (int k = 0; k < given.frames; ++k) {
    bar.at(given.scene + ", frame " + std::to_string(k));
    how.time = static_cast<double>(k) / given.frames;
    const frame input = load_for(given.scene, how, {c});
    const configuration now = follower.follow(input, how.threads);
    progress silent(false);
    study_request request;
    request.cells = {now};
    request.description = "{}";
    request.threads = how.threads;
    request.shaded = true;
    const study_result done = run_study(input, request, results, silent);
    const row& r = done.rows.front();
    kinds.clear();
    for (const auto& [kind, png] : results.pictures(r.key)) {
      write_file(folder / (stem + number_of(k, given.frames) + "-" + kind + ".png"), png);
      kinds.push_back(kind);
    }
    frames.push_back({*how.time, follower.place_of(input, r.splits, how.threads), r.figures});
    computed += done.computed;
    bar.step(done.computed > 0);
  }
  bar.end();

  const bool layered = c.method == technique::lvsm && c.layers > 1;
  const fs::path table = folder / (stem + "series.csv"), drawing = folder / (stem + "splits.svg");
  write_file(table, csv_of(frames));
  if (layered) write_file(drawing, drawing_of(given.scene + ", " + name, frames));
  if (given.json) {
    std::cout << nlohmann::ordered_json{{"scene", given.scene},
                                        {"configuration", c.key()},
                                        {"steps_a_frame", given.steps},
                                        {"csv", table.string()},
                                        {"frames", json_of(frames)}}
                     .dump(1)
              << '\n';
    return;
  }
  std::cout << name << ", " << given.frames << " frames of " << given.scene << ": " << computed
            << " computed, " << static_cast<std::size_t>(given.frames) - computed
            << " taken from series.sqlite\n"
            << cost_of(frames) << "  " << table.string() << "  (splits and errors, a line a frame)\n";
  if (layered) std::cout << "  " << drawing.string() << "  (the splits' path)\n";
  for (const std::string& kind : kinds)
    std::cout << "  " << (folder / (stem + "*-" + kind + ".png")).string() << '\n';
}

}  // namespace bitshade::command
