// C15: four moments against two, in formats.
#include <algorithm>
#include <cmath>

#include "bitshade/formats/round_to.hpp"
#include "bitshade/study/bounds_visibility.hpp"
#include "claims/footprint.hpp"
#include "claims/laboratory.hpp"
#include "claims/table.hpp"

namespace bitshade::claims {
namespace {

const shape footprints{{"x", quantity::share, 2, 6}, {"t"}};

four_moments<double> mean_of(const std::vector<double>& x, const encoding* format) {
  const msm_transform& basis = msm_optimised_transform;
  std::array<double, 4> sum{};
  for (const double depth : x) {
    const auto stored = to_basis(moments_of(depth), basis);
    for (std::size_t i = 0; i < 4; ++i)
      sum[i] += (format == nullptr ? stored[i] : round_to(*format, stored[i])) /
                static_cast<double>(x.size());
  }
  return from_basis(sum, basis);
}

/// Root mean square and 99th percentile of errors.
struct spread {
  std::vector<double> errors;

  double rms() const {
    double sum = 0;
    for (const double e : errors) sum += e * e;
    return std::sqrt(sum / static_cast<double>(errors.size()));
  }
  double percentile(double share) {
    std::sort(errors.begin(), errors.end());
    return errors[static_cast<std::size_t>(share * static_cast<double>(errors.size() - 1))];
  }
};

struct comparison {
  spread two, two_floored, four, four_biased;
  spread method_two, method_four, method_biased;  ///< exact moments against the share lit
};

comparison compare_in(const laboratory& lab, const encoding& format) {
  comparison c;
  const method& m = lab.under_test();
  const double step = largest_step(format);
  const double bias = msm_sufficient_bias(step, msm_optimised_transform);
  const double floor = variance_error(moment_error(step, 1), 1.0).width();
  for_cases(footprints, lab.stream(1501), lab.tries(3000), nullptr, [&](const sample& s) {
    const auto& x = s.list("x");
    const std::vector<double> depths = s.reals("x");
    const double t = s.real("t"), y = centred_depth(t);
    const auto exact_two = static_cast<double>(light(m, x, s["t"], whole_range, 0));
    const auto stored_two = [&](double v) {
      return static_cast<double>(stored_light(m, format, x, s["t"], whole_range, v));
    };
    const auto floored = static_cast<double>(light(m, x, s["t"], whole_range, floor));
    const auto exact = mean_of(depths, nullptr), stored = mean_of(depths, &format);
    const double four = m.four_moments(exact, y),
                 four_biased = m.four_moments(biased(exact, bias), y);
    const auto truth = static_cast<double>(share_lit(x, s["t"]));
    c.two.errors.push_back(std::fabs(stored_two(0) - exact_two));
    c.two_floored.errors.push_back(std::fabs(stored_two(floor) - floored));
    c.four.errors.push_back(std::fabs(m.four_moments(stored, y) - four));
    c.four_biased.errors.push_back(
        std::fabs(m.four_moments(biased(stored, bias), y) - four_biased));
    c.method_two.errors.push_back(exact_two - truth);
    c.method_four.errors.push_back(four - truth);
    c.method_biased.errors.push_back(four_biased - truth);
  });
  return c;
}

outcome measure(laboratory& lab) {
  outcome out;
  bool worse = true, tamed = true;
  for (const auto& [name, format] : storage_formats()) {
    comparison c = compare_in(lab, format);
    const std::string head = std::string(name) + ", ";
    out.add(head + "two moments: rms of the format error", c.two.rms());
    out.add(head + "two moments, floor D: rms", c.two_floored.rms());
    out.add(head + "four moments, no bias: rms", c.four.rms());
    out.add(head + "four moments, sufficient bias: rms", c.four_biased.rms());
    const double ratio = c.four.rms() / c.two.rms();
    out.add(head + "four over two moments, neither stabilised", ratio);
    worse = worse && ratio > 2;
    tamed = tamed && c.four_biased.rms() < c.four.rms();
    if (name == storage_formats().front().name) {
      out.add("method error, two moments: rms", c.method_two.rms());
      out.add("method error, four moments: rms", c.method_four.rms());
      out.add("method error, four moments biased for unorm16: rms", c.method_biased.rms());
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
          "format, against themselves with moments in binary64; without and with bias and floor.",
          measure,
          nullptr};
}

}  // namespace bitshade::claims
