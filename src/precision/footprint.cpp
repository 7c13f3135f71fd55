#include "precision/footprint.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "bitshade/study/bounds.hpp"

namespace bitshade::bit_search {

namespace {

/// Candidates kept from one round of averaging to the next.
constexpr std::size_t kept = 48;

/// A texel, or several whose moments were averaged and stored again; in the store's units.
struct item {
  std::vector<double> depths;
  double stored1 = 0, stored2 = 0;
  double true1 = 0, true2 = 0;

  /// What the store adds to the variance, in units.
  double excess(double unit) const {
    return (stored2 - true2) - 2 * (true1 / unit) * (stored1 - true1);
  }
};

class search {
 public:
  search(const footprint_question& q, bool too_small)
      : q_(q), too_small_(too_small), unit_(unit_of(q.store)) {}

  worst_case run() const {
    const double e = moment_error(q_.store.step(), q_.roundings);
    const double noise = variance_error(e, 1.0).width();
    const double wanted = too_small_ ? q_.floor + noise : q_.floor;
    const double deviation = std::sqrt(wanted);
    // The receiver stands a fourth root of v v' behind the mean, and not behind the layer.
    const double beyond = std::sqrt(std::sqrt(q_.floor * (q_.floor + noise)));
    const double top = 1 - std::max(0.0, beyond - deviation);
    worst_case best;
    if (!(deviation > 0 && 2.1 * deviation < 1)) return best;
    // Wide enough for some dozens of codes, narrow enough to add no variance of its own.
    const auto window = [&](double least) { return std::max(least, 48 * q_.store.step()); };
    const auto far = candidates(top - window(deviation / 10), top);
    for (std::size_t i = 0; i < far.size() && i < 3; ++i) {
      const double b = far[i].true1 / unit_;
      // Of the true variance a share of up to 1/20 too much loses less than a share too little.
      const auto near = candidates(b - 2 * deviation - window(deviation / 20), b - 2 * deviation);
      for (const item& a : near) consider(a, far[i], best);
    }
    return best;
  }

 private:
  double depth_on_grid(double x) const { return std::nearbyint(x / q_.depth_grid) * q_.depth_grid; }
  double loss(const item& t) const { return too_small_ ? t.excess(unit_) : -t.excess(unit_); }

  void keep_worst(std::vector<item>& items) const {
    const std::size_t n = std::min(kept, items.size());
    std::partial_sort(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(n), items.end(),
                      [&](const item& a, const item& b) { return loss(a) < loss(b); });
    items.resize(n);
  }

  item texel(double x) const {
    item t;
    t.depths = {x};
    t.true1 = x * unit_;
    t.true2 = x * x * unit_;
    t.stored1 = stored_units(q_.store, x);
    t.stored2 = stored_units(q_.store, x * x);
    return t;
  }

  static double blend(double a, double b) { return (5 * a + 3 * b) / 8; }

  item averaged(const item& a, const item& b) const {
    item t;
    t.depths = a.depths;
    t.depths.insert(t.depths.end(), b.depths.begin(), b.depths.end());
    t.true1 = blend(a.true1, b.true1);
    t.true2 = blend(a.true2, b.true2);
    t.stored1 = again(blend(a.stored1, b.stored1));
    t.stored2 = again(blend(a.stored2, b.stored2));
    return t;
  }
  double again(double units) const {
    return q_.store.floating ? stored_units(q_.store, units) : std::nearbyint(units);
  }

  std::vector<item> candidates(double low, double high) const {
    std::vector<item> items;
    for (int i = 0; i < q_.tries; ++i) {
      const double x = depth_on_grid(low + (high - low) * (i + 0.5) / q_.tries);
      if (x >= 0 && x <= 1) items.push_back(texel(x));
    }
    keep_worst(items);
    for (int k = 1; k < q_.roundings; ++k) {
      std::vector<item> next;
      for (std::size_t i = 0; i < items.size(); ++i) {
        for (std::size_t j = 0; j < items.size(); ++j) next.push_back(averaged(items[i], items[j]));
      }
      keep_worst(next);
      items = std::move(next);
    }
    return items;
  }

  void consider(const item& a, const item& b, worst_case& best) const;

  const footprint_question& q_;
  const bool too_small_;
  const double unit_;
};

double chebyshev_at(double mean, double variance, double floor, double t) {
  const double d = t - mean, v = std::max(variance, floor);
  return d > 0 ? v / (v + d * d) : 1.0;
}

void search::consider(const item& a, const item& b, worst_case& best) const {
  const double s1 = (a.stored1 + b.stored1) / 2 / unit_, s2 = (a.stored2 + b.stored2) / 2 / unit_;
  const double m1 = (a.true1 + b.true1) / 2 / unit_, m2 = (a.true2 + b.true2) / 2 / unit_;
  const double vs = s2 - s1 * s1, v = m2 - m1 * m1;
  const double middle = std::sqrt(std::sqrt(std::max(v, q_.floor) * std::max(vs, q_.floor)));
  for (int k = -8; k <= 8; ++k) {
    const double t = depth_on_grid(m1 + middle * (1 + 0.04 * k));
    if (t > 1) break;
    const double error =
        std::fabs(chebyshev_at(s1, vs, q_.floor, t) - chebyshev_at(m1, v, q_.floor, t));
    if (error <= best.error.size()) continue;
    const footprint f{a.depths, b.depths, t};
    const footprint_error exact = judged(q_, f);
    if (exact.size() > best.error.size()) best = {f, exact};
  }
}

struct moments {
  rational first, second;
};

rational chebyshev_of(const moments& m, const rational& floor, const rational& t) {
  const rational d = t - m.first;
  rational v = m.second - m.first * m.first;
  if (v < floor) v = floor;
  return d > 0 ? rational(v / (v + d * d)) : rational(1);
}

/// The moments of one half: stored, blended pairwise and stored again until one is left.
moments half_of(const moment_store& store, const std::vector<double>& depths, bool rounds) {
  std::vector<moments> level;
  const auto keep = [&](const rational& x) { return rounds ? stored(store, x) : x; };
  for (const double depth : depths) {
    const rational x(depth);
    level.push_back({keep(x), keep(x * x)});
  }
  while (level.size() > 1) {
    std::vector<moments> next;
    for (std::size_t i = 0; i + 1 < level.size(); i += 2) {
      const moments &a = level[i], &b = level[i + 1];
      next.push_back(
          {keep((5 * a.first + 3 * b.first) / 8), keep((5 * a.second + 3 * b.second) / 8)});
    }
    level = std::move(next);
  }
  return level.front();
}

moments mean_of(const moments& a, const moments& b) {
  return {(a.first + b.first) / 2, (a.second + b.second) / 2};
}

}  // namespace

footprint_error judged(const footprint_question& q, const footprint& f) {
  const moments exact = mean_of(half_of(q.store, f.near, false), half_of(q.store, f.far, false));
  const moments got = mean_of(half_of(q.store, f.near, true), half_of(q.store, f.far, true));
  const rational t(f.receiver), floor(q.floor);
  footprint_error error;
  error.exact = static_cast<double>(chebyshev_of(exact, floor, t));
  error.stored = static_cast<double>(chebyshev_of(got, floor, t));
  error.mean = static_cast<double>(exact.first);
  error.variance = static_cast<double>(rational(exact.second - exact.first * exact.first));
  return error;
}

worst_case worst_footprint(const footprint_question& question) {
  worst_case worst = search(question, true).run();
  const worst_case other = search(question, false).run();
  return other.error.size() > worst.error.size() ? other : worst;
}

}  // namespace bitshade::bit_search
