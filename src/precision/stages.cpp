#include "precision/stages.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "bitshade/interop/rational.hpp"
#include "bitshade/shadow/layers.hpp"
#include "bitshade/study/precision.hpp"
#include "bitshade/study/precision_stages.hpp"
#include "run/shading_arithmetic.hpp"

namespace bitshade::bit_search {

namespace {

constexpr int widest_fraction = 40, widest_significand = 24, widest_evsm = 40;

double floor_of(const stage_question& q) {
  precision_question p;
  p.floor_deviation = q.floor_deviation;
  p.width = uniform_layer_width(q.layers, q.overlap);
  return layer_floor_variance(p);
}

/// Two depths, the near one with a share alpha, before a receiver: in exact arithmetic.
rational light_behind(const rational& alpha, const rational& range, const rational& far,
                      const rational& floor, const rational& t) {
  const rational d = t - (far - alpha * range);
  rational v = alpha * (1 - alpha) * range * range;
  if (v < floor) v = floor;
  return d > 0 ? rational(v / (v + d * d)) : rational(1);
}

/// Bits downwards from the prediction until a search breaks eps.
template <class Worst>
stage_bits searched(stage_bits answer, double eps, int most, Worst worst) {
  answer.found = answer.predicted == 0 ? most : answer.predicted;
  while (answer.found > 1) {
    const double error = worst(answer.found - 1);
    if (error > eps) {
      answer.witness_error = error;
      return answer;
    }
    --answer.found;
  }
  return answer;
}

stage_bits answer_of(const stage_question& q, const char* technique, const char* stage,
                     const char* unit) {
  stage_bits a;
  a.technique = technique;
  a.stage = stage;
  a.unit = unit;
  a.layers = q.layers;
  a.floor_deviation = q.floor_deviation;
  return a;
}

const char* variance_name(const stage_question& q) { return q.layers == 1 ? "vsm" : "lvsm"; }

interval farthest_layer(const stage_question& q) {
  const double near = q.layers == 1 ? 0 : 1.0 / q.layers * (q.layers - 1) - q.overlap;
  return {on_split_grid(std::max(0.0, near)), 1};
}

}  // namespace

double worst_weight_error(int fraction_bits, double floor) {
  const double step = moved_share(fraction_bits);
  const double omega = step;
  double worst = 0;
  for (const double target : {floor, floor + omega}) {
    // A receiver behind the mean by the deviation fits into the layer.
    const double far = 1 - std::sqrt(target);
    const double alpha = target / (far * far);
    for (int k = -1; k <= 1; ++k) {
      const double code = std::floor(alpha / 2 / step) + k;
      for (const double past : {-0x1p-12, 0x1p-12}) {
        const double fraction = (code + 0.5 + past) * step;
        if (fraction < 0 || fraction > 1) continue;
        const rational exact(fraction), moved(std::nearbyint(fraction / step) * step);
        const auto share = [](const rational& f) { return rational(1 - (1 - f) * (1 - f)); };
        const rational a = share(exact), b = share(moved);
        for (int i = -6; i <= 6; ++i) {
          const double d = std::sqrt(target) * (1 + i / 16.0);
          const rational t(std::min(1.0, far - static_cast<double>(a) * far + d));
          const rational range(far);
          const rational error = light_behind(a, range, range, rational(floor), t) -
                                 light_behind(b, range, range, rational(floor), t);
          worst = std::max(worst, std::fabs(static_cast<double>(error)));
        }
      }
    }
  }
  return worst;
}

double worst_shading_error(const stage_question& q, int significand_bits) {
  const auto shade = shading_in(binary_encoding(8, significand_bits - 1));
  shading_input in;
  in.layer = farthest_layer(q);
  in.min_variance = q.floor_deviation * q.floor_deviation;
  const double width = in.layer.far - in.layer.near, s = q.floor_deviation / width;
  const auto exact = [&](const shading_input& x) {
    const rational near(x.layer.near), wide = rational(x.layer.far) - near;
    const rational t = (rational(x.t) - near) / wide, m1(x.first), d = t - m1;
    rational v = rational(x.second) - m1 * m1;
    const rational floor = rational(x.min_variance) / (wide * wide);
    if (v < floor) v = floor;
    return static_cast<double>(d > 0 ? rational(v / (v + d * d)) : rational(1));
  };
  // Around mean 1 - s, variance floor, a receiver one deviation behind: then closer and closer.
  std::mt19937_64 random(q.seed);
  const auto unit = [&] { return static_cast<double>(random() >> 24) * 0x1p-39 - 1; };
  struct place {
    double mean, share, behind;
  };
  place centre{1 - 1.2 * s, 1.1, 1}, best = centre;
  double worst = 0, reach = 1;
  const int phase = std::max(1, q.tries / 4);
  for (int i = 0; i < q.tries; ++i) {
    if (i > 0 && i % phase == 0) centre = best, reach /= 8;
    const place at{centre.mean + 0.2 * s * reach * unit(), centre.share + 0.1 * reach * unit(),
                   centre.behind + 0.2 * reach * unit()};
    if (at.mean < 0 || at.mean > 1 || at.mean + at.behind * s > 1) continue;
    in.first = at.mean;
    in.second = at.mean * at.mean + at.share * s * s;
    in.t = in.layer.near + (at.mean + at.behind * s) * width;
    const double error = std::fabs(shade(in) - exact(in));
    if (error > worst) worst = error, best = at;
  }
  return worst;
}

stage_bits weight_bits(const stage_question& q) {
  stage_bits a = answer_of(q, variance_name(q), "weights", "fraction");
  const double floor = floor_of(q);
  a.predicted = fewest_bits(q.tolerated, widest_fraction,
                            [&](int bits) { return weight_error_at(moved_share(bits), 1, floor); });
  return searched(a, q.tolerated, widest_fraction,
                  [&](int bits) { return worst_weight_error(bits, floor); });
}

stage_bits shading_bits(const stage_question& q) {
  stage_bits a = answer_of(q, variance_name(q), "shading", "significand");
  const interval layer = farthest_layer(q);
  const double width = layer.far - layer.near, s = q.floor_deviation / width;
  a.predicted = fewest_bits(q.tolerated, 53, [&](int bits) {
    return shading_error_at(unit_roundoff(bits), width, s * s);
  });
  a.found = 53;
  const int from =
      std::min(a.predicted == 0 ? widest_significand : a.predicted, widest_significand);
  stage_bits search = a;
  search.predicted = from;
  search = searched(search, q.tolerated, widest_significand,
                    [&](int bits) { return worst_shading_error(q, bits); });
  a.found = search.found;
  a.witness_error = search.witness_error;
  return a;
}

stage_bits evsm_bits(const stage_question& q) {
  stage_bits a = answer_of(q, "evsm2", "store", "significand");
  a.predicted = fewest_bits(q.tolerated, widest_evsm, [&](int bits) {
    return evsm_error_at(unit_roundoff(bits), 1, q.exponent, q.floor_deviation);
  });
  return searched(a, q.tolerated, widest_evsm, [&](int bits) { return worst_evsm_error(q, bits); });
}

}  // namespace bitshade::bit_search
