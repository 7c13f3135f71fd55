// Which lookup's loop a job gets, for one instruction set.
#pragma once

#include "texture/sample_wide.hpp"

namespace bitshade::texture_kernels {

template <class V, class Texels, bool Norm>
bool products_of(const sample_job& job) {
  const sum_of_products<V, Norm> operation;
  const auto none = [](std::size_t, std::size_t, const float*, const float*) {};
  if (job.channels == 1) wide_rows<V, Texels, 1, sum_of_products<V, Norm>>(job, operation).run(none);
  if (job.channels == 2) wide_rows<V, Texels, 2, sum_of_products<V, Norm>>(job, operation).run(none);
  return true;
}

template <class V, class Texels, grid Grid, blend Order>
bool rows_of(const sample_job& job) {
  if (job.channels == 1) sample_rows<V, Texels, 1, Grid, Order>(job).run();
  if (job.channels == 2) sample_rows<V, Texels, 2, Grid, Order>(job).run();
  return true;
}

template <class V, class Texels, bool Norm, class Codes>
bool sample_of(const sample_job& job) {
  if (job.order == blend::products) {
    return job.snapped == grid::weights && products_of<V, Codes, Norm>(job);
  }
  if (job.order == blend::fma) {
    return job.snapped == grid::none && rows_of<V, Texels, grid::none, blend::fma>(job);
  }
  switch (job.snapped) {
    case grid::none:
      return rows_of<V, Texels, grid::none, blend::mul_add>(job);
    case grid::floor:
      return rows_of<V, Texels, grid::floor, blend::mul_add>(job);
    case grid::nearest:
      return rows_of<V, Texels, grid::nearest, blend::mul_add>(job);
    case grid::weights:
      break;
  }
  return false;
}

template <class V>
bool sample_in(const sample_job& job) {
  if constexpr (V::samples) {
    switch (job.kind) {
      case texels::binary32:
        return sample_of<V, native_texels<V>, false, native_texels<V>>(job);
      case texels::half:
        return sample_of<V, half_texels<V>, false, half_texels<V>>(job);
      case texels::unorm16:
        return sample_of<V, unorm16_texels<V>, true, code_texels<V>>(job);
    }
  }
  return false;
}

template <class V, int Channels>
void certify(certify_job& job) {
  using W = typename V::wide;
  const interval_ends<V> ends{W::all(job.relative_error), W::all(1 / job.divisor),
                              job.divisor != 1};
  const wide_rows<V, native_texels<V>, Channels, interval_ends<V>> rows(job.lookup, ends);
  rows.run([&](std::size_t at, std::size_t n, const float* low, const float* high) {
    if (n == V::width * Channels) {
      bool all = true;
      for (int c = 0; c < Channels; ++c) {
        const auto a = V::load(low + c * V::width), b = V::load(high + c * V::width);
        const auto same = V::bits(V::sub(a, b));  // +0 where both are one finite number
        all &= V::all(V::ieq(same, V::all_bits(0))) && V::all(V::ne(a, V::all(0.0f)));
      }
      if (all) return;
    }
    for (std::size_t k = 0; k < n; ++k) {
      if (!(low[k] == high[k]) || low[k] == 0) {
        job.undecided[job.count++] = static_cast<std::uint32_t>(at + k);
      }
    }
  });
}

template <class V>
bool certify_in(certify_job& job) {
  if constexpr (V::samples) {
    if (job.lookup.channels == 1) certify<V, 1>(job);
    if (job.lookup.channels == 2) certify<V, 2>(job);
    return true;
  }
  return false;
}

}  // namespace bitshade::texture_kernels
