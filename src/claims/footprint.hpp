// One receiver behind one footprint of texels, in exact arithmetic and in formats.
#pragma once

#include <span>
#include <vector>

#include "bitshade/formats/encoding.hpp"
#include "claims/method.hpp"

namespace bitshade::claims {

inline constexpr interval whole_range{0, 1};

/// The light behind texels of equal weight in one layer, nothing rounded.
///
/// Units    depths in [0,1]; min_variance in depth^2.
number light(const method& m, std::span<const number> x, const number& t, const interval& layer,
             double min_variance);

/// The same with both moments of each texel rounded to a format before they are filtered;
/// receiver, filter and shading stay exact. What is left of the difference is the store's.
number stored_light(const method& m, const encoding& format, std::span<const number> x,
                    const number& t, const interval& layer, double min_variance);

/// The share of the texels at or behind t: what percentage-closer filtering says.
number share_lit(std::span<const number> x, const number& t);

/// Two occluders, `of` texels in all, `nearer` of them at depth a.
std::vector<number> two_depths(const number& a, const number& b, int nearer, int of);

/// Layers as the method makes them of interior splits.
struct layering {
  std::vector<double> splits;
  std::vector<interval> layers;
};
layering layers_from(const method& m, std::vector<double> interior, double overlap);

/// The formats that every claim about storage is put to.
struct named_format {
  const char* name;
  encoding format;
};
std::span<const named_format> storage_formats();

/// The largest distance of two neighbouring numbers of a format in [0,1]: q of docs/theory.md.
double largest_step(const encoding& format);

}  // namespace bitshade::claims
