// binary16 as this processor does it: binary32 operations and F16C conversions, which bitshade did not write.
#pragma once

#include <cstddef>
#include <cstdint>

namespace hardware {

/// Whether the processor converts binary16; nothing else here may be called where it does not.
bool has_f16c();

/// out[i] = a op b[i], every NaN as 0x7e00. An operation of binary32 rounded again to binary16 is rounded once:
/// 24 >= 2 * 11 + 2 bits [Figueroa95].
using operation = void (*)(std::uint16_t a, const std::uint16_t* b, std::uint16_t* out, std::size_t n);
void add(std::uint16_t a, const std::uint16_t* b, std::uint16_t* out, std::size_t n);
void subtract(std::uint16_t a, const std::uint16_t* b, std::uint16_t* out, std::size_t n);
void multiply(std::uint16_t a, const std::uint16_t* b, std::uint16_t* out, std::size_t n);
void divide(std::uint16_t a, const std::uint16_t* b, std::uint16_t* out, std::size_t n);

/// The four conversions that F16C has.
using conversion = void (*)(const float* in, std::uint16_t* out, std::size_t n);
void to_nearest_even(const float* in, std::uint16_t* out, std::size_t n);
void toward_zero(const float* in, std::uint16_t* out, std::size_t n);
void up(const float* in, std::uint16_t* out, std::size_t n);
void down(const float* in, std::uint16_t* out, std::size_t n);

}  // namespace hardware
