// Lookups in binary64: sums that are rounded once, and certified exact values.
#pragma once

#include "texture/sample_rows.hpp"

namespace bitshade::texture_kernels {

/// The sum of four products, weights on the grid of 2^-8, rounded to binary32 at the end.
template <class V, bool Norm>
struct sum_of_products {
  using W = typename V::wide;
  using f = typename W::f;
  static constexpr bool tests_exactness = false;

  /// A code's number in binary64: the quotient put right by its exact remainder [Markstein90].
  [[gnu::always_inline]] static f texel(const float* p) {
    const f c = W::load(p);
    if constexpr (!Norm) return c;
    const f step = W::all(1 / 65535.0), q = W::mul(c, step);
    return W::fma(W::fnma(q, W::all(65535.0), c), step, q);
  }
  [[gnu::always_inline]] static f weight(f x) {
    return W::mul(V::nearest(W::mul(x, W::all(256.0))), W::all(1 / 256.0));
  }
  /// 17 bits of weight times 24 of texel are exact in binary64, so that an fma rounds what a sum of
  /// products does; a norm's number has 53.
  [[gnu::always_inline]] void put(const float* t, std::size_t stride, f fx, f fy, f, float* out,
                                  float*) const {
    // Weights and their products are multiples of 2^-16 up to 1: their differences are exact.
    const f w11 = W::mul(fx, fy), w10 = W::sub(fx, w11), w01 = W::sub(fy, w11);
    const f w00 = W::sub(W::sub(W::all(1.0), fx), w01);
    const auto at = [&](std::size_t k) { return texel(t + k * stride); };
    const auto sum = [](f w, f x, f so_far) {
      if constexpr (Norm) return W::add(so_far, W::mul(w, x));
      return W::fma(w, x, so_far);
    };
    const f first = W::mul(w00, at(0));
    W::store(out, sum(w11, at(3), sum(w01, at(2), sum(w10, at(1), first))));
  }
};

/// Both ends of an interval that holds the exact value: bilinear_bounded of certified.hpp.
template <class V>
struct interval_ends {
  using W = typename V::wide;
  using f = typename W::f;
  static constexpr bool tests_exactness = true;
  f error, divisor;
  bool divides;

  [[gnu::always_inline]] static f weight(f x) { return x; }
  [[gnu::always_inline]] void put(const float* t, std::size_t stride, f fx, f fy, f inexact,
                                  float* low, float* high) const {
    const f a = W::load(t), b = W::load(t + stride), c = W::load(t + 2 * stride),
            d = W::load(t + 3 * stride);
    const auto lerp = [](f from, f to, f by) {
      return W::add(from, W::mul(by, W::sub(to, from)));
    };
    const auto size = [](f x) {
      return W::value(W::and_(W::bits(x), W::all_bits(~std::uint64_t{0} >> 1)));
    };
    f value = lerp(lerp(a, b, fx), lerp(c, d, fx), fy);
    const f most = W::max(W::max(size(a), size(b)), W::max(size(c), size(d)));
    if (divides) value = W::mul(value, divisor);
    const f radius = W::add(W::mul(most, error), inexact);
    W::store(low, W::sub(value, radius));
    W::store(high, W::add(value, radius));
  }
};

template <class V, class Texels, int Channels, class Operation>
class wide_rows {
 public:
  using W = typename V::wide;
  using f = typename W::f;
  static constexpr std::size_t values = V::width * Channels;

  wide_rows(const sample_job& job, const Operation& operation)
      : job_(job), operation_(operation) {}

  /// Calls take(i, low, high) for each vector of samples, i the first value's place in `out`.
  template <class Take>
  void run(Take take) const {
    const sample_job job = job_;  // which storing results leaves as it is
    const level_size<V> size(job);
    const Operation operation = operation_;
    std::size_t i = 0;
    while (i + V::width <= job.n) {
      spots at[V::located_ahead];
      const std::size_t left = (job.n - i) / V::width;
      const std::size_t count = left < V::located_ahead ? left : V::located_ahead;
      for (std::size_t k = 0; k < count; ++k) {
        locate(job, size, job.u + i + k * V::width, job.v + i + k * V::width, at[k]);
      }
      for (std::size_t k = 0; k < count; ++k, i += V::width) {
        float* out = job.out + i * Channels;
        float high[values];
        vector(job, operation, job.u + i, job.v + i, at[k], out, high);
        take(i * Channels, values, out, high);
      }
    }
    if (i == job.n) return;
    float u[V::width], v[V::width], low[values], high[values];
    for (std::size_t k = 0; k < V::width; ++k) {
      u[k] = i + k < job.n ? job.u[i + k] : 0.5f;
      v[k] = i + k < job.n ? job.v[i + k] : 0.5f;
    }
    spots at;
    locate(job, size, u, v, at);
    vector(job, operation, u, v, at, low, high);
    const std::size_t rest = (job.n - i) * Channels;
    for (std::size_t k = 0; k < rest; ++k) job.out[i * Channels + k] = low[k];
    take(i * Channels, rest, low, high);
  }

