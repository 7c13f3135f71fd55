// Textures as memory holds them: codes, and what they mean.
#pragma once

#include <array>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "bitshade/formats/round_to.hpp"
#include "bitshade/texture/filter_model.hpp"
#include "bitshade/texture/image.hpp"

namespace bitshade {

/// One to four channels, each an encoding of its own (R11G11B10 needs that).
struct texel_format {
  int channels = 1;
  std::array<encoding, 4> of{};

  friend bool operator==(const texel_format&, const texel_format&) = default;
};

constexpr texel_format uniform_format(const encoding& e, int channels) {
  return {channels, {e, e, e, e}};
}

constexpr texel_format r11g11b10_format() {
  constexpr encoding eleven = unsigned_binary_encoding(5, 6), ten = unsigned_binary_encoding(5, 5);
  return {3, {eleven, eleven, ten, ten}};
}

/// One image of codes.
using coded_image = image<std::uint64_t>;

/// A texture: layers of mip chains, all of one format.
///
/// Shapes   layers[i] is a chain, level 0 first; every image has format.channels channels.
struct stored_texture {
  texel_format format;
  std::vector<std::vector<coded_image>> layers;
};

/// The code of a norm as devices make it, by norm_store::scaled or scaled_half_up. Up to 0.502
/// codes from x, and the wrong neighbour for about one value in a thousand.
constexpr std::uint64_t encode_norm_scaled(const encoding& e, float x, norm_store how) {
  const bool with_sign = e.kind == family::snorm;
  const int digits = with_sign ? e.width - 1 : e.width;
  const auto most = static_cast<float>((std::uint64_t{1} << digits) - 1);
  if (!(x == x)) return 0;
  const float low = with_sign ? -1.0f : 0.0f;
  const float scaled = (x < low ? low : x > 1.0f ? 1.0f : x) * most;
  // A fixed-point number without fraction is an integer: its encoding rounds.
  rules r;
  double value = static_cast<double>(scaled);
  if (how == norm_store::scaled_half_up && e.width > 8) {
    const float half = scaled < 0 ? -0.5f : 0.5f;
    value = static_cast<double>(scaled + half);
    r.direction = rounding::toward_zero;
  }
  return encode(fixed_encoding(40, 0), value, r) & low_bits(e.width);
}

/// The code that a model stores for x.
constexpr std::uint64_t store_value(const filter_model& model, const encoding& e, double x) {
  if (is_norm(e)) {
    if (model.norms == norm_store::nearest) return encode(e, x);
    return encode_norm_scaled(e, static_cast<float>(x), model.norms);
  }
  rules r = model.store;
  if (model.flush_packed && !e.has_sign) r.subnormal = subnormals::flush_output;
  return encode(e, x, r);
}

/// Rounds an image into a format.
///
/// Policy   model.store for floats, model.norms for norms.
/// Error    one rounding a texel.
/// Failure  std::invalid_argument where the channel counts differ.
template <class T>
coded_image store(const filter_model& model, const texel_format& format, const image<T>& in) {
  if (in.channels != format.channels)
    throw std::invalid_argument("an image can only be stored in a format of as many channels");
  coded_image out(in.width, in.height, in.channels);
  const auto channels = static_cast<std::size_t>(in.channels);
  for (std::size_t i = 0; i < in.texels.size(); ++i) {
    out.texels[i] = store_value(model, format.of[i % channels], static_cast<double>(in.texels[i]));
  }
  return out;
}

/// The number that a model filters for a code; for texel_rule::integers the code itself, to be
/// scaled by texel_scale afterwards.
inline double load(const filter_model& model, const encoding& e, std::uint64_t code) {
  if (!is_norm(e)) return decode(e, code);
  if (model.texel == texel_rule::nearest) return decode(e, code);
  if (model.texel == texel_rule::reciprocal) {
    rules r;
    r.norm = norm_decode::reciprocal;
    return decode(e, code, r);
  }
  // A code as a fixed-point number without fraction; the lowest snorm code counts as -max.
  if (e.kind == family::unorm)
    return static_cast<double>(code & ((std::uint64_t{1} << e.width) - 1));
  const double value = decode(fixed_encoding(e.width, 0), code);
  const auto most = static_cast<double>((std::uint64_t{1} << (e.width - 1)) - 1);
  return value < -most ? -most : value;
}

/// What a filtered value is multiplied with at the end: fl(1/max) where codes were filtered.
inline float texel_scale(const filter_model& model, const encoding& e) {
  if (!is_norm(e) || model.texel != texel_rule::integers) return 1.0f;
  const int digits = e.kind == family::snorm ? e.width - 1 : e.width;
  return 1.0f / static_cast<float>((std::uint64_t{1} << digits) - 1);
}

/// Every texel loaded as T.
template <class T>
image<T> load_image(const filter_model& model, const texel_format& format, const coded_image& in) {
  image<T> out(in.width, in.height, in.channels);
  const auto channels = static_cast<std::size_t>(in.channels);
  for (std::size_t i = 0; i < in.texels.size(); ++i)
    out.texels[i] = static_cast<T>(load(model, format.of[i % channels], in.texels[i]));
  return out;
}

template <class T>
std::vector<image<T>> load_chain(const filter_model& model, const texel_format& format,
                                 const std::vector<coded_image>& chain) {
  std::vector<image<T>> out;
  out.reserve(chain.size());
  for (const coded_image& level : chain) out.push_back(load_image<T>(model, format, level));
  return out;
}

/// Two images of two channels in the four channels of one: layers i and i + 1 of an LVSM.
template <class T>
image<T> pack_layers(const image<T>& first, const image<T>& second) {
  if (first.channels != 2 || second.channels != 2 || first.width != second.width ||
      first.height != second.height)
    throw std::invalid_argument("two layers pack only where both have two channels and one size");
  image<T> out(first.width, first.height, 4);
  for (std::size_t i = 0; 2 * i < first.texels.size(); ++i)
    for (std::size_t c = 0; c < 2; ++c) {
      out.texels[4 * i + c] = first.texels[2 * i + c];
      out.texels[4 * i + 2 + c] = second.texels[2 * i + c];
    }
  return out;
}

/// Layer 0 or 1 of a packed image.
template <class T>
image<T> unpack_layer(const image<T>& packed, int layer) {
  if (packed.channels != 4) throw std::invalid_argument("only four channels hold two layers");
  image<T> out(packed.width, packed.height, 2);
  const auto from = static_cast<std::size_t>(2 * layer);
  for (std::size_t i = 0; 4 * i < packed.texels.size(); ++i)
    for (std::size_t c = 0; c < 2; ++c) out.texels[2 * i + c] = packed.texels[4 * i + from + c];
  return out;
}

}  // namespace bitshade
