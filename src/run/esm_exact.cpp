// Exponential shadow maps without rounding.
#include "bitshade/shadow/esm.hpp"

#include "io/error.hpp"
#include "run/filtered_exact.hpp"

namespace bitshade {

namespace {

constexpr double exact_exponent_cap = 300;

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

}  // namespace

void run_esm_exact(run_context& run) {
  if (run.how.exponent > exact_exponent_cap) {
    throw usage_error("exact ESM takes exponents up to 300, not " +
                      std::to_string(run.how.exponent));
  }
  run_filtered_exact(run, esm_map{{run.how.exponent, 0}});
}

}  // namespace bitshade
