// Stages of esm, csm and msm.
#include "run/staged_texels.hpp"

#include <array>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "io/error.hpp"
#include "run/staged.hpp"
#include "run/staged_layers.hpp"
#include "run/texel_maps.hpp"

namespace bitshade {

namespace {

/// Shifted where the format asks for it, exact stages alike: they have to read each other's texels.
struct esm_source {
  static esm_map of(const configuration& how, const storage_format& storage) {
    try {
      return {esm_constants_for(how.exponent, storage.format, how.format)};
    } catch (const std::invalid_argument& e) {
      throw usage_error(e.what());
    }
  }
};

/// Biased where the format has no sign.
struct csm_source {
  static csm_map of(const configuration& how, const storage_format& storage) {
    return {csm_constants_for(how.terms, storage.format)};
  }
};

/// Four moments whose way back from the basis is without rounding in exact stages: the inverse in
/// msm_basis.hpp is binary64's.
struct based_msm_map {
  using matrix = std::array<std::array<staged_exact, 4>, 4>;

  explicit based_msm_map(const msm_map& map) : stored(map) {
    matrix a;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        a[i][j] = staged_exact(map.basis->matrix[i][j]);
        inverse[i][j] = staged_exact(i == j ? 1 : 0);
      }
    }
    // Gauss-Jordan with the largest pivot of each column.
    for (std::size_t column = 0; column < 4; ++column) {
      std::size_t pivot = column;
      for (std::size_t i = column + 1; i < 4; ++i)
        if (a[i][column].size_above() > a[pivot][column].size_above()) pivot = i;
      std::swap(a[column], a[pivot]);
      std::swap(inverse[column], inverse[pivot]);
      const staged_exact first = a[column][column];
      for (std::size_t j = 0; j < 4; ++j) {
        a[column][j] = a[column][j] / first;
        inverse[column][j] = inverse[column][j] / first;
      }
      for (std::size_t i = 0; i < 4; ++i) {
        if (i == column) continue;
        const staged_exact factor = a[i][column];
        for (std::size_t j = 0; j < 4; ++j) {
          a[i][j] = a[i][j] - factor * a[column][j];
          inverse[i][j] = inverse[i][j] - factor * inverse[column][j];
        }
      }
    }
  }

  std::size_t channels() const { return 4; }
  template <class V>
  void texel(const V& x, std::span<V> out) const {
    stored.texel(x, out);
  }
  template <class V>
  V light(std::span<const V> values, const V& t) const {
    if constexpr (std::is_same_v<V, staged_exact>) {
      std::array<V, 4> b;
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
          b[i] = b[i] + inverse[i][j] * (values[j] - V(stored.basis->offset[j]));
      return stored.light_of(four_moments<V>{b[0], b[1], b[2], b[3]}, t);
    } else {
      return stored.light(values, t);
    }
  }

  msm_map stored;
  matrix inverse;
};

struct msm_source {
  static based_msm_map of(const configuration& how, const storage_format&) {
    return based_msm_map(stored_msm_map(how));
  }
};

template <class V>
using staged_esm = staged_texels<V, esm_source>;
template <class V>
using staged_csm = staged_texels<V, csm_source>;
template <class V>
using staged_msm = staged_texels<V, msm_source>;

}  // namespace

void run_staged_texels(const staged_run& run) {
  in_arithmetic_of(run.storage, [&]<class T>(T) {
    switch (run.how.method) {
      case technique::esm:
        return run_staged_layers<staged_engine<T, staged_esm>>(run);
      case technique::csm:
        return run_staged_layers<staged_engine<T, staged_csm>>(run);
      default:
        return run_staged_layers<staged_engine<T, staged_msm>>(run);
    }
  });
}

}  // namespace bitshade
