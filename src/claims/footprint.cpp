#include "claims/footprint.hpp"

#include <array>

#include "bitshade/formats/round_to.hpp"

namespace bitshade::claims {
namespace {

template <class Keep>
number light_of(const method& m, std::span<const number> x, const number& t, const interval& layer,
                double min_variance, Keep keep) {
  std::vector<number> first, second;
  for (const number& depth : x) {
    const number warped = m.warp(depth, layer);
    first.push_back(keep(warped));
    second.push_back(keep(warped * warped));
  }
  return m.chebyshev(m.variance(m.filter(first), m.filter(second)), m.warp(t, layer),
                     m.floor(min_variance, layer));
}

}  // namespace

number light(const method& m, std::span<const number> x, const number& t, const interval& layer,
             double min_variance) {
  return light_of(m, x, t, layer, min_variance, [](const number& v) { return v; });
}

number stored_light(const method& m, const encoding& format, std::span<const number> x,
                    const number& t, const interval& layer, double min_variance) {
  // A rational has no infinity: what a spoilt warp sends beyond the format stays at its end.
  rules r;
  r.overflow = overflow::saturate;
  return light_of(m, x, t, layer, min_variance, [&](const number& v) {
    return number(round_to(format, static_cast<double>(v), r));
  });
}

number share_lit(std::span<const number> x, const number& t) {
  int lit = 0;
  for (const number& depth : x) lit += depth >= t ? 1 : 0;
  return number(lit, static_cast<int>(x.size()));
}

std::vector<number> two_depths(const number& a, const number& b, int nearer, int of) {
  std::vector<number> x(static_cast<std::size_t>(of), b);
  std::fill_n(x.begin(), nearer, a);
  return x;
}

layering layers_from(const method& m, std::vector<double> interior, double overlap) {
  layering result{splits_from(interior), {}};
  result.layers = m.intervals(result.splits, overlap);
  return result;
}

std::span<const named_format> storage_formats() {
  static constexpr std::array formats{named_format{"unorm16", unorm16::value},
                                      named_format{"half", binary16::value},
                                      named_format{"binary32", binary32::value}};
  return formats;
}

double largest_step(const encoding& format) {
  if (format.kind == family::binary)
    return 1.0 / static_cast<double>(std::uint64_t{2} << format.fraction_bits);
  return 1.0 / static_cast<double>((std::uint64_t{1} << format.width) - 1);
}

}  // namespace bitshade::claims
