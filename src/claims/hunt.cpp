#include "claims/hunt.hpp"

#include <algorithm>

#include "claims/shrink.hpp"

namespace bitshade::claims {

hunt_result hunt(const trial& statement, const method& m, random_stream random, long tries,
                 condition within) {
  hunt_result result;
  for_cases(statement.names, random, tries, within, [&](const sample& s) {
    const evaluation e = statement.evaluate(m, s);
    if (!e.admissible) return;
    ++result.admissible;
    if (!e.refutes) return;
    ++result.refuting;
    result.largest_excess = std::max(result.largest_excess, static_cast<double>(e.excess));
    if (!result.found) result.found = s;
  });
  if (!result.found) return result;
  const auto refutes = [&](const sample& s) {
    if (within != nullptr) {  // what leaves the condition is no counterexample under it
      sample inside = s;
      within(inside);
      if (!(inside == s)) return false;
    }
    const evaluation e = statement.evaluate(m, s);
    return e.admissible && e.refutes;
  };
  const shrunk_sample end = shrink(*result.found, refutes);
  result.smallest = end.smallest;
  result.steps = end.steps;
  result.to_the_end = end.to_the_end;
  result.numbers = statement.evaluate(m, *result.smallest).numbers;
  return result;
}

}  // namespace bitshade::claims
