// What layers, filters and techniques cost, as ratios within one run: claims C22 and C24.
//
// Every cell is run in turn, several times over, and the least of its times counts: map generation
// and shading apart, rounding to the emulated format left out. Results are checked first.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "run/lloyd.hpp"
#include "run/pipeline.hpp"
#include "run/splits.hpp"
#include "scene/scene.hpp"

using namespace bitshade;

namespace {

struct timed {
  std::string name;
  configuration how;
  plan effects;
  double map = std::numeric_limits<double>::infinity();
  double shade = std::numeric_limits<double>::infinity();
};

timed named(std::string name, const frame& scene, const configuration& how) {
  return {std::move(name), how, make_plan(scene, how, 1)};
}

/// Times all cells; returns false, with a sentence, where a light is none.
bool time_all(const frame& scene, std::vector<timed>& cells, int rounds) {
  for (int round = 0; round < rounds; ++round) {
    for (timed& t : cells) {
      const cell got = run_pipeline(scene, t.how, t.effects, 1);
      t.map = std::min(t.map, got.map_seconds);
      t.shade = std::min(t.shade, got.shade_seconds);
      if (round > 0) continue;
      for (const double p : got.visibility) {
        if (p < 0 || p > 1) {
          std::fprintf(stderr, "%s: a visibility of %g\n", t.name.c_str(), p);
          return false;
        }
      }
    }
  }
  return true;
}

void print(const char* title, const std::vector<timed>& cells) {
  std::printf("\n%s\n%-34s %10s %8s %10s %8s\n", title, "", "map ms", "ratio", "shade ms", "ratio");
  for (const timed& t : cells) {
    std::printf("%-34s %10.2f %8.2f %10.2f %8.2f\n", t.name.c_str(), t.map * 1e3,
                t.map / cells.front().map, t.shade * 1e3, t.shade / cells.front().shade);
  }
}

configuration lvsm(int layers, int anisotropy) {
  configuration how;
  how.method = layers == 0 ? technique::vsm : technique::lvsm;
  how.layers = std::max(layers, 1);
  how.filter = anisotropy > 1 ? texel_filter::trilinear : texel_filter::bilinear;
  how.max_anisotropy = anisotropy;
  return how;
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 5;
  scene_options options;
  options.map_size = 1024;
  options.view_width = 1920;
  options.view_height = 1200;
  const frame slope = load_input("slope", options);

  std::vector<timed> layers{named("vsm", slope, lvsm(0, 16))};
  for (const int n : {1, 2, 4, 6, 8, 14}) {
    layers.push_back(named("lvsm, " + std::to_string(n) + " layers", slope, lvsm(n, 16)));
  }
  if (!time_all(slope, layers, rounds)) return 1;
  print("Layers against a VSM: slope, 1024^2, 1920 x 1200, 16x anisotropy, unorm16", layers);
  std::printf("shading at 14 layers over a VSM: %.2f (wanted: at most 1.30)\n",
              layers.back().shade / layers.front().shade);

  options.view_width = 960;
  options.view_height = 600;
  const frame garden = load_input("garden", options);
  std::vector<timed> techniques{named("vsm", garden, lvsm(0, 1))};
  for (const auto method : {technique::evsm2, technique::evsm4, technique::esm}) {
    configuration how = lvsm(0, 1);
    how.method = method;
    techniques.push_back(named(std::string(name_of(method)), garden, how));
  }
  configuration pcf = lvsm(0, 1);
  pcf.method = technique::pcf;
  techniques.push_back(named("pcf, 9 x 9", garden, pcf));
  configuration msm = lvsm(0, 1);
  msm.method = technique::msm;
  techniques.insert(techniques.end() - 1, named("msm", garden, msm));
  if (!time_all(garden, techniques, rounds)) return 1;
  print("Techniques against a VSM: garden, 1024^2, 960 x 600, blur of 9 taps", techniques);
  const auto whole = [](const timed& t) { return t.map + t.shade; };
  std::printf("pcf 9 x 9 over a blurred evsm4, whole frame: %.2f\n",
              whole(techniques.back()) / whole(techniques[2]));

  // The columns of the source's comparison: N layers beside 2N terms, in 8 bits.
  std::vector<timed> series{named("vsm", garden, lvsm(0, 1))};
  for (const int n : {2, 4, 6, 8}) {
    series.push_back(named("lvsm, " + std::to_string(n) + " layers", garden, lvsm(n, 1)));
  }
  for (const int terms : {4, 8, 12, 16}) {
    configuration csm = lvsm(0, 1);
    csm.method = technique::csm;
    csm.format = "unorm8";
    csm.terms = terms;
    series.push_back(named("csm, " + std::to_string(terms) + " terms, unorm8", garden, csm));
  }
  if (!time_all(garden, series, rounds)) return 1;
  print("Layers against terms: garden, 1024^2, 960 x 600, blur of 9 taps", series);

  configuration lloyd = lvsm(4, 1);
  lloyd.splits = split_rule::lloyd;
  double least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < rounds; ++round) {
    const auto start = std::chrono::steady_clock::now();
    const auto splits = splits_of(garden, lloyd, 1).splits;
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    if (!std::is_sorted(splits.begin(), splits.end())) return 1;
    least = std::min(least, took.count());
  }
  // What an engine does a frame: samples, sums, and two splits moved.
  lloyd.lloyd.steps.splits_per_frame = 2;
  double step = std::numeric_limits<double>::infinity();
  for (int round = 0; round < rounds; ++round) {
    lloyd_relaxation splits({0.25, 0.5, 0.75}, lloyd.lloyd.steps);
    const auto start = std::chrono::steady_clock::now();
    const lloyd_field field(garden, lloyd, 1);
    field.step(splits);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    if (!std::is_sorted(splits.interior().begin(), splits.interior().end())) return 1;
    step = std::min(step, took.count());
  }
  std::printf(
      "\nLloyd's update of a frame, sampled and two splits moved: %.2f ms, %.2f of a VSM's map\n",
      step * 1e3, step / techniques.front().map);
  std::printf(
      "Lloyd's splits, sampled, sorted and relaxed to rest: %.2f ms, %.2f of a VSM's map\n",
      least * 1e3, least / techniques.front().map);
  return 0;
}
