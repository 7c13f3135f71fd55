// Pairs of warped texels that floating stores serve as badly as they can.
#include <algorithm>
#include <cmath>
#include <vector>

#include "bitshade/shadow/certified.hpp"
#include "bitshade/shadow/evsm.hpp"
#include "bitshade/study/precision_stages.hpp"
#include "precision/stages.hpp"
#include "precision/store.hpp"

namespace bitshade::bit_search {

namespace {

using number = ball<4>;

struct warped_texel {
  double depth = 0;
  double stored1 = 0, stored2 = 0;
  double excess = 0;  ///< of the variance, over the warped depth squared
};

class pair_search {
 public:
  pair_search(const stage_question& q, int significand_bits)
      : q_(q),
        constants_{q.exponent, q.exponent, 0},
        store_(moment_store::significand(significand_bits)) {
    const double u = unit_roundoff(significand_bits), slope = q.exponent * q.floor_deviation;
    deviation_ = slope * std::sqrt(1 + 3 * u / (slope * slope));
  }

  double run() const {
    // Just above a power of two a significand's steps are the largest: the last one below 1.
    constexpr double ln2 = 0x1.62e42fefa39efp-1;
    const double from = std::floor(0.9 * q_.exponent / ln2) * ln2 / q_.exponent;
    double worst = 0;
    if (!(2.2 * deviation_ < 1)) return worst;
    for (const double side : {-1.0, 1.0}) {
      const auto near = candidates(from, from + 0.004 / q_.exponent, side);
      for (std::size_t i = 0; i < near.size() && i < 3; ++i) {
        // w_a = w_b (1 - 2 s): half the distance is s times the receiver's warped depth.
        const double apart = -2 * deviation_ / (1 - deviation_) / q_.exponent;
        const double far = near[i].depth - apart * (1 + deviation_);
        const double reach = 0.03 * q_.floor_deviation;
        for (const auto& b : candidates(far - reach, far + reach, side)) {
          worst = std::max(worst, judged(near[i], b));
        }
      }
    }
    return worst;
  }

 private:
  std::vector<warped_texel> candidates(double low, double high, double side) const {
    std::vector<warped_texel> all;
    for (int i = 0; i < q_.tries; ++i) {
      warped_texel t;
      t.depth = std::nearbyint((low + (high - low) * i / q_.tries) * 0x1p40) * 0x1p-40;
      if (t.depth < 0 || t.depth > 1) continue;
      const double w = positive_warp(t.depth, constants_);
      t.stored1 = stored_units(store_, w);
      t.stored2 = stored_units(store_, w * w);
      t.excess = side * ((t.stored2 - w * w) - 2 * w * (t.stored1 - w)) / (w * w);
      all.push_back(t);
    }
    const auto n = static_cast<std::ptrdiff_t>(std::min<std::size_t>(24, all.size()));
    std::partial_sort(all.begin(), all.begin() + n, all.end(),
                      [](const auto& a, const auto& b) { return a.excess > b.excess; });
    all.resize(static_cast<std::size_t>(n));
    return all;
  }

  /// The worst of a few receivers; exact light in enclosures, stored light of stored moments too.
  double judged(const warped_texel& a, const warped_texel& b) const {
    const number wa = positive_warp(number(a.depth), constants_);
    const number wb = positive_warp(number(b.depth), constants_), half(0.5);
    const double min_variance = q_.floor_deviation * q_.floor_deviation;
    const number m1 = (wa + wb) * half, m2 = (wa * wa + wb * wb) * half;
    const number s1 = (number(a.stored1) + number(b.stored1)) * half;
    const number s2 = (number(a.stored2) + number(b.stored2)) * half;
    double worst = 0;
    for (int k = -8; k <= 8; ++k) {
      const double t = b.depth + q_.floor_deviation * k / 10;
      if (t > 1) break;
      const number exact = evsm_positive_bound(m1, m2, number(t), constants_, min_variance);
      const number got = evsm_positive_bound(s1, s2, number(t), constants_, min_variance);
      const number apart = got - exact;
      worst = std::max(worst, std::fabs(apart.nearest()) - apart.radius());
    }
    return worst;
  }

  const stage_question& q_;
  const evsm_constants constants_;
  const moment_store store_;
  double deviation_ = 0;
};

}  // namespace

double worst_evsm_error(const stage_question& question, int significand_bits) {
  return pair_search(question, significand_bits).run();
}

}  // namespace bitshade::bit_search
