// How a study's splits relax: every choice of Lloyd relaxation, by the names of the command line.
#pragma once

#include <array>
#include <charconv>
#include <stdexcept>
#include <string>
#include <string_view>

#include "bitshade/shadow/lloyd.hpp"

namespace bitshade {

/// The names of teleport_target, rest_measure and teleport_scope, in the enums' order.
inline constexpr std::array<std::string_view, 3> teleport_target_names{"layer-mean", "layer-middle",
                                                                       "costly-half"};
inline constexpr std::array<std::string_view, 2> rest_measure_names{"move", "cost"};
inline constexpr std::array<std::string_view, 2> teleport_scope_names{"all", "frame"};

namespace detail {
inline std::string shortest(double value) {  // the shortest text that reads back as value
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}
}  // namespace detail

/// Weights, steps and sums of Lloyd relaxation; the defaults are exact and at once.
///
/// Source   [LauritzenMcCool08] section 5: there two splits a frame, sums in 16 bits, late.
struct lloyd_choices {
  weight_limits weights;
  lloyd_options steps;
  std::string sums = "exact";  ///< format of the reduction's levels, or "exact"
  int most_frames = 1000;      ///< frames after which splits that still move are taken as they are

  friend bool operator==(const lloyd_choices&, const lloyd_choices&) = default;

  /// What differs from the defaults, as text; empty where nothing does.
  std::string key() const;
  /// Throws std::invalid_argument with one sentence where a choice makes no sense.
  void validate() const;
};

inline std::string lloyd_choices::key() const {
  const lloyd_choices usual;
  std::string text;
  const auto add = [&](bool differs, const std::string& name, const std::string& value) {
    if (differs) text += (text.empty() ? "" : ",") + name + ":" + value;
  };
  const auto name = [](const auto& names, auto value) {
    return std::string(names[static_cast<std::size_t>(value)]);
  };
  const auto& u = usual.steps;
  add(weights != usual.weights, "weights",
      detail::shortest(weights.low) + ".." + detail::shortest(weights.high));
  add(steps.splits_per_frame != u.splits_per_frame, "splits-per-frame",
      std::to_string(steps.splits_per_frame));
  add(steps.latency != u.latency, "latency", std::to_string(steps.latency));
  add(!steps.teleport, "teleport", "off");
  add(steps.teleport && steps.target != u.target, "teleport",
      name(teleport_target_names, steps.target));
  add(steps.teleport && steps.scope != u.scope, "scope", name(teleport_scope_names, steps.scope));
  add(steps.teleport && steps.hysteresis != u.hysteresis, "hysteresis",
      detail::shortest(steps.hysteresis));
  add(steps.measure != u.measure, "measure", name(rest_measure_names, steps.measure));
  add(steps.rest != u.rest, "rest", detail::shortest(steps.rest));
  add(sums != usual.sums, "sums", sums);
  add(most_frames != usual.most_frames, "frames", std::to_string(most_frames));
  return text;
}

inline void lloyd_choices::validate() const {
  const auto refuse = [](const std::string& why) { throw std::invalid_argument(why); };
  if (!(weights.low >= 0 && weights.low <= weights.high && weights.high <= 0.25)) {
    refuse("Lloyd's weights " + detail::shortest(weights.low) + "," +
           detail::shortest(weights.high) +
           ": give a least and a largest one between 0 and 0.25, the largest variance in [0,1]");
  }
  if (weights.high < 0x1p-32) {
    refuse("Lloyd's largest weight is under 2^-32, the step of its sums: give a larger one");
  }
  if (steps.splits_per_frame < 0 || steps.splits_per_frame > 255) {
    refuse("splits per frame = " + std::to_string(steps.splits_per_frame) + " is outside 0 to 255");
  }
  if (steps.latency < 0 || steps.latency > 1000) {
    refuse("latency = " + std::to_string(steps.latency) + " frames is outside 0 to 1000");
  }
  if (!(steps.hysteresis >= 0 && steps.hysteresis < 1)) {
    refuse("hysteresis = " + detail::shortest(steps.hysteresis) + " is outside [0, 1)");
  }
  if (!(steps.rest >= 0 && steps.rest < 1)) {
    refuse("rest = " + detail::shortest(steps.rest) + " is outside [0, 1)");
  }
  if (most_frames < 1 || most_frames > 1000000) {
    refuse("Lloyd's frames = " + std::to_string(most_frames) + " is outside 1 to 1,000,000");
  }
  if (sums.empty()) refuse("the format of Lloyd's sums is empty: name one, or exact");
}

}  // namespace bitshade
