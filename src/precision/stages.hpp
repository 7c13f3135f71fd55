// The fewest bits of stages other than the store: predicted by the bound, and found by search.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace bitshade::bit_search {

/// One stage of one technique, one number of layers, one floor.
///
/// `predicted` bits keep eps for every footprint; with `found` - 1 bits one was found that breaks
/// it. 0 where no width that was looked at suffices.
struct stage_bits {
  std::string technique, stage;
  std::string unit;  ///< what a bit is: of a unorm, a significand, a weight's fraction
  int layers = 1;
  double floor_deviation = 0.01;
  int roundings = 1;
  int predicted = 0;
  int found = 0;
  double witness_error = 0;  ///< of the footprint that breaks eps with one bit fewer
};

/// What all of them are asked.
struct stage_question {
  double tolerated = 1.0 / 255;
  double floor_deviation = 0.01;
  int layers = 1;
  double overlap = 0;
  double exponent = 5;
  std::uint64_t seed = 1;
  int tries = 3000;
};

/// The worst error found of weights whose fractions have so many bits: four texels, one of which
/// lies elsewhere than the others, at fractions just beside the middle of two codes.
double worst_weight_error(int fraction_bits, double floor);

/// The worst error found of shading in an arithmetic of so many significand bits (at most 24).
double worst_shading_error(const stage_question& question, int significand_bits);

/// The worst error found of EVSM's stored moments with so many significand bits.
double worst_evsm_error(const stage_question& question, int significand_bits);

stage_bits weight_bits(const stage_question& question);
stage_bits shading_bits(const stage_question& question);
stage_bits evsm_bits(const stage_question& question);

}  // namespace bitshade::bit_search
