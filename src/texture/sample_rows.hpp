// Bilinear lookups, a vector of samples at a time.
#pragma once

#include "texture/sample_fetch.hpp"

namespace bitshade::texture_kernels {

/// What all samples of a job have in common, in registers: the compiler cannot know that storing
/// results leaves the job as it is.
template <class V>
struct level_size {
  typename V::f width, height;
  typename V::i last_column, last_line;  ///< of the first of two texels
  typename V::i stride;
  bool has_inner;

  explicit level_size(const sample_job& job)
      : width(V::all(static_cast<float>(job.width))),
        height(V::all(static_cast<float>(job.height))),
        last_column(V::all_bits(static_cast<std::uint32_t>(job.width - 2))),
        last_line(V::all_bits(static_cast<std::uint32_t>(job.height - 2))),
        stride(V::all_bits(static_cast<std::uint32_t>(job.width))),
        has_inner(job.width > 1 && job.height > 1) {}
};

/// Where the upper left texels lie, from their column and line.
template <class V, int Channels>
[[gnu::always_inline]] inline void place(const level_size<V>& size, typename V::i column,
                                         typename V::i line, int* places, bool& inner) {
  // As unsigned integers, so that what lies before the first texel, and NaN, is beyond the last.
  inner = size.has_inner && !V::any(V::or_(V::ugt(column, size.last_column),
                                           V::ugt(line, size.last_line)));
  const auto texel = V::iadd(V::imul(line, size.stride), column);
  V::store_ints(places, Channels == 2 ? V::iadd(texel, texel) : texel);
}

/// Coordinates of a vector of samples in binary32.
template <class V, int Channels, grid Grid>
[[gnu::always_inline]] inline void locate(const level_size<V>& size, const float* u, const float* v,
                                          located<V>& at) {
  using f = typename V::f;
  const f half = V::all(0.5f), zero = V::all(0.0f);
  const auto axis = [&](const float* p, f length, f& weight) __attribute__((always_inline)) {
    f x = V::sub(V::mul(V::load(p), length), half);
    // + 0 turns a zero that was rounded up to from below into +0, as an integer's is.
    if constexpr (Grid == grid::floor || Grid == grid::nearest) {
      const f scaled = V::mul(x, V::all(256.0f));
      const f whole = Grid == grid::floor ? V::floor(scaled) : V::nearest(scaled);
      x = V::mul(V::add(whole, zero), V::all(1 / 256.0f));
    }
    const auto first = V::floor_to_int(x);
    weight = V::sub(x, V::to_float(first));
    return first;
  };
  const auto column = axis(u, size.width, at.fx), line = axis(v, size.height, at.fy);
  place<V, Channels>(size, column, line, at.place, at.inner);
}

template <class V, blend Order>
[[gnu::always_inline]] inline typename V::f interpolate(const four<V>& t, typename V::f fx,
                                                        typename V::f fy) {
  using f = typename V::f;
  const auto lerp = [](f a, f b, f by) __attribute__((always_inline)) {
    if constexpr (Order == blend::fma) return V::fma(by, V::sub(b, a), a);
    return V::add(a, V::mul(by, V::sub(b, a)));
  };
  return lerp(lerp(t.t00, t.t10, fx), lerp(t.t01, t.t11, fx), fy);
}

template <class V, class Texels, int Channels, grid Grid, blend Order>
class sample_rows {
 public:
  explicit sample_rows(const sample_job& job) : job_(job) {}

  void run() const {
    const level_size<V> size(job_);
    const Texels texels;
    const sample_job job = job_;
    std::size_t i = 0;
    while (i + V::width <= job.n) {
      located<V> at[V::located_ahead];
      const std::size_t left = (job.n - i) / V::width;
      const std::size_t count = left < V::located_ahead ? left : V::located_ahead;
      for (std::size_t k = 0; k < count; ++k) {
        const std::size_t from = i + k * V::width;
        locate<V, Channels, Grid>(size, job.u + from, job.v + from, at[k]);
      }
      for (std::size_t k = 0; k < count; ++k, i += V::width) {
        vector(texels, job, at[k], job.u + i, job.v + i, job.out + i * Channels);
      }
    }
    if (i == job.n) return;
    // The last samples, the others of the vector in the middle of the image.
    float u[V::width], v[V::width], out[V::width * Channels];
    for (std::size_t k = 0; k < V::width; ++k) {
      u[k] = i + k < job.n ? job.u[i + k] : 0.5f;
      v[k] = i + k < job.n ? job.v[i + k] : 0.5f;
    }
    located<V> at;
    locate<V, Channels, Grid>(size, u, v, at);
    vector(texels, job, at, u, v, out);
    for (std::size_t k = i * Channels; k < job.n * Channels; ++k) {
      job.out[k] = out[k - i * Channels];
    }
  }

 private:
  using f = typename V::f;

  [[gnu::always_inline]] void vector(const Texels& texels, const sample_job& job,
                                     const located<V>& at, const float* u, const float* v,
                                     float* out) const {
    if (!at.inner) return edges(u, v, out);
    const auto part = [&]<int Part>() __attribute__((always_inline)) {
      put<Part>(fetch<V, Texels, Channels, Part>(texels, job, at.place), at.fx, at.fy, out);
    };
    part.template operator()<0>();
    if constexpr (Channels == 2) part.template operator()<1>();
  }

  template <int Part>
  [[gnu::always_inline]] void put(const four<V>& t, f fx, f fy, float* out) const {
    if constexpr (Channels == 2) {
      fx = V::template twice<Part>(fx);
      fy = V::template twice<Part>(fy);
    }
    V::store(out + Part * V::width, interpolate<V, Order>(t, fx, fy));
  }

  [[gnu::noinline]] void edges(const float* u, const float* v, float* out) const {
    double wx[V::width], wy[V::width];
    four<V> parts[Channels];
    fetch_edges<V, Texels, Channels>(Texels(), job_, u, v, wx, wy, parts);
    float fx[V::width], fy[V::width];
    for (std::size_t k = 0; k < V::width; ++k) {
      fx[k] = static_cast<float>(wx[k]);
      fy[k] = static_cast<float>(wy[k]);
    }
    put<0>(parts[0], V::load(fx), V::load(fy), out);
    if constexpr (Channels == 2) put<1>(parts[1], V::load(fx), V::load(fy), out);
  }

  const sample_job& job_;
};

}  // namespace bitshade::texture_kernels
