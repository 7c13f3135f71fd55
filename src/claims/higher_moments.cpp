// C15: four moments against two, in formats.
#include <array>
#include <cmath>

#include "bitshade/formats/round_to.hpp"
#include "bitshade/study/bounds_visibility.hpp"
#include "claims/footprint.hpp"
#include "claims/laboratory.hpp"
#include "claims/table.hpp"

namespace bitshade::claims {
namespace {

/// Four texels, so that their mean loses no bit.
const shape footprints{{"x", quantity::share, 4, 4}, {"t"}};

/// The four moments that a filter brings back from texels: as they are, or stored in a format.
///
/// A basis changes nothing as long as nothing is rounded; stored texels use the optimised one.
four_moments<enclosed> filtered(const std::vector<double>& x, const encoding* format) {
  const msm_transform& basis = msm_optimised_transform;
  std::array<enclosed, 4> sum{};
  for (const double depth : x) {
    const auto m = moments_of(enclosed(depth));
    if (format == nullptr) {
      const std::array<enclosed, 4> plain{m.b1, m.b2, m.b3, m.b4};
      for (std::size_t i = 0; i < 4; ++i) sum[i] += plain[i];
    } else {
      const auto stored = to_basis(m, basis);
      for (std::size_t i = 0; i < 4; ++i)
        sum[i] += enclosed(round_to(*format, stored[i].nearest()));
    }
  }
  for (enclosed& s : sum) s = s * enclosed(1.0 / static_cast<double>(x.size()));
  return format == nullptr ? four_moments<enclosed>{sum[0], sum[1], sum[2], sum[3]}
                           : from_basis(sum, basis);
}

double rms(const std::vector<double>& errors) {
  double sum = 0;
  for (const double e : errors) sum += e * e;
  return errors.empty() ? 0 : std::sqrt(sum / static_cast<double>(errors.size()));
}

struct comparison {
  std::vector<double> two, two_floored, four, four_biased;
  std::vector<double> method_two, method_four, method_biased;  ///< against the share lit
  long undecided = 0;  ///< cases whose enclosures are wider than 2^-40: left out
};

/// An enclosure narrow enough to be taken for its middle.
bool certain(const enclosed& p) { return p.radius() <= 0x1p-40; }

comparison compare_in(const laboratory& lab, const encoding& format) {
  comparison c;
  const method& m = lab.under_test();
  const double step = largest_step(format);
  const double bias = msm_sufficient_bias(step, msm_optimised_transform);
  const double floor = variance_error(moment_error(step, 1), 1.0).width();
  for_cases(footprints, lab.stream(1501), lab.tries(3000), nullptr, [&](const sample& s) {
    // Data are binary32 depths; from there on nothing is rounded but what the format stores.
    std::vector<double> depths;
    std::vector<number> x;
    for (const double depth : s.reals("x")) {
      depths.push_back(static_cast<float>(depth));
      x.emplace_back(depths.back());
    }
    const number t(static_cast<float>(s.real("t")));
    const enclosed y = centred_depth(enclosed(static_cast<double>(t)));
    const auto exact = filtered(depths, nullptr), stored = filtered(depths, &format);
    const enclosed four = m.four_moments(exact, y), four_stored = m.four_moments(stored, y);
    const enclosed tamed = m.four_moments(biased(exact, bias), y),
                   tamed_stored = m.four_moments(biased(stored, bias), y);
    if (!certain(four) || !certain(four_stored) || !certain(tamed) || !certain(tamed_stored))
      return ++c.undecided, void();
    const auto apart = [](const enclosed& a, const enclosed& b) {
      return std::fabs((a - b).nearest());
    };
    const auto two = [&](double v) { return light(m, x, t, whole_range, v); };
    const auto two_error = [&](double v) {
      return static_cast<double>(abs(stored_light(m, format, x, t, whole_range, v) - two(v)));
    };
    const auto truth = static_cast<double>(share_lit(x, t));
    c.two.push_back(two_error(0));
    c.two_floored.push_back(two_error(floor));
    c.four.push_back(apart(four_stored, four));
    c.four_biased.push_back(apart(tamed_stored, tamed));
    c.method_two.push_back(static_cast<double>(two(0)) - truth);
    c.method_four.push_back(four.nearest() - truth);
    c.method_biased.push_back(tamed.nearest() - truth);
  });
  return c;
}

outcome measure(laboratory& lab) {
  outcome out;
  bool worse = true, tamed = true;
  for (const auto& [name, format] : storage_formats()) {
    comparison c = compare_in(lab, format);
    const std::string head = std::string(name) + ", ";
    out.add(head + "two moments: rms of the format error", rms(c.two));
    out.add(head + "two moments, floor D: rms", rms(c.two_floored));
    out.add(head + "four moments, no bias: rms", rms(c.four));
    out.add(head + "four moments, sufficient bias: rms", rms(c.four_biased));
    out.add(head + "cases that enclosures left undecided", static_cast<double>(c.undecided));
    const double ratio = rms(c.four) / rms(c.two);
    out.add(head + "four over two moments, neither stabilised", ratio);
    worse = worse && ratio > 2;
    tamed = tamed && rms(c.four_biased) < rms(c.four);
    if (name == storage_formats().front().name) {
      out.add("method error, two moments: rms", rms(c.method_two));
      out.add("method error, four moments: rms", rms(c.method_four));
      out.add("method error, four moments biased for unorm16: rms", rms(c.method_biased));
    }
  }
  out.claim("in every format four moments err more than twice as much as two", worse);
  out.claim("a bias lowers that error in every format: it is the inversion that is unstable",
            tamed);
  out.remarks.push_back(
      "The bias that makes four moments stable in a format costs part of what they gain in method "
      "error: figures above.");
  return out;
}

}  // namespace

claim higher_moments_claim() {
  return {"C15",
          "Higher moments are numerically unstable.",
          "[LauritzenMcCool08] section 2",
          "Four-moment and two-moment bounds of the same random footprints, moments stored in each "
          "format, against themselves with exact moments, in rationals and certified enclosures; "
          "without and with bias and floor.",
          measure,
          {}};
}

}  // namespace bitshade::claims
