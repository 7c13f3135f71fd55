// A run whose stages are each in the format or exact: what a stage is guilty of is seen so.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "bitshade/formats/encoding.hpp"
#include "run/pipeline.hpp"

namespace bitshade {

/// Where a run's numbers meet a format.
///
///   splits   Lloyd's reduction: moments of the map as a 16-bit format keeps them
///   store    warp and square in the arithmetic, then the first store
///   resolve  means of a texel's samples and their store
///   blur     weights, sums and the store of each pass
///   mips     means and the store of every level
///   sums     a summed-area table's running sums, and their store after each direction; sums of
///            codes (norms, fixed point) lose nothing, and are no stage
///   weights  bilinear fractions: the arithmetic's, or a device's few bits
///   filter   the interpolation's arithmetic; with mips or probes the weights count to it. Of a
///            summed-area table the differences of four corners and the division by their texels:
///            of corners that are exact, each of the two differences is rounded once
///   shading  the receiver's warp, mean and variance, floor, Chebyshev (or what the technique makes
///            of its values), transition, reduction and the mean of several lookups
enum class stage : std::uint8_t {
  splits, store, resolve, blur, mips, sums, weights, filter, shading
};

inline constexpr std::array<std::string_view, 9> stage_names{
    "splits", "store", "resolve", "blur", "mips", "sums", "weights", "filter", "shading"};
constexpr std::string_view name_of(stage s) { return stage_names[static_cast<std::size_t>(s)]; }

class stage_set {
 public:
  static constexpr stage_set none() { return stage_set(0); }
  static constexpr stage_set all() { return stage_set(0x1ff); }
  static constexpr stage_set only(stage s) { return stage_set(bit(s)); }
  constexpr stage_set without(stage s) const { return stage_set(bits_ & ~bit(s)); }
  constexpr bool has(stage s) const { return (bits_ & bit(s)) != 0; }

 private:
  constexpr explicit stage_set(unsigned bits) : bits_(bits) {}
  static constexpr unsigned bit(stage s) { return 1U << static_cast<unsigned>(s); }
  unsigned bits_;
};

/// What the stages in the format are like, where that is not what the format's name says.
struct stage_choices {
  stage_set in_format = stage_set::all();
  int weight_bits = 0;              ///< of bilinear fractions; 0: as the arithmetic gives them
  std::optional<encoding> shading;  ///< the arithmetic that shades (vsm, savsm, lvsm)
};

/// The stages that a configuration passes through, in their order.
std::vector<stage> stages_of(const configuration& how);

/// Failure  usage_error for a technique whose stages cannot be told apart, with those that can.
void require_stages(const configuration& how);

/// Runs a technique that filters what it stores (all but hard, pcf, deep) with every stage either in the format or without a rounding that
/// counts (enclosures of 192 bits).
///
/// With all stages in the format and no other choice, bit for bit what run_pipeline gives; with
/// none, what it gives for `exact`, wherever an enclosure decides the last bit.
///
/// Failure  usage_error for other techniques, for exponents above 300 and for what the stages do not cover: --lookup,
///          --direct-index, --noise-floor, --bleeding-power, a shading arithmetic that shading_in
///          does not know.
cell run_staged(const frame& scene, const configuration& how, const stage_choices& choices,
                int threads = 0);

}  // namespace bitshade
