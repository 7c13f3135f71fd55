#include <bit>
#include <cmath>
#include <limits>

#include "bitshade/arithmetic/wide.hpp"
#include "bitshade/shadow/pcf.hpp"
#include "bitshade/texture/trilinear.hpp"
#include "run/engines.hpp"
#include "run/exact_grid.hpp"
#include "run/parallel.hpp"
#include "run/summed_area.hpp"

namespace bitshade {

namespace {

constexpr std::uint64_t one24 = std::uint64_t{1} << 24;

/// A footprint that is not separable: texels with integer weights, and their common denominator.
struct weighted_texels {
  struct entry {
    int x, y;
    wide<3> weight;
  };
  std::vector<entry> texels;
  wide<3> whole;
};

/// The plain lookup's axes: blur taps (24 bits) times bilinear shares (24 bits).
struct plain_footprint {
  axis_footprint<std::uint64_t> columns, rows;
};

plain_footprint plain_footprint_of(const lookup& look, const receiver& r,
                                   std::span<const std::uint64_t> blur, int width, int height) {
  const auto axis = [&](float coordinate, int size) {
    std::int64_t x = static_cast<std::int64_t>(static_cast<double>(coordinate) * 0x1p24) * size;
    std::uint64_t f = 0;
    if (look.filter == texel_filter::bilinear) {
      x -= one24 / 2;
      f = static_cast<std::uint64_t>(x) & (one24 - 1);
    }
    const int near = wrap(static_cast<int>(x >> 24), size, map_address);
    const int far = f == 0 ? near : wrap(static_cast<int>(x >> 24) + 1, size, map_address);
    return blurred_axis<std::uint64_t>(near, far, f, one24, blur, size, map_address);
  };
  return {axis(r.u, width), axis(r.v, height)};
}

/// The general lookup's texels on level 0: probes, levels and the blur beneath them.
///
/// Weights are integers in units of 2^-(56 + 2 * 14 + 48) over the number of probes.
weighted_texels general_footprint_of(const lookup& look, const receiver& r,
                                     std::span<const std::uint64_t> blur, int width, int height) {
  const auto probes = probes_of(r, width, height, look.max_anisotropy);
  const int levels = look.mips ? mip_levels(width, height) : 1;
  const auto blend = blend_levels(probes.lambda, levels, map_mip_bits);
  const auto far_share = on_grid(blend.fraction, map_mip_bits);

  struct block {
    int x, y, level;
    std::uint64_t weight;  // of 2^-56
  };
  std::vector<block> blocks;
  const auto add_level = [&](std::int64_t u, std::int64_t v, int level, std::uint64_t share) {
    if (share == 0) return;
    const int w = mip_size(width, level), h = mip_size(height, level);
    for_fetched(look, u, v, w, h, [&](int x, int y, std::uint64_t part) {
      blocks.push_back({x, y, level, part * share});
    });
  };
  for (const auto& at : probes.offsets) {
    const auto u = static_cast<std::int64_t>(static_cast<double>(r.u) * 0x1p24) +
                   static_cast<std::int64_t>(at.du * 0x1p24);
    const auto v = static_cast<std::int64_t>(static_cast<double>(r.v) * 0x1p24) +
                   static_cast<std::int64_t>(at.dv * 0x1p24);
    add_level(u, v, blend.near, 256 - far_share);
    add_level(u, v, blend.far, far_share);
  }

  // Level-0 texels under the blocks, then the blur around each: a dense window of weights.
  const int radius = static_cast<int>(blur.size() / 2);
  const auto side = [](int level, int size) {
    return std::min(1 << level, static_cast<int>(std::bit_floor(static_cast<unsigned>(size))));
  };
  int x0 = width, y0 = height, x1 = 0, y1 = 0;
  for (const block& b : blocks) {
    const int w = side(b.level, width), h = side(b.level, height);
    x0 = std::min(x0, b.x * w);
    y0 = std::min(y0, b.y * h);
    x1 = std::max(x1, (b.x + 1) * w);
    y1 = std::max(y1, (b.y + 1) * h);
  }
  image<wide<3>> base(x1 - x0, y1 - y0);
  for (const block& b : blocks) {
    const int w = side(b.level, width), h = side(b.level, height);
    // 2^28 of the levels' unit, over the texels of the block: both powers of two.
    const auto shift = 28 - std::countr_zero(static_cast<unsigned>(w)) -
                       std::countr_zero(static_cast<unsigned>(h));
    const wide<3> weight = wide<3>(b.weight) << shift;
    for (int y = b.y * h; y < (b.y + 1) * h; ++y) {
      for (int x = b.x * w; x < (b.x + 1) * w; ++x) base.at(x - x0, y - y0) += weight;
    }
  }
  const int bx0 = std::max(0, x0 - radius), by0 = std::max(0, y0 - radius);
  const int bx1 = std::min(width, x1 + radius), by1 = std::min(height, y1 + radius);
  image<wide<3>> across(bx1 - bx0, base.height), both(bx1 - bx0, by1 - by0);
  for (int y = 0; y < base.height; ++y) {
    for (int x = 0; x < base.width; ++x) {
      for (std::size_t k = 0; k < blur.size(); ++k) {
        const int to = wrap(x0 + x - radius + static_cast<int>(k), width, map_address) - bx0;
        across.at(to, y) += narrowed<3>(base.at(x, y) * wide<1>(blur[k]));
      }
    }
  }
  for (int y = 0; y < base.height; ++y) {
    for (std::size_t k = 0; k < blur.size(); ++k) {
      const int to = wrap(y0 + y - radius + static_cast<int>(k), height, map_address) - by0;
      for (int x = 0; x < both.width; ++x) {
        both.at(x, to) += narrowed<3>(across.at(x, y) * wide<1>(blur[k]));
      }
    }
  }
  weighted_texels result;
  for (int y = 0; y < both.height; ++y) {
    for (int x = 0; x < both.width; ++x) {
      if (both.at(x, y) == wide<3>{}) continue;
      result.whole += both.at(x, y);
      result.texels.push_back({bx0 + x, by0 + y, both.at(x, y)});
    }
  }
  return result;
}

/// The share of each receiver's footprint for which lit(x, y, sample) holds, rounded once: over
/// all samples of a texel and all lookups of a light.
template <class MakeLit>
std::vector<double> share_of(const frame& scene, const configuration& how, int threads,
                             MakeLit make_lit) {
  const default_float_environment environment;
  std::vector<std::uint64_t> blur;
  for (const double w : blur_of(how).weights) blur.push_back(on_grid(w, 24));
  const lookup look{
      how.filter == texel_filter::nearest ? texel_filter::nearest : texel_filter::bilinear,
      how.filter == texel_filter::trilinear, how.max_anisotropy, how.filtered.msaa};
  const int samples = look.samples;
  const int width = scene.depth.width, height = scene.depth.height;
  std::vector<double> shares(scene.receivers.size(), std::numeric_limits<double>::quiet_NaN());
  for_ranges(threads, shares.size(), 512, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const receiver& r = scene.receivers[i];
      if (!has_receiver(r)) continue;
      const auto lit = make_lit(r);
      if (how.method == technique::savsm) {
        const auto box = box_of(r, width, height, how.smallest_box);
        int count = 0;
        for (int s = 0; s < samples; ++s) {
          for (int y = box.y0; y < box.y1; ++y) {
            for (int x = box.x0; x < box.x1; ++x) count += lit(x, y, s) ? 1 : 0;
          }
        }
        shares[i] = static_cast<double>(count) / (static_cast<double>(box.area()) * samples);
        continue;
      }
      wide<3> share, whole;
      each_lookup(r, how.filtered.lookups, width, height, [&](const receiver& there) {
        if (look.plain()) {
          const auto at = plain_footprint_of(look, there, blur, width, height);
          for (int s = 0; s < samples; ++s) {
            share += wide<3>(lit_share<uint128>(
                at.columns, at.rows,
                [&](int x, int y, std::size_t, std::size_t) { return lit(x, y, s); }));
            whole += wide<3>(uint128{1} << 96);
          }
          return;
        }
        // Every lookup's weights have one sum, so that sums of shares are means.
        const auto at = general_footprint_of(look, there, blur, width, height);
        for (int s = 0; s < samples; ++s) {
          for (const auto& texel : at.texels) {
            if (lit(texel.x, texel.y, s)) share += texel.weight;
          }
          whole += at.whole;
        }
      });
      shares[i] = quotient_to_double(share, whole);
    }
  });
  return shares;
}

}  // namespace

