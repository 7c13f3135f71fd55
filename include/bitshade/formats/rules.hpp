// How a format rounds: one value of each axis.
#pragma once

#include "bitshade/formats/nan.hpp"
#include "bitshade/formats/norm_decode.hpp"
#include "bitshade/formats/overflow.hpp"
#include "bitshade/formats/rounding.hpp"
#include "bitshade/formats/subnormals.hpp"

namespace bitshade {

/// Structural, so that it is a template argument and a run-time value alike.
struct rules {
  rounding direction = rounding::nearest_even;
  subnormals subnormal = subnormals::preserve;
  bitshade::overflow overflow = bitshade::overflow::ieee;
  nan_payload nan = nan_payload::keep;
  norm_decode norm = norm_decode::exact;
  int random_bits = 64;  ///< how many leading bits of `random` a stochastic rounding looks at, 1 .. 64

  friend constexpr bool operator==(const rules&, const rules&) = default;
};

}  // namespace bitshade
