// What layers, filters and techniques cost, as ratios within one run: claims C22 and C24.
//
// Every cell is run in turn, several times over, and the least of its times counts: map generation
// and shading apart, rounding to the emulated format left out. Results are checked first.
//
//   bench_shadow [ROUNDS [layers|techniques|terms|lloyd]]     all parts, or one
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

frame scene_of(const char* name, int width, int height) {
  scene_options options;
  options.map_size = 1024;
  options.view_width = width;
  options.view_height = height;
  return load_input(name, options);
}

/// C22: generation is linear in the layers, shading needs one sample.
bool layers_against_vsm(int rounds) {
  const frame slope = scene_of("slope", 1920, 1200);
  std::vector<timed> layers{named("vsm", slope, lvsm(0, 16))};
  for (int n = 1; n <= 14; ++n) {
    layers.push_back(named("lvsm, layers: " + std::to_string(n), slope, lvsm(n, 16)));
    for (const std::size_t users : layers.back().effects.layer_users) {
      if (users == 0) {
        std::fprintf(stderr, "a layer of %d is not seen: the figures would not be those asked\n", n);
        return false;
      }
    }
  }
  if (!time_all(slope, layers, rounds)) return false;
  print("Layers against a VSM: slope, 1024^2, 1920 x 1200, 16x anisotropy, unorm16", layers);
  std::printf("shading at 14 layers over a VSM: %.2f (wanted: at most 1.30)\n",
              layers.back().shade / layers.front().shade);
  return true;
}

/// C24: techniques beside each other, and a blurred EVSM beside 9 x 9 percentage-closer filtering.
bool techniques_against_vsm(const frame& garden, int rounds) {
  std::vector<timed> techniques{named("vsm", garden, lvsm(0, 1))};
  for (const auto method : {technique::evsm2, technique::evsm4, technique::esm, technique::msm,
                            technique::pcf}) {
    configuration how = lvsm(0, 1);
    how.method = method;
    techniques.push_back(named(std::string(name_of(method)), garden, how));
  }
  if (!time_all(garden, techniques, rounds)) return false;
  print("Techniques against a VSM: garden, 1024^2, 960 x 600, blur and PCF of 9 taps", techniques);
  const auto whole = [](const timed& t) { return t.map + t.shade; };
  std::printf("pcf 9 x 9 over a blurred evsm4, whole frame: %.2f\n",
              whole(techniques.back()) / whole(techniques[2]));
  return true;
}

/// The columns of the source's comparison: N layers beside 2N terms, in 8 bits.
bool layers_against_terms(const frame& garden, int rounds) {
  std::vector<timed> series{named("vsm", garden, lvsm(0, 1))};
  for (const int n : {2, 4, 6, 8}) {
    series.push_back(named("lvsm, layers: " + std::to_string(n), garden, lvsm(n, 1)));
  }
  for (const int terms : {4, 8, 12, 16}) {
    configuration csm = lvsm(0, 1);
    csm.method = technique::csm;
    csm.format = "unorm8";
    csm.terms = terms;
    series.push_back(named("csm, " + std::to_string(terms) + " terms, unorm8", garden, csm));
  }
  if (!time_all(garden, series, rounds)) return false;
  print("Layers against terms: garden, 1024^2, 960 x 600, blur of 9 taps", series);
  return true;
}

/// The least time of `rounds` calls, in seconds; below 0 where one of them was refused.
template <class Call>
double least_time(int rounds, Call call) {
  double least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < rounds; ++round) {
    const auto start = std::chrono::steady_clock::now();
    const std::vector<double> splits = call();
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    if (!std::is_sorted(splits.begin(), splits.end())) return -1;
    least = std::min(least, took.count());
  }
  return least;
}

/// Lloyd's update beside the generation of a map.
bool lloyd_against_a_map(const frame& garden, int rounds) {
  std::vector<timed> vsm{named("vsm", garden, lvsm(0, 1))};
  if (!time_all(garden, vsm, rounds)) return false;
  configuration how = lvsm(4, 1);
  how.splits = split_rule::lloyd;
  const double rest = least_time(rounds, [&] { return splits_of(garden, how, 1).splits; });
  how.lloyd.steps.splits_per_frame = 2;  // what an engine does a frame
  const double step = least_time(rounds, [&] {
    lloyd_relaxation splits({0.25, 0.5, 0.75}, how.lloyd.steps);
    lloyd_field(garden, how, 1).step(splits);
    return splits.interior();
  });
  if (rest < 0 || step < 0) return false;
  std::printf(
      "\nLloyd's update of a frame, sampled and two splits moved: %.2f ms, %.2f of a VSM's map\n"
      "Lloyd's splits, sampled, sorted and relaxed to rest: %.2f ms, %.2f of a VSM's map\n",
      step * 1e3, step / vsm.front().map, rest * 1e3, rest / vsm.front().map);
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 5;
  const std::string part = argc > 2 ? argv[2] : "";
  const auto asked = [&](const char* name) { return part.empty() || part == name; };
  if (rounds < 1 || !(part.empty() || part == "layers" || part == "techniques" || part == "terms" ||
                      part == "lloyd")) {
    std::fputs("bench_shadow [ROUNDS [layers|techniques|terms|lloyd]]\n", stderr);
    return 2;
  }
  if (asked("layers") && !layers_against_vsm(rounds)) return 1;
  if (part == "layers") return 0;
  const frame garden = scene_of("garden", 960, 600);
  return (!asked("techniques") || techniques_against_vsm(garden, rounds)) &&
                 (!asked("terms") || layers_against_terms(garden, rounds)) &&
                 (!asked("lloyd") || lloyd_against_a_map(garden, rounds))
             ? 0
             : 1;
}
