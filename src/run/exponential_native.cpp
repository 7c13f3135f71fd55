#include <stdexcept>

#include "bitshade/shadow/esm.hpp"
#include "bitshade/shadow/evsm.hpp"
#include "io/error.hpp"
#include "run/engines.hpp"
#include "run/layered_run.hpp"
#include "run/native.hpp"
#include "run/natural.hpp"
#include "run/slope.hpp"
#include "run/variance.hpp"

namespace bitshade {

namespace {

/// EVSM with two or four components.
template <class T>
class evsm_technique {
 public:
  evsm_technique(const run_context& run, const evsm_constants& constants)
      : how_(run.how), constants_(constants), four_(run.how.method == technique::evsm4) {
    const auto floors =
        warped_noise_floors(run.how, run.storage, run.scene.depth, constants);
    noise_[0] = static_cast<T>(floors[0]);
    noise_[1] = static_cast<T>(floors[1]);
  }

  int channels() const { return four_ ? 4 : 2; }
  void begin(const interval&) {}

  void fill(const image<float>& depth, int y, std::span<T> row) const {
    const auto count = static_cast<std::size_t>(channels());
    positive_warp_row<T>(depth.row(y), constants_, row, count);
    if (four_) negative_warp_row<T>(depth.row(y), constants_, row, count);
    for (std::size_t i = 0; i < row.size(); i += 2) row[i + 1] = row[i] * row[i];
    if (how_.slope_term) add_evsm_slope(depth, y, constants_, count, row);
  }

  T light(std::span<const T> m, const T& t) const {
    const T bound = evsm_positive_bound(m[0], m[1], t, constants_, how_.min_variance, noise_[0]);
    if (!four_) return bound;
    return evsm_bound(bound,
                      evsm_negative_bound(m[2], m[3], t, constants_, how_.min_variance, noise_[1]));
  }

 private:
  const configuration& how_;
  evsm_constants constants_;
  bool four_;
  T noise_[2]{};
};

template <class T>
class esm_technique {
 public:
  explicit esm_technique(const esm_constants& constants) : constants_(constants) {}

  int channels() const { return 1; }
  void begin(const interval&) {}
  void fill(const image<float>& depth, int y, std::span<T> row) const {
    esm_row<T>(depth.row(y), constants_, row);
  }
  T light(std::span<const T> m, const T& t) const { return esm_visibility(m[0], t, constants_); }

 private:
  esm_constants constants_;
};

template <class T, class Technique>
void run_technique(run_context& run, const Technique& technique) {
  if constexpr (std::is_same_v<T, float>)
    if (runs_naturally(run)) return run_natural(run, technique);
  native_engine<T, Technique> engine(run, technique);
  run_layers(engine, run);
}

template <class T>
void run_in(run_context& run) {
  const configuration& how = run.how;
  try {
    if (how.method == technique::esm) {
      run_technique<T>(
          run, esm_technique<T>(esm_constants_for(how.exponent, run.storage.format, how.format)));
    } else {
      const double negative = how.method == technique::evsm4 ? how.negative_exponent : how.exponent;
      run_technique<T>(
          run, evsm_technique<T>(run, evsm_constants_for(how.exponent, negative, run.storage.format,
                                                         how.format)));
    }
  } catch (const std::invalid_argument& e) {
    throw usage_error(e.what());
  }
}

}  // namespace

void run_exponential_native(run_context& run) {
  run.storage.wide ? run_in<double>(run) : run_in<float>(run);
}

}  // namespace bitshade
