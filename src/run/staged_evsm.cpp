#include <stdexcept>

#include "bitshade/shadow/evsm.hpp"
#include "io/error.hpp"
#include "run/slope.hpp"
#include "run/staged.hpp"
#include "run/staged_layers.hpp"

namespace bitshade {

namespace {

/// evsm2 and evsm4 over any number; the same operations as evsm_technique's.
template <class V>
class staged_evsm {
 public:
  staged_evsm(const configuration& how, const storage_format& storage)
      : how_(how), four_(how.method == technique::evsm4), constants_(constants_of(how, storage)) {}

  int channels() const { return four_ ? 4 : 2; }
  void begin(const interval&) {}
  template <class Keep>
  void fill(const image<float>& depth, int y, std::span<V> row, Keep) const {
    const auto count = static_cast<std::size_t>(channels());
    positive_warp_row<V>(depth.row(y), constants_, row, count);
    if (four_) negative_warp_row<V>(depth.row(y), constants_, row, count);
    for (std::size_t i = 0; i < row.size(); i += 2) row[i + 1] = row[i] * row[i];
    if (how_.slope_term) add_evsm_slope<V>(depth, y, constants_, count, row);
  }
  V light(std::span<const V> m, const V& t) const {
    const V bound = evsm_positive_bound(m[0], m[1], t, constants_, how_.min_variance);
    if (!four_) return bound;
    return evsm_bound(bound, evsm_negative_bound(m[2], m[3], t, constants_, how_.min_variance));
  }
  shading_input shading(const std::vector<double>&, double) const { return {}; }

 private:
  static evsm_constants constants_of(const configuration& how, const storage_format& storage) {
    const double negative = how.method == technique::evsm4 ? how.negative_exponent : how.exponent;
    try {
      return evsm_constants_for(how.exponent, negative, storage.format, how.format);
    } catch (const std::invalid_argument& e) {
      throw usage_error(e.what());
    }
  }
  const configuration& how_;
  bool four_;
  evsm_constants constants_;
};

}  // namespace

void run_staged_evsm(const staged_run& run) {
  in_arithmetic_of(run.storage, [&]<class T>(T) {
    run_staged_layers<staged_engine<T, staged_evsm>>(run);
  });
}

}  // namespace bitshade
