// Four-moment shadow maps as runs.
#include "bitshade/shadow/msm.hpp"

#include "run/filtered_exact.hpp"
#include "run/texel_technique.hpp"

namespace bitshade {

namespace {

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
    const auto m = basis ? from_basis(stored, *basis)
                         : four_moments<T>{stored[0], stored[1], stored[2], stored[3]};
    return bound == moment_bound::hausdorff ? hausdorff_bound(biased(m, bias), centred_depth(t))
                                            : hamburger_bound(biased(m, bias), centred_depth(t));
  }
};

}  // namespace

void run_msm_native(run_context& run) {
  const auto& basis = run.how.optimised_basis ? msm_optimised_transform : msm_dense_transform;
  run_texel_map(run, msm_map{&basis, run.how.moment_bias, run.how.bound});
}

/// A basis changes no exact result: filters are affine, and so is it.
void run_msm_exact(run_context& run) {
  run_filtered_exact(run, msm_map{nullptr, run.how.moment_bias, run.how.bound});
}

}  // namespace bitshade
