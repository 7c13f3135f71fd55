// Convolution shadow maps as runs.
#include "bitshade/shadow/csm.hpp"

#include "run/filtered_exact.hpp"
#include "run/texel_technique.hpp"

namespace bitshade {

namespace {

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

}  // namespace

void run_csm_native(run_context& run) {
  run_texel_map(run, csm_map{csm_constants_for(run.how.terms, run.storage.format)});
}

void run_csm_exact(run_context& run) {
  csm_constants constants;
  constants.terms = run.how.terms;
  constants.biased = false;
  run_filtered_exact(run, csm_map{constants});
}

}  // namespace bitshade
