// The preset `exact`: the exact value of a lookup from the stored texels on, rounded once.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <stdexcept>
#include <vector>

#include "bitshade/texture/certified.hpp"
#include "bitshade/texture/presets.hpp"
#include "bitshade/texture/sampler.hpp"
#include "bitshade/texture/storage.hpp"

namespace bitshade {

/// Samples one chain of a stored texture exactly.
///
/// Levels of detail and probes are given data: lambda as it is given, or Vulkan's from the
/// derivatives in binary64 (lod.hpp); from there on nothing is rounded but the result.
///
/// Shapes   T: exact<Q>, used where the fast ways cannot decide.
/// Policy   mip fractions unrounded; formats of at most 24 bits a code, or binary32 and narrower.
/// Error    none beyond one rounding to R.
/// Failure  the constructor throws std::invalid_argument for an empty chain or a wider format.
///          Infinite or NaN texels give what binary64 arithmetic makes of them; a u or v that is
///          not finite throws std::domain_error, since no rational is.
template <class T>
class exact_sampler {
 public:
  exact_sampler(const texel_format& format, const std::vector<coded_image>& chain,
                const sampler_state& state)
      : state_(state) {
    if (chain.empty()) throw std::invalid_argument("a texture needs at least one level");
    const filter_model codes = [] {
      filter_model m = preset_detail::exact();
      m.texel = texel_rule::integers;
      return m;
    }();
    for (int c = 0; c < format.channels; ++c) {
      const encoding& e = format.of[static_cast<std::size_t>(c)];
      const int significant = e.kind == family::binary ? e.fraction_bits + 1 : e.width;
      if (significant > 24 || (e.kind == family::binary && e.exponent_bits > 8))
        throw std::invalid_argument(
            "exact sampling takes codes of at most 24 bits, and floats no wider than binary32");
      const int digits = e.kind == family::snorm ? e.width - 1 : e.width;
      divisor_[static_cast<std::size_t>(c)] =
          is_norm(e) ? static_cast<double>((std::uint64_t{1} << digits) - 1) : 1.0;
    }
    chain_ = load_chain<float>(codes, format, chain);
    for (const image<float>& level : chain_)
      for (const float t : level.texels) finite_ = finite_ && std::isfinite(t);
  }

  template <class R = float>
  R lod(float u, float v, double lambda, int channel, certified_counts* counts = nullptr) const {
    return at_level<R>({0, {{0, 0}}}, u, v, lambda, channel, counts);
  }

  template <class R = float>
  R gradient(float u, float v, const gradients& g, int channel,
             certified_counts* counts = nullptr) const {
    const image<float>& base = chain_.front();
    const probe_set probes = vulkan_probes(g, base.width, base.height, state_.max_anisotropy);
    return at_level<R>(probes, u, v, probes.lambda, channel, counts);
  }

  /// The definition, by rationals throughout.
  template <class R>
  R rational(const probe_set& probes, float u, float v, double lambda, int channel) const {
    const level_blend blend = levels(lambda);
    if (!finite_) {
      // No rational is infinite or NaN: what binary64 makes of the texels says whether one is read.
      const double plain = mean<double>(probes, u, v, blend, channel);
      if (!std::isfinite(plain)) return static_cast<R>(plain);
    }
    return certified_detail::nearest_of<R, T>(mean<T>(probes, u, v, blend, channel));
  }

 private:
  level_blend levels(double lambda) const {
    const double last = static_cast<double>(chain_.size()) - 1;
    if (state_.mips == mip_selection::none) return {};
    const double limited = lambda > 0 ? std::min(lambda, last) : 0.0;
    if (state_.mips == mip_selection::nearest) {
      const int nearest = static_cast<int>(std::ceil(limited + 0.5)) - 1;
      return {nearest, nearest, 0};
    }
    const int near = static_cast<int>(limited);
    return {near, std::min(near + 1, static_cast<int>(last)), limited - near};
  }

  double border(int channel) const { return state_.border[static_cast<std::size_t>(channel)]; }

  template <class N>
  N texel(int level, int x, int y, int channel) const {
    const auto c = static_cast<std::size_t>(channel);
    if (x < 0 || y < 0) return static_cast<N>(state_.border[c]) * static_cast<N>(divisor_[c]);
    return static_cast<N>(chain_[static_cast<std::size_t>(level)].at(x, y, channel));
  }

  template <class N>
  N level_value(int level, const N& u, const N& v, int channel) const {
    const image<float>& in = chain_[static_cast<std::size_t>(level)];
    if (!state_.linear)
      return texel<N>(level, wrap(texel_floor(u * static_cast<N>(in.width)), in.width, state_.u),
                      wrap(texel_floor(v * static_cast<N>(in.height)), in.height, state_.v),
                      channel);
    const N half = static_cast<N>(0.5);
    const N x = u * static_cast<N>(in.width) - half, y = v * static_cast<N>(in.height) - half;
    const int x0 = texel_floor(x), y0 = texel_floor(y);
    const int xs[2] = {wrap(x0, in.width, state_.u), wrap(x0 + 1, in.width, state_.u)};
    const int ys[2] = {wrap(y0, in.height, state_.v), wrap(y0 + 1, in.height, state_.v)};
    const N fx = x - static_cast<N>(x0), fy = y - static_cast<N>(y0);
    const auto row = [&](int j) {
      return lerp(texel<N>(level, xs[0], ys[j], channel), texel<N>(level, xs[1], ys[j], channel),
                  fx);
    };
    return lerp(row(0), row(1), fy);
  }

