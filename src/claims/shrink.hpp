// From a counterexample to the simplest one near it.
#pragma once

#include <functional>
#include <vector>

#include "claims/sample.hpp"

namespace bitshade::claims {

/// How simple a case is, compared entry by entry: how many numbers, the sum of their denominators,
/// the sum of their numerators. Every step of shrinking lowers it, so that shrinking ends.
struct simplicity {
  std::size_t numbers = 0;
  number denominators, numerators;

  friend bool operator<(const simplicity& a, const simplicity& b);
};
simplicity simplicity_of(const sample& s);

/// Numbers of the same kind that are simpler than x, the simplest first: all fractions with a small
/// denominator, then those nearest to x with larger ones (its ancestors in the Stern-Brocot tree;
/// for the grid the multiples of 2^-k beside it).
std::vector<number> simpler_numbers(const number& x, quantity what);

/// What became of a case.
struct shrunk_sample {
  sample smallest;
  int steps = 0;            ///< successful ones
  long tried = 0;           ///< cases evaluated
  bool to_the_end = false;  ///< no step was left, rather than no budget
};

/// Makes a case simpler for as long as `wanted` holds of it: numbers leave their lists, one number
/// becomes simpler, two numbers become simpler at once. Ends where no step survives, or after
/// `budget` evaluations, whichever comes first.
shrunk_sample shrink(sample from, const std::function<bool(const sample&)>& wanted,
                     long budget = 40000);

}  // namespace bitshade::claims
