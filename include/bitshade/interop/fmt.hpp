// fmt prints real as it prints double: every format specification of a double works.
#pragma once

#include <fmt/format.h>

#include "bitshade/arithmetic/real.hpp"

template <class Format, bitshade::rules R, class Carrier>
struct fmt::formatter<bitshade::real<Format, R, Carrier>> : fmt::formatter<double> {
  template <class Context>
  auto format(const bitshade::real<Format, R, Carrier>& x, Context& context) const {
    return fmt::formatter<double>::format(static_cast<double>(x), context);
  }
};
