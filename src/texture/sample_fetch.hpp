// The four texels of each of a vector of samples, as vectors in the results' order.
#pragma once

#include "texture/jobs.hpp"
#include "texture/texels.hpp"

namespace bitshade::texture_kernels {

/// A vector of samples: where their first texels lie, and how far they are from them.
template <class V>
struct located {
  int place[V::width];  ///< of the upper left value, in values
  typename V::f fx, fy;
  bool inner;  ///< all four texels of all samples lie in the image, side by side
};

/// Four vectors of texels: part Part of `Channels`, as many samples as fit.
template <class V>
struct four {
  typename V::f t00, t10, t01, t11;
};

/// Texels of inner samples. Part: the lower or upper half of the samples, where they have two
/// channels; else 0.
template <class V, class Texels, int Channels, int Part>
[[gnu::always_inline]] inline four<V> fetch(const Texels& texels, const sample_job& job,
                                            const int* place) {
  using code = typename Texels::code;
  using f = typename V::f;
  const code* in = static_cast<const code*>(job.in);
  const code* below = in + static_cast<std::size_t>(job.width) * Channels;
  if constexpr (Channels == 2 && Texels::integers && requires { V::couples_of_two(in, place); }) {
    const int* at = place + Part * static_cast<int>(V::width) / 2;
    const auto u = V::couples_of_two(in, at), l = V::couples_of_two(below, at);
    const auto first = [&](auto x) { return texels.wide(V::template half_of_each<0>(x)); };
    const auto last = [&](auto x) { return texels.wide(V::template half_of_each<1>(x)); };
    return {first(u), last(u), first(l), last(l)};
  } else if constexpr (Channels == 2) {
    const int* at = place + Part * static_cast<int>(V::width) / 2;
    const f u0 = texels.narrow(V::quads(in, at)), u1 = texels.narrow(V::quads(in, at + 1));
    const f l0 = texels.narrow(V::quads(below, at)), l1 = texels.narrow(V::quads(below, at + 1));
    return {V::low_pairs(u0, u1), V::high_pairs(u0, u1), V::low_pairs(l0, l1),
            V::high_pairs(l0, l1)};
  } else if constexpr (sizeof(code) == sizeof(float)) {
    const auto at = V::load_ints(place);
    const f u0 = V::template couples<0>(in, at), u1 = V::template couples<1>(in, at);
    const f l0 = V::template couples<0>(below, at), l1 = V::template couples<1>(below, at);
    return {V::template lefts<1>(u0, u1), V::template rights<1>(u0, u1),
            V::template lefts<1>(l0, l1), V::template rights<1>(l0, l1)};
  } else {
    const auto at = V::load_ints(place);
    const auto u = V::couples(in, at), l = V::couples(below, at);
    const auto low = V::all_bits(0xffff), sixteen = V::all_bits(16);
    return {texels.wide(V::and_(u, low)), texels.wide(V::shr(u, sixteen)),
            texels.wide(V::and_(l, low)), texels.wide(V::shr(l, sixteen))};
  }
}

/// The texels of samples at an edge, one by one, in the results' order: `parts` of them.
template <class V, class Texels, int Channels>
void fetch_edges(const Texels& texels, const sample_job& job, const float* u, const float* v,
                 double* fx, double* fy, four<V> (&parts)[Channels]) {
  using code = typename Texels::code;
  constexpr int width = static_cast<int>(V::width);
  float t[4][width * Channels];
  for (int s = 0; s < width; ++s) {
    const axis_lookup x = job.define(job, u[s], false), y = job.define(job, v[s], true);
    fx[s] = x.weight;
    fy[s] = y.weight;
    const int columns[2] = {x.i0, x.i1}, rows[2] = {y.i0, y.i1};
    for (int k = 0; k < 4; ++k) {
      const int column = columns[k % 2], row = rows[k / 2];
      for (int c = 0; c < Channels; ++c) {
        float& to = t[k][s * Channels + c];
        to = job.border[c];
        if (column < 0 || row < 0) continue;
        code one[V::width] = {static_cast<const code*>(
            job.in)[(static_cast<std::size_t>(row) * static_cast<std::size_t>(job.width) +
                     static_cast<std::size_t>(column)) *
                        Channels +
                    static_cast<std::size_t>(c)]};
        float value[V::width];
        V::store(value, texels.load(one));
        to = value[0];
      }
    }
  }
  for (int p = 0; p < Channels; ++p) {
    const auto part = [&](int k) { return V::load(t[k] + p * width); };
    parts[p] = {part(0), part(1), part(2), part(3)};
  }
}

}  // namespace bitshade::texture_kernels
