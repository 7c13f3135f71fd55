// What a study found, in tables and in words.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "run/row.hpp"

namespace bitshade {

/// The rows of one input as tables of at most 80 columns: first the method's error, which no format
/// changes, then each format's own, what it bleeds, and what it costs.
std::string text_tables(std::span<const row> rows);

/// Which effects the input needs and which not, with the evidence: one paragraph an effect.
std::string text_effects(std::span<const row> rows);

/// One effect as the configurations of an input see it.
struct effect_summary {
  std::string name;
  bool needed = false;          ///< by at least one configuration
  std::vector<std::string> by;  ///< labels of the configurations with this evidence
  std::string evidence;
};

/// The effects of all rows of an input, those with equal evidence joined.
std::vector<effect_summary> effects_of(std::span<const row> rows);

/// "Two uniform unorm16 layers match a binary32 VSM on this scene to within …": of the VSMs and
/// LVSMs in narrower formats the cheapest whose picture is that of a single-layer VSM in binary32 to
/// within a step of an 8-bit display, or else the nearest; empty where there is none.
std::string headline(std::span<const row> rows);

/// The findings in sentences, the headline first; each is computed from the rows.
std::vector<std::string> findings(std::span<const row> rows);

}  // namespace bitshade
