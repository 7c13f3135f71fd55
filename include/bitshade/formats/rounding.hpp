// One axis: where an inexact value goes.
#pragma once

#include <cstdint>

namespace bitshade {

enum class rounding : std::uint8_t {
  nearest_even,  ///< to the nearest, ties to the even code
  nearest_away,  ///< to the nearest, ties away from zero
  toward_zero,
  up,            ///< toward +infinity
  down,          ///< toward -infinity
  to_odd,        ///< exact, or the odd one of the two neighbours [BoldoMelquiond08]
  stochastic     ///< up in magnitude with the probability that the discarded part is
};

}  // namespace bitshade
