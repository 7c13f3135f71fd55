// `bitshade precision`: the fewest bits that keep an error, predicted and found.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>

#include "command/commands.hpp"
#include "command/filter_options.hpp"
#include "command/option_use.hpp"
#include "command/precision_scene.hpp"
#include "command/scene_options.hpp"
#include "command/study_options.hpp"
#include "io/atomic_file.hpp"
#include "io/build.hpp"
#include "io/error.hpp"
#include "io/numbers.hpp"
#include "io/text.hpp"
#include "report/precision.hpp"

namespace bitshade::command {
namespace {

constexpr const char* filter_group = "Filters on the scene";

struct options {
  std::string scene;
  std::shared_ptr<scene_options> how;
  std::string techniques = "lvsm,savsm,evsm2,evsm4";
  std::string layers = "1,2,4,8", floors = "1e-4,9e-6", roundings = "1,3";
  double tolerated = 1.0 / 255, overlap = 0, exponent = 5, reach = 0;
  bool adversarial = false, joint = false, json = false;
  configuration filters;  ///< of the search on a scene
  std::string out;
  std::string arguments;
  const CLI::App* app = nullptr;

  bool everything() const { return scene.empty() && !adversarial && !joint; }
};

std::vector<int> whole_numbers(const std::string& text, const std::string& option, int most) {
  std::vector<int> all;
  for (const double n : parse_numbers(text, option, 1, 16)) {
    if (n != std::floor(n) || n < 1 || n > most) {
      throw usage_error(option + " takes whole numbers from 1 to " + std::to_string(most) +
                        " between commas, but not " + shortest(n));
    }
    all.push_back(static_cast<int>(n));
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

struct asked {
  std::vector<int> layers, roundings;
  std::vector<double> floors;
};

asked checked(const options& given) {
  asked a;
  a.layers = whole_numbers(given.layers, "--layers", 256);
  a.roundings = whole_numbers(given.roundings, "--roundings", 6);
  a.floors = parse_numbers(given.floors, "--min-variance", 1, 8);
  for (const double f : a.floors) {
    if (!(f >= 1e-12 && f <= 0.01)) {
      throw usage_error(
          "--min-variance " + shortest(f) +
          " is outside 1e-12 to 0.01: without a floor no number of bits suffices, and "
          "a higher one hides every shadow");
    }
  }
  if (!(given.tolerated > 0 && given.tolerated < 0.5)) {
    throw usage_error("--tolerated " + shortest(given.tolerated) +
                      " is outside 0 to 0.5: one step of an 8-bit display is 0.00392");
  }
  if (!(given.overlap >= 0 && given.overlap <= 0.5)) {
    throw usage_error("--overlap " + shortest(given.overlap) + " is outside 0 to 0.5");
  }
  if (!(given.exponent > 0 && given.exponent <= 40)) {
    throw usage_error("--exponent " + shortest(given.exponent) + " is outside 0 to 40");
  }
  if (!(given.reach >= 0 && given.reach <= 0.5)) {
    throw usage_error("--reach " + shortest(given.reach) + " is outside 0 to 0.5");
  }
  return a;
}

scene_question question_of(const options& given, const asked& a) {
  configuration base = given.filters;
  base.exponent = base.negative_exponent = given.exponent;
  base.overlap = given.overlap;
  return {base, techniques_of(given.techniques), a.layers, a.floors};
}

/// Refuses options of a part that is not asked for.
void refuse_idle(const options& given, const asked& a) {
  const auto only = [&](std::initializer_list<const char*> names, const std::string& what) {
    for (const char* name : names) {
      if (given.app->count(name) > 0) throw usage_error(std::string(name) + " " + what);
    }
  };
  const bool footprints = given.adversarial || given.everything();
  if (!given.joint && !given.everything()) only({"--reach"}, "is for the chart of --joint: give it");
  if (!footprints) {
    only({"--roundings"}, "is for the search on footprints: give --adversarial, too");
    if (given.scene.empty()) {
      only({"--overlap", "--exponent"},
           "is for searches: give a SCENE or --adversarial, or leave out --joint");
    }
  }
  if (!given.scene.empty()) {
    check_use(*given.app, cells_on_scene(question_of(given, a)), measured::alone);
    return;
  }
  std::string idle = given.how->given.empty() ? "" : *given.how->given.begin();
  for (const CLI::Option* option : given.app->get_options()) {
    if (option->get_group() == filter_group && option->count() > 0) idle = option->get_name();
  }
  if (given.app->count("--techniques") > 0) idle = "--techniques";
  if (!idle.empty()) throw usage_error(idle + " is for the search on a scene: give a SCENE");
}

/// One curve a floor and number of roundings; layers that the floor fills are left out.
void search_curves(const options& given, const asked& a, precision_findings& found) {
  for (const double floor : a.floors) {
    for (const int k : a.roundings) {
      std::vector<bit_search::needed_bits> curve;
      for (const int n : a.layers) {
        precision_question q;
        q.tolerated = given.tolerated;
        q.floor_deviation = std::sqrt(floor);
        q.roundings = k;
        try {
          curve.push_back(bit_search::bits_needed(q, n, given.overlap));
        } catch (const std::invalid_argument& e) {
          if (curve.empty()) throw usage_error(e.what());
        }
      }
      found.curves.push_back(std::move(curve));
    }
  }
}

void search_stages(const options& given, const asked& a, precision_findings& found) {
  for (const double floor : a.floors) {
    bit_search::stage_question q;
    q.tolerated = given.tolerated;
    q.floor_deviation = std::sqrt(floor);
    q.overlap = given.overlap;
    q.exponent = given.exponent;
    for (const int n : a.layers) {
      q.layers = n;
      if (q.floor_deviation * n > 0.2) continue;
      found.stages.push_back(bit_search::weight_bits(q));
      found.stages.push_back(bit_search::shading_bits(q));
    }
    q.layers = 1;
    if (q.floor_deviation * given.exponent < 0.4) found.stages.push_back(bit_search::evsm_bits(q));
  }
}

void search_on_scene(const options& given, const asked& a, precision_findings& found) {
  const auto cells = cells_on_scene(question_of(given, a));
  const frame input = load_for(given.scene, *given.how, cells);
  found.scene = given.scene;
  search_cells(input, cells, given.how->threads, found);
}

void answer(const options& given) {
  const asked a = checked(given);
  refuse_idle(given, a);
  const std::string command = "bitshade precision" +
                              (given.scene.empty() ? "" : " " + shell_quoted(given.scene)) +
                              given.arguments;
  const std::filesystem::path folder = given.out;
  precision_findings found;
  found.tolerated = given.tolerated;
  const bool everything = given.everything();
  if (!given.out.empty()) make_output_folder(folder);
  if (everything || given.adversarial) {
    search_curves(given, a, found);
    search_stages(given, a, found);
  }
  if (!given.scene.empty()) search_on_scene(given, a, found);
  if (everything || given.joint) {
    found.joint.tolerated = given.tolerated;
    found.joint.reach = given.reach;
    found.joint.layers = a.layers;
    found.joint.deviations.clear();
    for (const double f : a.floors) found.joint.deviations.push_back(std::sqrt(f));
    found.chart = bit_search::joint_chart(found.joint);
  }
  if (!given.out.empty()) {
    report_head head{command, program_version(), compiler_description(), machine_description(),
                     std::to_string(given.how->seed)};
    head.files = "precision.csv and precision.json beside this page";
    std::string body;
    for (const report_part& part : precision_parts(found, command)) {
      body += "<h2>" + part.title + "</h2><p>" + part.text + "</p>" + part.body;
    }
    write_file(folder / "precision.csv", precision_csv(found));
    write_file(folder / "precision.json", precision_json(found).dump(1) + "\n");
    write_file(folder / "precision.html", html_page(head, "Bits that a map needs", body));
  }
  if (given.json) {
    std::cout << precision_json(found).dump(1) << '\n';
    return;
  }
  std::cout << precision_text(found);
  if (!given.out.empty()) {
    std::cout << "The plots are in " << (folder / "precision.html").string()
              << "; CSV and JSON lie beside it.\n";
  }
}

}  // namespace

void add_precision(CLI::App& app) {
  auto given = std::make_shared<options>();
  CLI::App* command = app.add_subcommand(
      "precision",
      "The fewest bits that keep an error, predicted and found\n"
      "Says for each stage, number of layers and floor how many bits keep every visibility within "
      "an error: by the bound, which holds for every footprint, and by a search for footprints "
      "that break fewer, judged in exact arithmetic; on a scene also of summed-area tables, "
      "running sums apart and all stages together. Also draws floor, overlap, layers and bits "
      "together.");
  options* const o = given.get();
  command->add_option(
      "SCENE", o->scene,
      "Search on this scene too, each stage alone in the format: " + scene_argument_help());
  command->add_option("--techniques,--technique", o->techniques,
                      "Searched on the scene; lvsm in all numbers of layers")
      ->capture_default_str()
      ->option_text("LIST");
  command->add_option("--layers", o->layers, "Layers of an LVSM")
      ->capture_default_str()
      ->option_text("LIST");
  command->add_option("--min-variance", o->floors, "Floors (sigma_min^2), in depth^2")
      ->capture_default_str()
      ->option_text("LIST");
  command
      ->add_option("--roundings", o->roundings,
                   "Roundings on the way: 1 the store, 3 with a blur of two passes")
      ->capture_default_str()
      ->option_text("LIST");
  command->add_option("--tolerated", o->tolerated, "Error of visibility to keep")
      ->default_str("1/255")
      ->option_text("N");
  command->add_option("--overlap", o->overlap, "Overlap of layers (delta), in depth")
      ->capture_default_str()
      ->option_text("N");
  command
      ->add_option("--reach", o->reach,
                   "Filter radius times receiver slope, for the overlap of --joint")
      ->capture_default_str()
      ->option_text("N");
  command->add_option("--exponent", o->exponent, "c of ESM and EVSM")
      ->capture_default_str()
      ->option_text("N");
  command->add_flag("--adversarial", o->adversarial, "The search on footprints, with a SCENE too");
  command->add_flag("--joint", o->joint, "Floor, overlap, layers and bits together");
  command->add_option("--out", o->out, "Folder for precision.html, .csv and .json")
      ->option_text("DIR");
  command->add_flag("--json", o->json, "Print JSON instead of text");
  add_filter_options(*command, o->filters, filter_group);
  o->app = command;
  given->how = add_scene_options(*command);
  command->footer(
      "Examples:\n"
      "  bitshade precision garden --size 256 --layers 1,2 --min-variance 1e-4\n"
      "  bitshade precision --layers 1,2,4,8 --min-variance 1e-4 --out bits\n"
      "  bitshade precision --joint --min-variance 9e-4,1e-4,9e-6 --layers 1,2,4,8,16");
  command->callback([given, command] {
    given->arguments = arguments_of(*command, {"json"});
    answer(*given);
  });
}

}  // namespace bitshade::command
