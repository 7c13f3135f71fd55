// Floor, overlap, number of layers and bits in one table: where advice on overlaps meets 16 bits.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace bitshade::bit_search {

/// One floor and one number of layers, with the overlap that hides the layers' edges and without.
///
/// Units    depths in [0,1]; bits of a unorm, for every footprint.
struct joint_cell {
  double floor_deviation = 0.01;
  int layers = 1;
  double overlap = 0;  ///< sigma_min sqrt(1/eps - 1), or radius times slope where that is more
  double width = 1;    ///< of the widest layer with that overlap
  int bits = 0;        ///< with it; 0: none up to 52
  int bits_apart = 0;  ///< without overlap; 0: the layer is too thin for its floor
  bool thick_enough = true;  ///< the floor's light fades within 1/N
};

struct joint_question {
  double tolerated = 1.0 / 255;
  int roundings = 1;
  double reach = 0;  ///< filter radius times receiver slope, in depth
  std::vector<double> deviations{0.03, 0.01, 0.003, 0.001};
  std::vector<int> layers{1, 2, 4, 8, 16};
};

std::vector<joint_cell> joint_chart(const joint_question& question);

/// What the chart says, in sentences: where `bits` suffice, with and without the overlap, and the
/// bound that no floor and no number of layers escapes.
std::vector<std::string> joint_findings(const joint_question& question,
                                        std::span<const joint_cell> chart, int bits);

}  // namespace bitshade::bit_search
