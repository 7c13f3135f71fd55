// Bounds that must never be violated, over random footprints, in certified arithmetic.
#include <rapidcheck.h>

#include <cstdint>
#include <vector>

#include "bitshade/shadow/certified.hpp"
#include "bitshade/shadow/esm.hpp"
#include "bitshade/shadow/evsm.hpp"
#include "bitshade/shadow/msm.hpp"
#include "support/catch.hpp"

using namespace bitshade;

namespace {

using number = ball<4>;

struct footprint {
  std::vector<double> depth;   // multiples of 2^-12, so that ties happen
  std::vector<double> weight;  // multiples of 2^-16 that sum to 1
  double receiver = 0;

  template <class F>
  number mean(F f) const {
    number sum(0);
    for (std::size_t i = 0; i < depth.size(); ++i) sum += number(weight[i]) * f(number(depth[i]));
    return sum;
  }
  number lit() const {
    double share = 0;  // exact: multiples of 2^-16
    for (std::size_t i = 0; i < depth.size(); ++i) share += depth[i] >= receiver ? weight[i] : 0;
    return number(share);
  }
};

footprint any_footprint() {
  const auto count = *rc::gen::inRange<std::size_t>(1, 9);
  footprint f;
  double left = 0x1p16;
  for (std::size_t i = 0; i < count; ++i) {
    f.depth.push_back(*rc::gen::inRange(0, 4097) * 0x1p-12);
    const double part = i + 1 == count ? left : *rc::gen::inRange(0, static_cast<int>(left) + 1);
    f.weight.push_back(part * 0x1p-16);
    left -= part;
  }
  const bool on_one = *rc::gen::inRange(0, 3) == 0;
  f.receiver = on_one ? f.depth.front() : *rc::gen::inRange(0, 4097) * 0x1p-12;
  return f;
}

/// p >= lit as far as enclosures can tell; an undecided comparison is no violation.
void never_darker(const number& p, const footprint& f) { RC_ASSERT((p < f.lit()) != known::yes); }

}  // namespace

TEST_CASE("EVSM's bounds hold for every footprint and constant") {
  CHECK(rc::check([] {
    const footprint f = any_footprint();
    const evsm_constants k{*rc::gen::inRange(1, 900) / 10.0, *rc::gen::inRange(1, 900) / 10.0,
                           static_cast<double>(*rc::gen::inRange(0, 2))};
    const auto w = [&](const number& x) { return positive_warp(x, k); };
    const auto v = [&](const number& x) { return negative_warp(x, k); };
    const number t(f.receiver);
    const number positive =
        evsm_positive_bound(f.mean(w), f.mean([&](const number& x) { return w(x) * w(x); }), t, k,
                            *rc::gen::element(0.0, 1e-6, 1e-3));
    const number negative = evsm_negative_bound(
        f.mean(v), f.mean([&](const number& x) { return v(x) * v(x); }), t, k, 0.0);
    never_darker(positive, f);
    never_darker(negative, f);
    never_darker(evsm_bound(positive, negative), f);
  }));
}

TEST_CASE("ESM is Markov's bound for every footprint") {
  CHECK(rc::check([] {
    const footprint f = any_footprint();
    const esm_constants k{*rc::gen::inRange(1, 900) / 10.0, 0};
    never_darker(esm_visibility(f.mean([&](const number& x) { return esm_warp(x, k); }),
                                number(f.receiver), k),
                 f);
  }));
}

TEST_CASE(
    "four-moment bounds hold for every footprint, and biasing lowers them by its share at most") {
  CHECK(rc::check([] {
    const footprint f = any_footprint();
    const auto power = [&](int n) {
      return f.mean([&](const number& x) {
        const number y = centred_depth(x);
        number p(1);
        for (int i = 0; i < n; ++i) p *= y;
        return p;
      });
    };
    const four_moments<number> b{power(1), power(2), power(3), power(4)};
    const number y = centred_depth(number(f.receiver));
    never_darker(hamburger_bound(b, y), f);
    never_darker(hausdorff_bound(b, y), f);
    // Biased moments are those of a mixture, of which (1 - alpha) is the footprint.
    const double alpha = 0x1p-14;
    const number rest = number(1) - number(alpha);
    RC_ASSERT((hamburger_bound(biased(b, alpha), y) < rest * f.lit()) != known::yes);
    RC_ASSERT((hausdorff_bound(biased(b, alpha), y) < rest * f.lit()) != known::yes);
  }));
}
