// C17 and C18: how soon Lloyd relaxation comes to rest, and what teleportation is worth.
#include <algorithm>

#include "bitshade/shadow/optimal_splits.hpp"
#include "claims/laboratory.hpp"
#include "claims/table.hpp"
#include "run/lloyd.hpp"

namespace bitshade::claims {
namespace {

lloyd_samples field_of(const frame& scene, int threads) {
  return lloyd_field(scene, {}, threads).samples();
}

std::vector<double> uniform_interior(const method& m, int layers) {
  const auto splits = m.uniform_splits(layers);
  return {splits.begin() + 1, splits.end() - 1};
}

double cost_of(const lloyd_relaxation& splits, const lloyd_samples& field) {
  return lloyd_relaxation::cost(splits.interior(), field);
}

/// Frames until the cost is within 1 % of `wanted`, at most `most`.
int frames_to(const method& m, lloyd_relaxation& splits, const lloyd_samples& field, double wanted,
              int most) {
  for (int frame = 0; frame < most; ++frame) {
    if (cost_of(splits, field) <= 1.01 * wanted) return frame;
    m.relax(splits, field);
  }
  return most;
}

void settle(const method& m, lloyd_relaxation& splits, const lloyd_samples& field, int frames) {
  for (int frame = 0; frame < frames; ++frame) m.relax(splits, field);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0 : values[values.size() / 2];
}

// C17 ---------------------------------------------------------------------------------------------

constexpr int one_second = 60;

outcome measure_convergence(laboratory& lab) {
  outcome out;
  const method& m = lab.under_test();
  std::vector<double> all_frames;
  for (const char* name : {"garden", "beams", "rts", "planes", "slope", "city"}) {
    const auto field = field_of(lab.scene(name), lab.threads());
    for (const int layers : {4, 8}) {
      lloyd_relaxation whole(uniform_interior(m, layers));
      settle(m, whole, field, 300);
      lloyd_options two;
      two.splits_per_frame = 2;
      lloyd_relaxation some(uniform_interior(m, layers), two);
      const int frames = frames_to(m, some, field, cost_of(whole, field), 1000);
      out.add(std::string(name) + ", N = " + std::to_string(layers) +
                  ": frames to within 1 % of the rest of all splits",
              frames);
      all_frames.push_back(frames);
    }
  }
  const double most = *std::max_element(all_frames.begin(), all_frames.end());
  out.add("median frames", median(all_frames));
  out.claim("within 60 frames on every scene", most <= one_second);

  // A scene that moves: from one rest to the next, two splits a frame.
  lloyd_options two;
  two.splits_per_frame = 2;
  lloyd_relaxation moving(uniform_interior(m, 4), two);
  std::vector<double> excess;
  constexpr int steps = 12;
  for (int step = 0; step <= steps; ++step) {
    const double time = static_cast<double>(step) / (10 * steps);
    const auto field =
        field_of(lab.scene("garden", {{"animation", std::to_string(time)}}), lab.threads());
    if (step == 0) settle(m, moving, field, 300);
    m.relax(moving, field);
    lloyd_relaxation rest(moving.interior());
    settle(m, rest, field, 300);
    excess.push_back(cost_of(moving, field) / cost_of(rest, field) - 1);
  }
  const double worst = *std::max_element(excess.begin(), excess.end());
  out.add("moving garden, N = 4: largest cost above the frame's own rest", 100 * worst, "%");
  out.claim("on a moving scene never more than 10 % above the frame's own rest", worst <= 0.1);
  out.condition = "the median scene counts, not the slowest to settle";
  out.provided("within 60 frames on the median scene", median(all_frames) <= one_second);
  return out;
}

// C18 ---------------------------------------------------------------------------------------------

outcome measure_teleportation(laboratory& lab) {
  outcome out;
  const method& m = lab.under_test();
  bool greatly = true, somewhere = false, never_worse = true;
  const long starts = std::max(10L, lab.tries(40));
  for (const char* name : {"garden", "beams", "rts"}) {
    const auto field = field_of(lab.scene(name), lab.threads());
    const int splits = 7;
    const double optimum =
        lloyd_relaxation::cost(optimal_splits(field, static_cast<std::size_t>(splits), 256), field);
    random_stream random = lab.stream(1801);
    std::vector<double> with, without, gain;
    for (long start = 0; start < starts; ++start) {
      // Starts that bunch up, as a camera cut leaves them: all splits in one tenth of the range.
      const double low = random.next(0, 0.9);
      std::vector<double> interior;
      for (int i = 0; i < splits; ++i) interior.push_back(on_split_grid(low + random.next() / 10));
      double cost[2];
      for (const bool teleport : {false, true}) {
        lloyd_options how;
        how.teleport = teleport;
        lloyd_relaxation relaxed(interior, how);
        settle(m, relaxed, field, 200);
        cost[teleport] = cost_of(relaxed, field);
      }
      without.push_back(cost[0] / optimum);
      with.push_back(cost[1] / optimum);
      gain.push_back(cost[0] / cost[1]);
    }
    const std::string head = std::string(name) + ", 8 layers, bunched starts: ";
    out.add(head + "median cost over the optimum, without", median(without));
    out.add(head + "median cost over the optimum, with", median(with));
    out.add(head + "median gain", median(gain));
    out.add(head + "largest gain", *std::max_element(gain.begin(), gain.end()));
    greatly = greatly && median(gain) >= 2;
    somewhere = somewhere || *std::max_element(gain.begin(), gain.end()) >= 2;
    never_worse = never_worse && median(gain) >= 1;
  }
  // Two peaks, seven splits: five have nothing to do, for ever.
  std::vector<lloyd_sample> peaks(64, {0.25, 0.01});
  peaks.resize(128, {0.75, 0.01});
  const lloyd_samples two_peaks(peaks);
  lloyd_relaxation idle(uniform_interior(m, 8));
  settle(m, idle, two_peaks, 1000);
  out.add("2 peaks, 7 splits: teleportations in 1000 frames", idle.teleportations());
  out.claim("on every scene it at least halves the cost of the median bunched start", greatly);
  out.claim("with more splits than peaks it comes to rest", idle.teleportations() < 10);
  out.condition = "splits start, or end up, where no sample is";
  out.provided("it halves the cost of some start at least, and raises no scene's median",
               somewhere && never_worse);
  out.provided("with more splits than peaks it comes to rest", idle.teleportations() < 10);
  return out;
}

}  // namespace

claim convergence_claim() {
  return {"C17",
          "Lloyd relaxation converges fast even when only two splits move in a frame.",
          "[LauritzenMcCool08] section 5",
          "Six scenes from uniform splits: frames until the cost is within 1 % of where all splits "
          "at once come to rest; and a moving garden.",
          measure_convergence,
          {}};
}

claim teleportation_claim() {
  return {"C18",
          "Teleporting idle splits greatly improves the solution.",
          "[LauritzenMcCool08] section 5",
          "Many starts with all splits bunched in a tenth of the range, relaxed with and without "
          "teleportation, against the optimum by dynamic programming; and more splits than peaks.",
          measure_teleportation,
          {}};
}

}  // namespace bitshade::claims