  template <class N>
  N mean(const probe_set& probes, float u, float v, const level_blend& blend, int channel) const {
    N sum = static_cast<N>(0);
    for (const auto& offset : probes.offsets) {
      const N pu = static_cast<N>(within_period(u, state_.u)) +
                   static_cast<N>(within_period(offset.du, state_.u));
      const N pv = static_cast<N>(within_period(v, state_.v)) +
                   static_cast<N>(within_period(offset.dv, state_.v));
      N value = level_value<N>(blend.near, pu, pv, channel);
      if (blend.fraction != 0)
        value =
            lerp(value, level_value<N>(blend.far, pu, pv, channel), static_cast<N>(blend.fraction));
      sum = sum + value;
    }
    return sum / (static_cast<N>(static_cast<int>(probes.offsets.size())) *
                  static_cast<N>(divisor_[static_cast<std::size_t>(channel)]));
  }

  /// One bilinear lookup as an interval; nothing where the coordinates are not exact in binary64.
  bool bounded_level(int level, float u, float v, int channel,
                     certified_detail::bounded& out) const {
    using namespace certified_detail;
    const image<float>& in = chain_[static_cast<std::size_t>(level)];
    const located where = locate_exactly(u, v, in.width, in.height, state_.u);
    if (!where.exact ||
        !border_is_exact(border(channel), divisor_[static_cast<std::size_t>(channel)]))
      return false;
    const auto& at = where.at;
    const exact_source source{&in, divisor_[static_cast<std::size_t>(channel)]};
    const double outside = border(channel);
    out = bilinear_bounded(exact_texel(source, at.x0, at.y0, channel, outside),
                           exact_texel(source, at.x1, at.y0, channel, outside),
                           exact_texel(source, at.x0, at.y1, channel, outside),
                           exact_texel(source, at.x1, at.y1, channel, outside), at.fx, at.fy,
                           source.divisor);
    return std::isfinite(out.value);
  }

  /// All probes and both levels as one interval, each operation adding what it may have lost.
  bool bounded_all(const probe_set& probes, float u, float v, const level_blend& blend, int channel,
                   certified_detail::bounded& sum) const {
    using certified_detail::bounded;
    constexpr double unit = 0x1p-53;
    sum = {0, 0};
    for (const auto& offset : probes.offsets) {
      const auto place = [](float at, double by, address mode) {
        return certified_detail::two_sum(static_cast<double>(within_period(at, mode)),
                                         within_period(by, mode));
      };
      const auto wu = place(u, offset.du, state_.u), wv = place(v, offset.dv, state_.v);
      const auto pu = static_cast<float>(wu.high), pv = static_cast<float>(wv.high);
      if (static_cast<double>(pu) != wu.high || static_cast<double>(pv) != wv.high || wu.low != 0 ||
          wv.low != 0)
        return false;
      bounded a, b;
      if (!bounded_level(blend.near, pu, pv, channel, a)) return false;
      if (blend.fraction != 0) {
        if (!bounded_level(blend.far, pu, pv, channel, b)) return false;
        const double difference = b.value - a.value;
        const double product = difference * blend.fraction;
        const double value = a.value + product;
        a.radius = 2 * a.radius + b.radius +
                   unit * (2 * std::fabs(difference) + std::fabs(value)) * 1.0000001;
        a.value = value;
      }
      sum.value += a.value;
      sum.radius += a.radius + unit * std::fabs(sum.value) * 1.0000001;
    }
    const auto count = static_cast<double>(probes.offsets.size());
    sum.value /= count;
    sum.radius = sum.radius / count * 1.0000001 + unit * std::fabs(sum.value) * 1.0000001;
    return true;
  }

  template <class R>
  R at_level(const probe_set& probes, float u, float v, double lambda, int channel,
             certified_counts* counts) const {
    const level_blend blend = levels(lambda);
    const auto& near = chain_[static_cast<std::size_t>(blend.near)];
    const bool alone = blend.fraction == 0 && probes.offsets.size() == 1;
    if (!state_.linear && alone) {
      const auto c = static_cast<std::size_t>(channel);
      if (certified_detail::border_is_exact(border(channel), divisor_[c])) {
        // Codes and divisors have 24 bits at most: rounded to binary64 first, their quotient stays
        // the nearest binary32. A zero has no sign, as no rational has.
        const double code =
            level_value<double>(blend.near, static_cast<double>(within_period(u, state_.u)),
                                static_cast<double>(within_period(v, state_.v)), channel);
        if (counts) ++counts->fast;
        return static_cast<R>(code / divisor_[c] + 0.0);
      }
    }
    if (state_.linear && state_.u == state_.v) {
      if (alone)
        return bilinear_certified<R, T>({&near, divisor_[static_cast<std::size_t>(channel)]}, u, v,
                                        state_.u, channel, border(channel), counts);
      if constexpr (std::is_same_v<R, float>) {
        certified_detail::bounded all;
        R result;
        if (bounded_all(probes, u, v, blend, channel, all) &&
            certified_detail::decide(all, result)) {
          if (counts) ++counts->fast;
          return result;
        }
      }
    }
    if (counts) ++counts->rational;
    return rational<R>(probes, u, v, lambda, channel);
  }

  sampler_state state_;
  std::vector<image<float>> chain_;
  std::array<double, 4> divisor_{1, 1, 1, 1};
  bool finite_ = true;
};

}  // namespace bitshade
