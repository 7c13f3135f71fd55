// A moment's store as plain data: a grid on [0,1], or a significand of so many bits.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include "bitshade/interop/rational.hpp"

namespace bitshade::bit_search {

/// What rounds a moment in [0,1], to nearest even.
///
///   grid         codes c/steps; steps need not be 2^b - 1, so that bits have fractions
///   significand  `steps` = 2^p: p significand bits, the hidden one included, exponents unlimited
struct moment_store {
  bool floating = false;
  std::int64_t steps = 65535;

  static moment_store unorm(int bits) { return {false, (std::int64_t{1} << bits) - 1}; }
  static moment_store significand(int bits) { return {true, std::int64_t{1} << bits}; }

  /// The widest distance of two neighbours in [1/2, 1].
  double step() const { return 1 / static_cast<double>(steps); }
  /// Bits with their fraction: log2(steps + 1) of a grid, log2(steps) of a significand.
  double bits() const { return std::log2(static_cast<double>(floating ? steps : steps + 1)); }
  std::string name() const {
    return floating ? std::to_string(std::lround(bits())) + " significand bits"
                    : "unorm" + std::to_string(std::lround(bits()));
  }
};

/// The stored value in exact arithmetic; x in [0, 1].
rational stored(const moment_store& store, const rational& x);

/// The same in binary64 and in units of the store: codes of a grid, values of a significand.
///
/// Error    right wherever x is not within 2^-50 of the middle between two neighbours: enough to
///          rank candidates, which exact arithmetic then judges.
double stored_units(const moment_store& store, double x);

/// From depth to the store's units, and what those units are worth.
inline double unit_of(const moment_store& store) {
  return store.floating ? 1.0 : static_cast<double>(store.steps);
}

}  // namespace bitshade::bit_search
