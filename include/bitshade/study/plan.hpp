// The plan: which effects can change a pixel of this frame, and why the others cannot.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace bitshade {

/// An effect that the pipeline can simulate, and whether this frame calls for it.
///
/// `asked`   the configuration switches it on.
/// `needed`  it can change a pixel; `evidence` says so, or why not, with counts.
struct effect {
  std::string name;
  bool asked = false;
  bool needed = false;
  std::string evidence;

  bool simulated() const { return asked && needed; }
};

/// What a run simulates. A plan is only right if running everything gives the same bits:
/// `everything()` is that other run.
struct plan {
  std::vector<effect> effects;
  std::vector<double> splits;            ///< s_0 .. s_N of the layers, 0 and 1 included
  std::vector<std::size_t> layer_users;  ///< receivers that look up each layer
  std::vector<std::string> notes;        ///< what the user should know of how the splits were found

  bool simulates(std::string_view name) const {
    const auto found = std::find_if(effects.begin(), effects.end(),
                                    [&](const effect& e) { return e.name == name; });
    return found != effects.end() && found->simulated();
  }
  /// The same plan with every asked effect simulated, needed or not.
  plan everything() const {
    plan all = *this;
    for (auto& e : all.effects) e.needed = true;
    return all;
  }
};

}  // namespace bitshade
