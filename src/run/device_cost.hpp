// What a graphics processor would feel of a configuration: counts, not times.
#pragma once

#include "bitshade/study/configuration.hpp"
#include "bitshade/study/frame.hpp"
#include "bitshade/study/plan.hpp"
#include "run/row.hpp"

namespace bitshade {

/// Passes, fetches and traffic of one frame.
///
///   passes   one that fills a layer's map, two of a separable blur, one a mip level; two sums of a
///            summed-area table; for each layer that a receiver looks up
///   fetches  filtered reads of up to four channels a sample; PCF reads its footprint four depths
///            at a time; several layers, probes and corners of a summed-area table count apart
///   bytes    what the passes write and read, each texel once, and what the samples' fetches read,
///            four texels each, as if nothing were cached
///
/// Units    bytes_per_texel: all layers and channels, as stored.
device_cost device_cost_of(const frame& scene, const configuration& how, const plan& effects,
                           int bytes_per_texel);

}  // namespace bitshade