std::vector<double> truth_pcf(const frame& scene, const configuration& how, int threads) {
  configuration unbiased = how;
  unbiased.depth_bias = 0;
  return pcf_exact(scene, unbiased, threads);
}

std::vector<double> pcf_exact(const frame& scene, const configuration& how, int threads) {
  // On a grid of 2^-24: binary64 loses nothing of t - bias, unless t is so small that it is below 0.
  const double bias = on_split_grid(how.depth_bias);
  const auto maps = depth_maps(scene, how.filtered.msaa);
  return share_of(scene, how, threads, [&](const receiver& r) {
    return [&maps, t = static_cast<double>(r.t) - bias](int x, int y, int s) {
      return static_cast<double>(maps[static_cast<std::size_t>(s)]->at(x, y)) >= t;
    };
  });
}

/// A texel of the receiver's own surface cannot occlude it: surfaces are planar. Any other texel
/// occludes it where its depth lies under the tangent plane at the texel's sample by more than
///
///   2^-24 * (16 + |dt/du| + |dt/dv|)
///
/// which is what the data's own rounding explains: t, x and the plane's value are rounded to
/// binary32 (2^-25 each), u and v to 2^-24 (2^-25 of each slope, and as much for the slopes' own
/// rounding), and a ray's distance errs by a few units of 2^-24 of the depth range.
std::vector<double> truth_geometric(const frame& scene, const configuration& how, int threads) {
  return share_of(scene, how, threads, [&](const receiver& r) {
    const double du = r.dt_du, dv = r.dt_dv;
    const double tolerance = 0x1p-24 * (16 + std::fabs(du) + std::fabs(dv));
    const double at_origin = static_cast<double>(r.t) - tolerance - du * r.u - dv * r.v;
    const std::vector<map_sample>* const samples =
        how.filtered.msaa > 1 ? &scene.samples.at(how.filtered.msaa) : nullptr;
    return [&scene, &r, du, dv, at_origin, samples](int x, int y, int s) {
      const map_sample* sample = samples ? &(*samples)[static_cast<std::size_t>(s)] : nullptr;
      const auto& surface = sample ? sample->surface : scene.surface;
      const auto& depth = sample ? sample->depth : scene.depth;
      if (!surface.texels.empty() && surface.at(x, y) == r.surface) return true;
      const double px = x + 0.5 + (sample ? sample->at.x / 16.0 : 0);
      const double py = y + 0.5 + (sample ? sample->at.y / 16.0 : 0);
      const double plane = at_origin + du * (px / depth.width) + dv * (py / depth.height);
      return static_cast<double>(depth.at(x, y)) >= plane;
    };
  });
}

std::vector<double> hard_exact(const frame& scene, double bias, int threads) {
  configuration nearest;
  nearest.blur_taps = 0;
  nearest.filter = texel_filter::nearest;
  nearest.depth_bias = bias;
  return pcf_exact(scene, nearest, threads);
}

}  // namespace bitshade
