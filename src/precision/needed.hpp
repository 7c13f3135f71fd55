// The fewest bits that keep an error: predicted by the bound, and found on adversarial footprints.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bitshade/study/precision.hpp"
#include "precision/footprint.hpp"

namespace bitshade::bit_search {

/// One question, answered twice.
///
/// Between `found` and `predicted` nothing is known: no footprint that breaks eps was found, and
/// no proof that there is none. Where both agree the answer is exact.
struct needed_bits {
  precision_question question;
  bool floating = false;  ///< significand bits of a float; else bits of a unorm
  int layers = 1;
  double overlap = 0;
  double predicted = 0;       ///< real bits at which the whole bound is eps; suffices for all
  double variance_share = 0;  ///< the closed form that leaves the mean's share out
  double found = 0;           ///< real bits below which a footprint breaks eps
  int predicted_whole = 0;
  int found_whole = 0;
  worst_case witness;  ///< with one whole bit fewer than found_whole
};

/// Uniform layers with an overlap; the widest one governs.
///
/// Failure  std::invalid_argument where eps is not in (0, 1), or where the floor fills the layer:
///          the message names the layers and the cure.
needed_bits bits_needed(precision_question question, int layers, double overlap,
                        bool floating = false, int tries = 4000);

/// The share of the bound's variance term that adversarial footprints reach at least, means being
/// what they can be: with one rounding, and with several (tests/property/precision/bits.cpp).
inline constexpr double reached_once = 0.92, reached_repeatedly = 0.8;
/// The same in bits: how far below its law a curve of bits found may lie.
double missed_bits(const precision_question& question);
/// Bits that the bound's variance term asks for where a receiver one deviation behind the mean has
/// to fit in, so that no mean comes nearer to 1 than 1 - sigma_min / w.
double reachable_bits(const needed_bits& point);

/// Bits against log2 of the layers: b = at_one + slope log2 N, by least squares.
struct fitted_line {
  double slope = 0;
  double at_one = 0;
  double largest_residual = 0;
};
fitted_line line_through(std::span<const needed_bits> curve, double needed_bits::*what);

/// Why a curve is no straight line of slope -2, from its own numbers: sentences.
std::vector<std::string> deviations(std::span<const needed_bits> curve);

}  // namespace bitshade::bit_search
