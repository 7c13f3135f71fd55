// Bilinear lookups, a vector of samples at a time.
#pragma once

#include "texture/sample_fetch.hpp"

namespace bitshade::texture_kernels {

/// Coordinates of a vector of samples in binary32.
template <class V, int Channels, grid Grid>
[[gnu::always_inline]] inline void locate(const sample_job& job, const float* u, const float* v,
                                          located<V>& at) {
  using f = typename V::f;
  const f half = V::all(0.5f), zero = V::all(0.0f);
  const auto axis = [&](const float* p, int size, f& weight) __attribute__((always_inline)) {
    f x = V::sub(V::mul(V::load(p), V::all(static_cast<float>(size))), half);
    // + 0 turns a zero that was rounded up to from below into +0, as an integer's is.
    if constexpr (Grid == grid::floor || Grid == grid::nearest) {
      const f scaled = V::mul(x, V::all(256.0f));
      const f whole = Grid == grid::floor ? V::floor(scaled) : V::nearest(scaled);
      x = V::mul(V::add(whole, zero), V::all(1 / 256.0f));
    }
    const f first = V::floor(x);
    weight = V::sub(x, V::add(first, zero));
    return first;
  };
  const f x = axis(u, job.width, at.fx), y = axis(v, job.height, at.fy);
  // As unsigned integers, so that what lies before the first texel, and NaN, is beyond the last.
  const auto column = V::to_int(x), line = V::to_int(y);
  const auto last = [](int size) { return V::all_bits(static_cast<std::uint32_t>(size - 2)); };
  at.inner = job.width > 1 && job.height > 1 && !V::any(V::ugt(column, last(job.width))) &&
             !V::any(V::ugt(line, last(job.height)));
  const auto row = V::imul(line, V::all_bits(static_cast<std::uint32_t>(job.width)));
  const auto texel = V::iadd(row, column);
  V::store_ints(at.place, Channels == 2 ? V::iadd(texel, texel) : texel);
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

  void run() {
    std::size_t i = 0;
    for (; i + V::width <= job_.n; i += V::width) {
      vector(job_.u + i, job_.v + i, job_.out + i * Channels);
    }
    if (i == job_.n) return;
    // The last samples, the others of the vector in the middle of the image.
    float u[V::width], v[V::width], out[V::width * Channels];
    for (std::size_t k = 0; k < V::width; ++k) {
      u[k] = i + k < job_.n ? job_.u[i + k] : 0.5f;
      v[k] = i + k < job_.n ? job_.v[i + k] : 0.5f;
    }
    vector(u, v, out);
    for (std::size_t k = i * Channels; k < job_.n * Channels; ++k) {
      job_.out[k] = out[k - i * Channels];
    }
  }

 private:
  using f = typename V::f;

  [[gnu::always_inline]] void vector(const float* u, const float* v, float* out) const {
    located<V> at;
    locate<V, Channels, Grid>(job_, u, v, at);
    if (!at.inner) return edges(u, v, out);
    const auto part = [&]<int Part>() __attribute__((always_inline)) {
      put<Part>(fetch<V, Texels, Channels, Part>(texels_, job_, at.place), at.fx, at.fy, out);
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
    fetch_edges<V, Texels, Channels>(texels_, job_, u, v, wx, wy, parts);
    float fx[V::width], fy[V::width];
    for (std::size_t k = 0; k < V::width; ++k) {
      fx[k] = static_cast<float>(wx[k]);
      fy[k] = static_cast<float>(wy[k]);
    }
    put<0>(parts[0], V::load(fx), V::load(fy), out);
    if constexpr (Channels == 2) put<1>(parts[1], V::load(fx), V::load(fy), out);
  }

  const sample_job& job_;
  const Texels texels_{};
};

}  // namespace bitshade::texture_kernels
