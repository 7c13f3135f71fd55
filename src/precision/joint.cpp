#include "precision/joint.hpp"

#include <algorithm>
#include <cmath>

#include "bitshade/study/precision.hpp"
#include "io/text.hpp"

namespace bitshade::bit_search {

namespace {

int bits_for(const joint_question& q, double deviation, double width) {
  precision_question p;
  p.tolerated = q.tolerated;
  p.roundings = q.roundings;
  p.floor_deviation = deviation;
  p.width = width;
  return unorm_bits_needed(p);
}

std::string variance_of(double deviation) { return brief(deviation * deviation, 2); }

/// "N = 4, 8" of the cells that a test lets pass.
template <class Test>
std::string layers_where(std::span<const joint_cell> chart, double deviation, Test test) {
  std::string list;
  for (const joint_cell& c : chart) {
    if (c.floor_deviation != deviation || !test(c)) continue;
    list += (list.empty() ? "" : ", ") + std::to_string(c.layers);
  }
  return list;
}

}  // namespace

std::vector<joint_cell> joint_chart(const joint_question& q) {
  std::vector<joint_cell> chart;
  for (const double deviation : q.deviations) {
    for (const int layers : q.layers) {
      joint_cell c;
      c.floor_deviation = deviation;
      c.layers = layers;
      c.overlap = layers > 1 ? least_overlap(1, q.reach, deviation, q.tolerated) : 0;
      c.width = uniform_layer_width(layers, c.overlap);
      c.bits = bits_for(q, deviation, c.width);
      c.thick_enough = 1.0 / layers >= narrowest_layer(deviation, q.tolerated);
      c.bits_apart = c.thick_enough ? bits_for(q, deviation, 1.0 / layers) : 0;
      chart.push_back(c);
    }
  }
  return chart;
}

std::vector<std::string> joint_findings(const joint_question& q, std::span<const joint_cell> chart,
                                        int bits) {
  std::vector<std::string> said;
  const std::string wide = std::to_string(bits) + " bits";
  const double least = std::log2(steps_needed_with_full_overlap(q.tolerated, q.roundings) + 1);
  said.push_back(
      "With the overlap that hides the edges every layer from the second on is wider than "
      "two overlaps, so that no floor and no number of layers needs fewer than " +
      brief(least, 4) + " bits at an error of " + brief(q.tolerated) + ": " + wide +
      (least > bits ? " do not suffice." : " can suffice."));
  for (const double deviation : q.deviations) {
    const auto apart = layers_where(chart, deviation, [&](const joint_cell& c) {
      return c.bits_apart > 0 && c.bits_apart <= bits;
    });
    const auto full = layers_where(chart, deviation, [&](const joint_cell& c) {
      return c.layers > 1 && c.bits > 0 && c.bits <= bits;
    });
    const auto thin =
        layers_where(chart, deviation, [](const joint_cell& c) { return !c.thick_enough; });
    std::string text =
        "Floor " + variance_of(deviation) + " (sigma_min " + brief(deviation) + "): " + wide;
    text += apart.empty() ? " suffice for no number of layers"
                          : " suffice without overlap for N = " + apart;
    text += full.empty() ? (apart.empty() ? ", with overlaps or without"
                                          : ", and with full overlaps for none")
                         : ", and with full overlaps for N = " + full;
    if (!thin.empty()) {
      text += "; N = " + thin + " is too thin for the floor's light to fade within a layer";
    }
    said.push_back(text + ".");
  }
  return said;
}

}  // namespace bitshade::bit_search
