// Weighted sums along rows and columns: vectors across pixels, taps in their order.
#pragma once

#include <cstddef>
#include <utility>

namespace bitshade::texture_kernels {

/// Products with a symmetric kernel's weights: those of taps k and taps - 1 - k are the same.
template <class V, int Taps>
struct symmetric_products {
  static constexpr int classes = Taps / 2 + 1;
  static constexpr int class_of(int tap) { return tap < classes ? tap : Taps - 1 - tap; }
  typename V::f of[classes];

  [[gnu::always_inline]] void make(const typename V::f* weights, typename V::f x) {
    for (int c = 0; c < classes; ++c) of[c] = V::mul(weights[c], x);
  }
};

template <class V, int Taps>
struct symmetric_weights {
  typename V::f of[Taps / 2 + 1];
  [[gnu::always_inline]] explicit symmetric_weights(const float* w) {
    for (int c = 0; c <= Taps / 2; ++c) of[c] = V::all(w[c]);
  }
};

/// out[i] = sum over k of w_k * in[i + k * Step], whole vectors up to n.
///
/// Each product is made once and slid into place: shuffles cost less than reading across cache
/// lines. Reads up to in[n + 2 * width).
template <class V, int Taps, int Step>
void slide_sum(const float* in, const float* w, float* out, std::size_t n) {
  static_assert((Taps - 1) * Step <= static_cast<int>(V::width));
  using f = typename V::f;
  using products = symmetric_products<V, Taps>;
  constexpr std::size_t ahead = 512;  // half a page: what the processor does not foresee
  const symmetric_weights<V, Taps> weights(w);
  products here, next;
  here.make(weights.of, V::load(in));
  for (std::size_t i = 0; i < n; i += V::width) {
    __builtin_prefetch(in + i + ahead);
    next.make(weights.of, V::load(in + i + V::width));
    f sum = here.of[0];
    const auto add = [&]<int K>() __attribute__((always_inline)) {
      constexpr int c = products::class_of(K);
      sum = V::add(sum, V::template slide<K * Step>(here.of[c], next.of[c]));
    };
    [&]<int... K>(std::integer_sequence<int, K...>) __attribute__((always_inline)) {
      (add.template operator()<K + 1>(), ...);
    }(std::make_integer_sequence<int, Taps - 1>{});
    V::store(out + i, sum);
    here = next;
  }
}

/// The same for any taps: source(k) is where the tap's vector of out[0] lies.
template <class V, class Source, class Put>
[[gnu::always_inline]] inline void tap_sum(int taps, const float* w, std::size_t n, Source source,
                                           Put put) {
  using f = typename V::f;
  constexpr int many = 8;
  const auto sums = [&]<int Count>(std::size_t i) __attribute__((always_inline)) {
    f sum[Count];
    const f first = V::all(w[0]);
    for (int u = 0; u < Count; ++u) sum[u] = V::mul(first, V::load(source(0) + i + u * V::width));
    for (int k = 1; k < taps; ++k) {
      const f weight = V::all(w[k]);
      const float* in = source(k) + i;
      for (int u = 0; u < Count; ++u) {
        sum[u] = V::add(sum[u], V::mul(weight, V::load(in + u * V::width)));
      }
    }
    for (int u = 0; u < Count; ++u) put(i + u * V::width, sum[u]);
  };
  std::size_t i = 0;
  for (; i + many * V::width <= n; i += many * V::width) sums.template operator()<many>(i);
  for (; i < n; i += V::width) sums.template operator()<1>(i);
}

/// Rows rows at once, out row r = sum over k of w_k * rows[r + k], whole vectors from `first` up to
/// n: each source row is read once for all of them, and each product made once. All sums take one
/// step before any takes the next, as written: one sum after the other, each would wait for itself.
template <class V, int Taps, int Rows, class Put>
[[gnu::always_inline]] inline void row_sums(const float* const* rows, const float* w,
                                            std::size_t first, std::size_t n, Put put) {
  using f = typename V::f;
  using products = symmetric_products<V, Taps>;
  const symmetric_weights<V, Taps> weights(w);
  for (std::size_t i = first; i < n; i += V::width) {
    f sum[Rows];
    products product;
    const auto add = [&]<int Line, int Row>() __attribute__((always_inline)) {
      constexpr int k = Line - Row;
      if constexpr (k == 0) sum[Row] = product.of[0];
      if constexpr (k > 0 && k < Taps) {
        sum[Row] = V::add(sum[Row], product.of[products::class_of(k)]);
      }
    };
    const auto line = [&]<int Line, int... Row>(std::integer_sequence<int, Row...>)
        __attribute__((always_inline)) {
      product.make(weights.of, V::load(rows[Line] + i));
      (add.template operator()<Line, Row>(), ...);
      ((Row <= Line ? V::keep_here(sum[Row]) : void()), ...);
    };
    [&]<int... Line>(std::integer_sequence<int, Line...>) __attribute__((always_inline)) {
      (line.template operator()<Line>(std::make_integer_sequence<int, Rows>{}), ...);
    }(std::make_integer_sequence<int, Taps + Rows - 1>{});
    const auto store = [&]<int... Row>(std::integer_sequence<int, Row...>)
        __attribute__((always_inline)) { (put(Row, i, sum[Row]), ...); };
    store(std::make_integer_sequence<int, Rows>{});
  }
}

}  // namespace bitshade::texture_kernels
