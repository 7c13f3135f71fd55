// One axis: what becomes of numbers below the smallest normal one.
#pragma once

#include <cstdint>

namespace bitshade {

enum class subnormals : std::uint8_t {
  preserve,      ///< gradual underflow, as IEEE 754 asks
  flush_output,  ///< a result that is subnormal after rounding becomes a zero of its sign
  flush_input,   ///< a subnormal operand is read as a zero of its sign
  flush_both
};

constexpr bool flushes_output(subnormals s) { return s == subnormals::flush_output || s == subnormals::flush_both; }
constexpr bool flushes_input(subnormals s) { return s == subnormals::flush_input || s == subnormals::flush_both; }

}  // namespace bitshade
