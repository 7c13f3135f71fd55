// How a device filters, as plain data: one value of each axis. A preset is one such value.
#pragma once

#include <cstdint>
#include <string_view>

#include "bitshade/formats/encoding.hpp"
#include "bitshade/formats/rules.hpp"
#include "bitshade/texture/mip.hpp"

namespace bitshade {

/// How the code of a norm becomes the number that is filtered.
enum class texel_rule : std::uint8_t {
  nearest,     ///< the binary32 number nearest to c / max
  reciprocal,  ///< fl(c * fl(1/max))
  integers     ///< the code itself; the filtered value times fl(1/max) at the end
};

/// Where a clamped coordinate is limited; w is the size in texels.
enum class clamp_rule : std::uint8_t {
  indices,  ///< x = u*w - 1/2; the two indices are limited, the weight is not
  scaled,   ///< x = min(max(u*w, 0), w) - 1/2; indices limited
  centred,  ///< x = max(min(u*w, w) - 1/2, 0); the second index limited
  unit,     ///< u into [0, 1 - 2^-24], then u*w - 1/2; indices limited
  integers  ///< indices limited on the grid, and the weight of a limited pair is 0
};

/// Whether a repeated coordinate is wrapped before or after it is scaled.
enum class repeat_rule : std::uint8_t {
  scaled,                       ///< floor(u*w - 1/2) mod w
  fraction,                     ///< (u - floor u)*w - 1/2, the border wrapped
  fraction_unless_power_of_two  ///< scaled where w is a power of two, else fraction
};

/// How a number is put on a grid.
enum class snap : std::uint8_t { none, floor, nearest };

/// In which order, and with which operations, four texels become one value.
enum class accumulation : std::uint8_t {
  lerp_fma,       ///< fma(f, b - a, a): x, then y
  lerp_mul_add,   ///< a + f*(b - a): x, then y
  four_products,  ///< ((w00*t00 + w10*t10) + w01*t01) + w11*t11, w = (1-fx)*(1-fy) ..
  lerp_codes      ///< 8-bit codes: a + ((256 weights * (b - a) + 128) >> 8): x, then y
};

/// Where intermediate values are rounded to `rounded_to`, beyond the carrier's own roundings.
/// `result` is left to whoever asks for the lookup, at its very end: device_sampler.hpp.
enum class intermediate : std::uint8_t { none, per_product, per_lerp, result };

/// The length that selects the level.
enum class rho_rule : std::uint8_t { length, max_abs };

/// log2 of it.
enum class log2_rule : std::uint8_t {
  nearest,         ///< log2_fixed
  mantissa_line,   ///< exponent + (mantissa - 1)
  table_256,       ///< exponent + log2 of the mantissa from 257 entries
  squared_as_bits  ///< bits of (rho^2)^2 taken as a number, times 2^-25
};

enum class anisotropy_rule : std::uint8_t {
  vulkan,         ///< N = ceil(ratio) probes at i/(N+1) - 1/2 along the longer derivative
  determinant,    ///< SwiftShader: N = nearest(min(major^2/|det|, limit)), spacing 1/N
  ellipse,        ///< D3D: axes of the ellipse that the derivatives span, spacing 1/N
  feline,         ///< Gaussian-weighted probes along the ellipse's major axis
  ewa_unlimited,  ///< elliptical weighted average of one level, the limit ignored
  ewa             ///< the same, the limit honoured
};

/// How a number becomes the code of a norm.
enum class norm_store : std::uint8_t {
  nearest,        ///< the nearest code, ties to even
  scaled,         ///< fl(x * max) in binary32, then to nearest even
  scaled_half_up  ///< fl(fl(x * max) + 1/2), rounded toward zero, beyond 8 bits; else scaled
};

/// How a device samples.
struct filter_model {
  std::string_view name;
  std::string_view source;  ///< "KEY: places; KEY: ..", keys of docs/bibliography.md

  texel_rule texel = texel_rule::nearest;
  clamp_rule clamp = clamp_rule::indices;
  repeat_rule repeat = repeat_rule::scaled;

  int grid_bits = 0;  ///< coordinates in steps of 2^-n texels; 0: the carrier's own
  snap grid_snap = snap::none;
  bool snap_before_centring = false;  ///< on u*w instead of u*w - 1/2
  int weight_bits = 0;                ///< weights in steps of 2^-n; 0: full
  snap weight_snap = snap::none;      ///< nearest may reach 1

  accumulation order = accumulation::lerp_mul_add;
  intermediate rounding = intermediate::none;
  encoding rounded_to = binary_encoding(8, 23);

  int mip_bits = 0;  ///< mip fractions in steps of 2^-n, rounded down; 0: full
  rho_rule rho = rho_rule::length;
  log2_rule log2 = log2_rule::nearest;
  anisotropy_rule anisotropy = anisotropy_rule::vulkan;

  rules store{};  ///< rounding and overflow of float stores
  norm_store norms = norm_store::nearest;
  bool flush_packed = false;  ///< 10- and 11-bit floats lose their subnormals
  mip_filter mips = mip_filter::centre;
};

}  // namespace bitshade
