// Mip chains whose only roundings are the stores between levels.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <vector>

#include "bitshade/texture/certified.hpp"
#include "bitshade/texture/mip.hpp"
#include "bitshade/texture/storage.hpp"

namespace bitshade {

namespace mip_detail {

/// The number next to `near` that rounding to odd gives for a value above (1) or below (-1) it.
inline double to_odd(double near, int side) {
  auto bits = std::bit_cast<std::uint64_t>(near);
  if (side != 0 && (bits & 1) == 0) bits += (side > 0) == (near > 0) ? 1 : std::uint64_t(-1);
  return std::bit_cast<double>(bits);
}

/// The weighted sum over the denominator, rounded to odd; nothing where binary64 rounds on the way.
///
/// Shapes   each(use): calls use(weight, texel) for every texel.
template <class Each>
std::optional<double> mean_to_odd(Each each, double denominator) {
  using certified_detail::two;
  double sum = 0;
  bool exact = true;
  each([&](std::int64_t w, double t) {
    const two product = certified_detail::two_product(static_cast<double>(w), t);
    const two both = certified_detail::two_sum(sum, product.high);
    exact = exact && product.low == 0 && both.low == 0;
    sum = both.high;
  });
  // A quotient's remainder is exact, unless it underflows.
  if (!exact || (sum != 0 && std::fabs(sum) < 0x1p-900)) return std::nullopt;
  const double quotient = sum / denominator;
  const two back = certified_detail::two_product(quotient, denominator);
  const double rest = (sum - back.high) - back.low;
  return to_odd(quotient, rest > 0 ? 1 : rest < 0 ? -1 : 0);
}

}  // namespace mip_detail

/// Most significant bits of a code that encode_exact rounds once: two fewer than binary64's.
inline constexpr int exact_mip_bits = 51;

/// The code of an exact rational, rounded once to nearest even.
///
/// The value goes through binary64 rounded to odd, which no second rounding can spoil (at most
/// exact_mip_bits are asked for); norms are scaled by their maximum first.
/// Source   [BoldoMelquiond08].
template <class T>
std::uint64_t encode_exact(const encoding& e, const T& x) {
  const int digits = e.kind == family::snorm ? e.width - 1 : e.width;
  const bool norm = is_norm(e);
  const T scaled =
      norm ? x * static_cast<T>(static_cast<double>((std::uint64_t{1} << digits) - 1)) : x;
  const double nearest = certified_detail::nearest_of<double, T>(scaled);
  const T back = static_cast<T>(nearest);
  const double odd = mip_detail::to_odd(nearest, back < scaled ? 1 : scaled < back ? -1 : 0);
  if (!norm) return encode(e, odd);
  const auto most = static_cast<double>((std::uint64_t{1} << digits) - 1);
  const double limited = std::clamp(odd, e.kind == family::snorm ? -most : 0.0, most);
  return encode(fixed_encoding(40, 0), limited) & low_bits(e.width);
}

/// The chain of a stored image: each level the exact filtered value of the level below, stored.
///
/// Shapes   T: exact<Q>, for floats whose mean binary64 cannot hold; means of norms are taken in
///          128-bit integers.
/// Error    one rounding to nearest even a level.
/// Failure  std::invalid_argument for codes wider than exact_mip_bits. Infinite or NaN texels give
///          what binary64 makes of their mean.
template <class T>
std::vector<coded_image> exact_mip_chain(const texel_format& format, coded_image base,
                                         mip_filter filter) {
  using certified_detail::int128;
  for (int c = 0; c < format.channels; ++c) {
    const encoding& e = format.of[static_cast<std::size_t>(c)];
    if ((e.kind == family::binary ? e.fraction_bits + 1 : e.width) > exact_mip_bits)
      throw std::invalid_argument("exact mip chains take codes of at most 51 significant bits");
  }
  filter_model codes;
  codes.texel = texel_rule::integers;
  std::vector<coded_image> levels;
  const int count = mip_levels(base.width, base.height);
  levels.push_back(std::move(base));
  for (int level = 1; level < count; ++level) {
    const coded_image& from = levels.back();
    coded_image next(std::max(1, from.width / 2), std::max(1, from.height / 2), from.channels);
    const image<double> values = load_image<double>(codes, format, from);
    for (int y = 0; y < next.height; ++y) {
      const mip_taps down = mip_axis(filter, from.height, y);
      for (int x = 0; x < next.width; ++x) {
        const mip_taps across = mip_axis(filter, from.width, x);
        const auto denominator = static_cast<int128>(down.denominator) * across.denominator;
        for (int c = 0; c < from.channels; ++c) {
          const encoding& e = format.of[static_cast<std::size_t>(c)];
          const auto each = [&](auto use) {
            for (int j = 0; j < down.count; ++j)
              for (int i = 0; i < across.count; ++i)
                use(static_cast<std::int64_t>(down.weight[static_cast<std::size_t>(j)]) *
                        across.weight[static_cast<std::size_t>(i)],
                    values.at(across.first + i, down.first + j, c));
          };
          if (is_norm(e)) {
            int128 sum = 0;
            each([&](std::int64_t w, double t) {
              sum += static_cast<int128>(w) * static_cast<std::int64_t>(t);
            });
            const bool negative = sum < 0;
            const int128 size = negative ? -sum : sum;
            int128 whole = size / denominator;
            const int128 twice = 2 * (size % denominator);
            if (twice > denominator || (twice == denominator && (whole & 1) != 0)) ++whole;
            const auto code = static_cast<std::uint64_t>(whole);
            next.at(x, y, c) = (negative ? ~code + 1 : code) & low_bits(e.width);
          } else {
            if (const auto odd = mip_detail::mean_to_odd(each, static_cast<double>(denominator))) {
              next.at(x, y, c) = encode(e, *odd);
              continue;
            }
            double plain = 0;
            bool finite = true;
            each([&](std::int64_t w, double t) {
              plain += static_cast<double>(w) * t;
              finite = finite && std::isfinite(t);
            });
            if (!finite) {  // no rational is, and dividing by weights would change nothing
              next.at(x, y, c) = encode(e, plain);
              continue;
            }
            T sum = static_cast<T>(0);
            each([&](std::int64_t w, double t) {
              sum = sum + static_cast<T>(static_cast<double>(w)) * static_cast<T>(t);
            });
            next.at(x, y, c) =
                encode_exact(e, sum / static_cast<T>(static_cast<double>(down.denominator)) /
                                    static_cast<T>(static_cast<double>(across.denominator)));
          }
        }
      }
    }
    levels.push_back(std::move(next));
  }
  return levels;
}

}  // namespace bitshade
