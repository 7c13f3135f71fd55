// fmt prints real as it prints float, or double where float does not hold the format: every format specification of a
// double works, and without one the text is the shortest that tells the number from its neighbours there.
#pragma once

#include <fmt/format.h>

#include "bitshade/arithmetic/real.hpp"

namespace bitshade::detail {
template <class Format>
using printed_as = std::conditional_t<contains(binary_encoding(8, 23), Format::value), float, double>;
}  // namespace bitshade::detail

template <class Format, bitshade::rules R, class Carrier>
struct fmt::formatter<bitshade::real<Format, R, Carrier>> : fmt::formatter<bitshade::detail::printed_as<Format>> {
  template <class Context>
  auto format(const bitshade::real<Format, R, Carrier>& x, Context& context) const {
    using number = bitshade::detail::printed_as<Format>;
    return fmt::formatter<number>::format(static_cast<number>(x), context);
  }
};
