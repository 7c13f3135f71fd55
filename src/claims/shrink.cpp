#include "claims/shrink.hpp"

#include <algorithm>
#include <optional>
#include <tuple>

namespace bitshade::claims {
namespace {

bool simpler(const number& a, const number& b) {
  return std::make_tuple(a.below(), a.above()) < std::make_tuple(b.below(), b.above());
}

/// Every fraction in [0,1] with a denominator up to `most`; for the grid powers of two alone.
std::vector<number> small_fractions(int most, quantity what) {
  std::vector<number> all;
  for (int d = 1; d <= most; ++d) {
    if (what == quantity::grid && (d & (d - 1)) != 0) continue;
    for (int n = 0; n <= d; ++n) {
      const number x(n, d);
      if (x.below() == d) all.push_back(x);
    }
  }
  return all;
}

/// The fractions that a walk down the Stern-Brocot tree towards x passes, x left out.
void add_ancestors(const number& x, std::vector<number>& to) {
  number a = 0, b = 1, c = 1, d = 1;  // a/b <= x <= c/d
  for (int i = 0; i < 64 && b + d < x.below(); ++i) {
    const number middle = (a + c) / (b + d);
    to.push_back(middle);
    if (middle < x) {
      a = a + c, b = b + d;
    } else {
      c = a + c, d = b + d;
    }
  }
}

void add_grid_neighbours(const number& x, std::vector<number>& to) {
  for (number d = 2; d < x.below(); d += d) {
    const number n = (x * d).floor();
    to.push_back(n / d);
    to.push_back((n + 1) / d);
  }
}

/// All ways to make a case one step simpler, lazily: fewer numbers first, then simpler ones.
template <class Try>
bool any_step(const sample& s, Try accept) {
  for (std::size_t i = 0; i < s.names().size(); ++i) {
    const auto& list = s.at_index(i);
    for (std::size_t k = 0; list.size() > s.names()[i].least && k < list.size(); ++k) {
      sample next = s;
      next.at_index(i).erase(next.at_index(i).begin() + static_cast<std::ptrdiff_t>(k));
      if (accept(next)) return true;
    }
  }
  struct place {
    std::size_t list, index;
    std::vector<number> simpler;
  };
  std::vector<place> places;
  for (std::size_t i = 0; i < s.names().size(); ++i)
    for (std::size_t k = 0; k < s.at_index(i).size(); ++k)
      places.push_back({i, k, simpler_numbers(s.at_index(i)[k], s.names()[i].what)});
  for (const place& p : places)
    for (const number& x : p.simpler) {
      sample next = s;
      next.at_index(p.list)[p.index] = x;
      if (accept(next)) return true;
    }
  // Two numbers at once, one of them simpler, the other anything small: out of corners.
  for (const place& p : places)
    for (const place& q : places) {
      if (&p == &q) continue;
      const quantity other = s.names()[q.list].what;
      if (other == quantity::whole) continue;
      for (const number& y : small_fractions(4, other))
        for (std::size_t n = 0; n < std::min<std::size_t>(p.simpler.size(), 8); ++n) {
          sample next = s;
          next.at_index(p.list)[p.index] = p.simpler[n];
          next.at_index(q.list)[q.index] = y;
          if (accept(next)) return true;
        }
    }
  return false;
}

}  // namespace

bool operator<(const simplicity& a, const simplicity& b) {
  return std::tie(a.numbers, a.denominators, a.numerators) <
         std::tie(b.numbers, b.denominators, b.numerators);
}

simplicity simplicity_of(const sample& s) {
  simplicity result;
  for (std::size_t i = 0; i < s.names().size(); ++i)
    for (const number& x : s.at_index(i)) {
      ++result.numbers;
      result.denominators += x.below();
      result.numerators += x.above();
    }
  return result;
}

std::vector<number> simpler_numbers(const number& x, quantity what) {
  std::vector<number> all;
  if (what == quantity::whole) {
    for (int n = 1; number(n) < x; ++n) all.emplace_back(n);
    return all;
  }
  all = small_fractions(12, what);
  if (what == quantity::share) add_ancestors(x, all);
  if (what == quantity::grid) add_grid_neighbours(x, all);
  std::erase_if(all, [&](const number& y) { return !simpler(y, x); });
  std::stable_sort(all.begin(), all.end(), simpler);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

shrunk_sample shrink(sample from, const std::function<bool(const sample&)>& wanted, long budget) {
  shrunk_sample result{std::move(from)};
  while (result.tried < budget) {
    const simplicity now = simplicity_of(result.smallest);
    std::optional<sample> found;
    const bool any = any_step(result.smallest, [&](const sample& next) {
      if (result.tried >= budget) return true;  // out of the loops; `found` stays empty
      if (!(simplicity_of(next) < now)) return false;
      ++result.tried;
      if (!wanted(next)) return false;
      found = next;
      return true;
    });
    if (!any) {
      result.to_the_end = true;
      break;
    }
    if (!found) break;
    result.smallest = *std::move(found);
    ++result.steps;
  }
  return result;
}

}  // namespace bitshade::claims
