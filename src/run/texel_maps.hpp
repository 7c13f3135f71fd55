// What exponential, convolution and four-moment maps store of a depth, and the light of it filtered:
// the Maps of texel_technique.hpp, filtered_exact.hpp and staged_texels.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "bitshade/shadow/csm.hpp"
#include "bitshade/shadow/esm.hpp"
#include "bitshade/shadow/msm.hpp"
#include "bitshade/study/configuration.hpp"

namespace bitshade {

struct esm_map {
  esm_constants constants;

  std::size_t channels() const { return 1; }
  template <class T>
  void texel(const T& x, std::span<T> out) const {
    out[0] = esm_warp(x, constants);
  }
  template <class T>
  T light(std::span<const T> filtered, const T& t) const {
    return esm_visibility(filtered[0], t, constants);
  }
};

struct csm_map {
  csm_constants constants;

  std::size_t channels() const { return constants.channels(); }
  template <class T>
  void texel(const T& x, std::span<T> out) const {
    csm_texel(x, constants, out);
  }
  template <class T>
  T light(std::span<const T> filtered, const T& t) const {
    return csm_visibility(filtered, t, constants);
  }
};

struct msm_map {
  const msm_transform* basis;  ///< none: the moments themselves
  double bias;
  moment_bound bound;

  std::size_t channels() const { return 4; }
  template <class T>
  void texel(const T& x, std::span<T> out) const {
    const auto m = moments_of(x);
    const std::array<T, 4> stored =
        basis ? to_basis(m, *basis) : std::array<T, 4>{m.b1, m.b2, m.b3, m.b4};
    std::copy(stored.begin(), stored.end(), out.begin());
  }
  template <class T>
  T light(std::span<const T> filtered, const T& t) const {
    const std::array<T, 4> stored{filtered[0], filtered[1], filtered[2], filtered[3]};
    return light_of(basis ? from_basis(stored, *basis)
                          : four_moments<T>{stored[0], stored[1], stored[2], stored[3]},
                    t);
  }
  template <class T>
  T light_of(const four_moments<T>& m, const T& t) const {
    return bound == moment_bound::hausdorff ? hausdorff_bound(biased(m, bias), centred_depth(t))
                                            : hamburger_bound(biased(m, bias), centred_depth(t));
  }
};

/// Four moments as a format stores them.
inline msm_map stored_msm_map(const configuration& how) {
  return {how.optimised_basis ? &msm_optimised_transform : &msm_dense_transform, how.moment_bias,
          how.bound};
}

}  // namespace bitshade
