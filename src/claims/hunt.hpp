// The search for counterexamples: random cases, then the simplest one near the first that refutes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "claims/method.hpp"
#include "claims/sample.hpp"

namespace bitshade::claims {

struct named_number {
  std::string name;
  number value;
};

/// What one case shows.
struct evaluation {
  bool admissible = true;  ///< the case is one that the statement speaks of
  bool refutes = false;    ///< and it contradicts it
  number excess = 0;       ///< by how much
  std::vector<named_number> numbers = {};
};

/// A statement about cases of one shape.
struct trial {
  const char* says;  ///< in words
  shape names;
  evaluation (*evaluate)(const method&, const sample&);
};

/// Moves any case into a condition, and leaves those alone that satisfy it.
using condition = void (*)(sample&);

struct hunt_result {
  long admissible = 0, refuting = 0;
  double largest_excess = 0;
  std::optional<sample> found, smallest;
  int steps = 0;
  bool to_the_end = false;
  std::vector<named_number> numbers;  ///< of the smallest
};

/// Evaluates `tries` random cases, each moved into the condition if there is one; the first that
/// refutes is shrunk, within the condition. Bounded in any case.
hunt_result hunt(const trial& statement, const method& m, random_stream random, long tries,
                 condition within = nullptr);

/// Calls take(case) for `tries` random cases.
template <class Take>
void for_cases(const shape& names, random_stream random, long tries, condition within, Take take) {
  for (long i = 0; i < tries; ++i) {
    sample s = draw(names, random);
    if (within != nullptr) within(s);
    take(s);
  }
}

}  // namespace bitshade::claims