 private:
  struct weights {
    double fx[V::width], fy[V::width];
    double inexact[V::width];  ///< 0, or infinity where a coordinate is not exact
  };
  /// A vector of samples, located.
  struct spots {
    weights w;
    int place[V::width];
    bool inner;  ///< none lies at an edge
  };

  /// First column and line, and weights, of one half of the samples.
  template <int Half>
  [[gnu::always_inline]] static void locate_half(const sample_job& job, const float* u,
                                                 const float* v, weights& w, f (&first)[2]) {
    constexpr std::size_t at = Half * W::width;
    f exact[2];
    const auto axis = [&](int which, const float* p, int size, double* weight)
                          __attribute__((always_inline)) {
      const f scaled = W::mul(W::load(p), W::all(static_cast<double>(size)));
      const f x = W::sub(scaled, W::all(0.5));
      first[which] = V::floor(x);
      const f fraction = W::sub(x, first[which]);
      W::store(weight, Operation::weight(fraction));
      if constexpr (Operation::tests_exactness) {
        // The subtraction loses nothing, and the weight lies on the grid of 2^-32.
        const f grid = W::mul(fraction, W::all(0x1p32));
        const f lost = W::sub(W::add(x, W::all(0.5)), scaled);
        const auto on_grid = W::eq(V::floor(grid), grid);
        exact[which] = W::value(W::select(on_grid, W::bits(lost), W::bits(W::all(1.0))));
      }
    };
    axis(0, u + at, job.width, w.fx + at);
    axis(1, v + at, job.height, w.fy + at);
    if constexpr (Operation::tests_exactness) {
      const auto none = W::all_bits(0), infinite = W::all_bits(std::uint64_t{0x7ff} << 52);
      const f zero = W::all(0.0);
      const auto x = W::select(W::eq(exact[0], zero), none, infinite);
      const auto y = W::select(W::eq(exact[1], zero), none, infinite);
      W::store(w.inexact + at, W::value(W::or_(x, y)));
    }
  }

  [[gnu::always_inline]] static void locate(const sample_job& job, const level_size<V>& size,
                                            const float* u, const float* v, spots& at) {
    f low[2], high[2];
    locate_half<0>(job, u, v, at.w, low);
    locate_half<1>(job, u, v, at.w, high);
    texture_kernels::place<V, Channels>(size, V::whole(low[0], high[0]),
                                        V::whole(low[1], high[1]), at.place, at.inner);
  }

  [[gnu::always_inline]] void vector(const sample_job& job, const Operation& operation,
                                     const float* u, const float* v, spots& at, float* low,
                                     float* high) const {
    weights& w = at.w;
    const int* place = at.place;
    float t[4 * values];
    const auto keep = [&](int part, const four<V>& x) __attribute__((always_inline)) {
      V::store(t + part * V::width, x.t00);
      V::store(t + values + part * V::width, x.t10);
      V::store(t + 2 * values + part * V::width, x.t01);
      V::store(t + 3 * values + part * V::width, x.t11);
    };
    if (at.inner) {
      keep(0, fetch<V, Texels, Channels, 0>(texels_, job, place));
      if constexpr (Channels == 2) keep(1, fetch<V, Texels, Channels, 1>(texels_, job, place));
    } else {
      edges(u, v, w, t);
    }
    const auto part = [&]<int Part>() __attribute__((always_inline)) {
      constexpr int from = Channels == 2 ? Part / 2 : Part;
      const auto spread = [&](const double* p) __attribute__((always_inline)) {
        p += from * W::width;
        if constexpr (Channels != 2) {
          return W::load(p);
        } else if constexpr (requires { V::template twice_at<0>(p); }) {
          return V::template twice_at<Part % 2>(p);
        } else {
          return V::template twice<Part % 2>(W::load(p));
        }
      };
      const f inexact = Operation::tests_exactness ? spread(w.inexact) : W::all(0.0);
      operation.put(t + Part * W::width, values, spread(w.fx), spread(w.fy), inexact,
                     low + Part * W::width, high + Part * W::width);
    };
    part.template operator()<0>();
    part.template operator()<1>();
    if constexpr (Channels == 2) {
      part.template operator()<2>();
      part.template operator()<3>();
    }
  }

  [[gnu::noinline]] void edges(const float* u, const float* v, weights& w, float* t) const {
    four<V> parts[Channels];
    fetch_edges<V, Texels, Channels>(texels_, job_, u, v, w.fx, w.fy, parts);
    for (int p = 0; p < Channels; ++p) {
      V::store(t + p * V::width, parts[p].t00);
      V::store(t + values + p * V::width, parts[p].t10);
      V::store(t + 2 * values + p * V::width, parts[p].t01);
      V::store(t + 3 * values + p * V::width, parts[p].t11);
    }
    for (std::size_t k = 0; k < V::width; ++k) {
      // A weight that is none: the coordinate is not exact in binary64.
      const bool known = w.fx[k] == w.fx[k] && w.fy[k] == w.fy[k];
      w.inexact[k] = known ? 0.0 : __builtin_inf();
    }
  }

  const sample_job& job_;
  const Operation& operation_;
  const Texels texels_{};
};

}  // namespace bitshade::texture_kernels
