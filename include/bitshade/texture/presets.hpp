// The devices known by name. Each cites a key of docs/bibliography.md and the places there; each is
// held to its device, its specification or its definition by tests/conformance/texture.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "bitshade/texture/filter_model.hpp"

namespace bitshade {

namespace preset_detail {

constexpr rules toward_zero_saturating() {
  rules r;
  r.direction = rounding::toward_zero;
  r.overflow = overflow::saturate;
  return r;
}

/// Not a device: the specification's formulas without their tolerances, from the stored texels on.
/// exact_sampler.hpp evaluates them with one rounding; in exact<Q>, sampler.hpp has none. Levels are
/// means over areas, which no specification names: any two filters agree on even sizes.
///
/// Source  [Vulkan] Image Operations: "Texel Filtering", "Wrapping Operation", "Scale Factor
///         Operation, Level-of-Detail Operation and Image Level(s) Selection"; Fixed-Point Data
///         Conversions.
constexpr filter_model exact() {
  filter_model m;
  m.name = "exact";
  m.source = "Vulkan: Image Operations, Fixed-Point Data Conversions";
  m.mips = mip_filter::area;
  return m;
}

/// The least that Direct3D 11.3 promises: 8 bits of coordinate, snapped to nearest so that a carry
/// moves to the next texel, weights 1 - w, 8 bits of mip fraction; floats stored toward zero.
///
/// Source  [D3D11] 7.18.8 (coordinates), 7.18.10 (mip fraction), 7.18.11 (anisotropy), 7.18.16
///         (weights), 3.2.2 (stores).
constexpr filter_model d3d11() {
  filter_model m;
  m.name = "d3d11";
  m.source = "D3D11: 7.18.8-7.18.16, 3.2.2";
  m.grid_bits = 8;
  m.grid_snap = snap::nearest;
  m.mip_bits = 8;
  m.anisotropy = anisotropy_rule::ellipse;
  m.store = toward_zero_saturating();
  return m;
}

/// Vulkan's roadmap profile at its least: 8 bits of coordinate, 6 of mip fraction, rounded down,
/// which passes the conformance suite's strict check.
///
/// Source  [Vulkan] Roadmap 2022: subTexelPrecisionBits, mipmapPrecisionBits; [CTS].
constexpr filter_model vulkan_strict() {
  filter_model m;
  m.name = "vulkan-strict";
  m.source = "Vulkan: Roadmap 2022; CTS";
  m.grid_bits = 8;
  m.grid_snap = snap::floor;
  m.mip_bits = 6;
  return m;
}

/// 9-bit fixed-point weights, 8 of them fraction, so that 1 has a code of its own. The guide says
/// nothing of the sums; here they are rounded once, so that constants stay constant.
///
/// Source  [CUDA] Texture Fetching, "Linear Filtering".
constexpr filter_model cuda() {
  filter_model m;
  m.name = "cuda";
  m.source = "CUDA: Texture Fetching";
  m.weight_bits = 8;
  m.weight_snap = snap::nearest;
  m.order = accumulation::four_products;
  m.rounding = intermediate::result;
  m.mip_bits = 8;
  return m;
}

/// Whatever is not 8-bit unorm: binary32 without a grid, fused where the processor fuses.
///
/// Source  [Mesa22] llvmpipe, gallivm's sampler: measured, tests/conformance/texture/mesa.cpp.
constexpr filter_model llvmpipe() {
  filter_model m;
  m.name = "llvmpipe";
  m.source = "Mesa22: llvmpipe";
  m.texel = texel_rule::reciprocal;
  m.clamp = clamp_rule::centred;
  m.repeat = repeat_rule::fraction_unless_power_of_two;
  m.order = accumulation::lerp_fma;
  m.log2 = log2_rule::mantissa_line;
  m.anisotropy = anisotropy_rule::ewa_unlimited;
  m.store = toward_zero_saturating();
  m.norms = norm_store::scaled;
  return m;
}

/// 8-bit unorm: 8.8 coordinates, 8-bit weights, every lerp rounded to 8 bits.
///
/// Source  [Mesa22] llvmpipe, gallivm's sampler for 8-bit channels: measured, the same.
constexpr filter_model llvmpipe_r8() {
  filter_model m = llvmpipe();
  m.name = "llvmpipe-r8";
  m.clamp = clamp_rule::integers;
  m.grid_bits = 8;
  m.grid_snap = snap::nearest;
  m.snap_before_centring = true;
  m.order = accumulation::lerp_codes;
  m.texel = texel_rule::integers;
  m.mip_bits = 8;
  return m;
}

/// Source  [Mesa22] softpipe: measured, the same.
constexpr filter_model softpipe() {
  filter_model m = llvmpipe();
  m.name = "softpipe";
  m.source = "Mesa22: softpipe";
  m.clamp = clamp_rule::scaled;
  m.repeat = repeat_rule::scaled;
  m.order = accumulation::lerp_mul_add;
  m.rho = rho_rule::max_abs;
  m.log2 = log2_rule::table_256;
  m.anisotropy = anisotropy_rule::ewa;
  m.norms = norm_store::scaled_half_up;
  m.flush_packed = true;
  return m;
}

/// Norms are filtered as integers and scaled last.
///
/// Source  [SwiftShader]: recorded samples, tests/conformance/texture/recorded.cpp.
constexpr filter_model swiftshader() {
  filter_model m;
  m.name = "swiftshader";
  m.source = "SwiftShader: recorded";
  m.texel = texel_rule::integers;
  m.clamp = clamp_rule::unit;
  m.repeat = repeat_rule::fraction;
  m.log2 = log2_rule::squared_as_bits;
  m.anisotropy = anisotropy_rule::determinant;
  m.norms = norm_store::scaled;
  return m;
}

}  // namespace preset_detail

inline constexpr std::array<filter_model, 8> presets{
    preset_detail::exact(),    preset_detail::d3d11(),      preset_detail::vulkan_strict(),
    preset_detail::cuda(),     preset_detail::llvmpipe(),   preset_detail::llvmpipe_r8(),
    preset_detail::softpipe(), preset_detail::swiftshader()};

/// The preset of that name, or nothing.
constexpr std::optional<filter_model> find_preset(std::string_view name) {
  for (const filter_model& m : presets)
    if (m.name == name) return m;
  return std::nullopt;
}

}  // namespace bitshade
