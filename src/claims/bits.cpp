// C12 and C13: how many bits layers save, and whether 16 are enough.
#include <algorithm>
#include <cmath>

#include "claims/footprint.hpp"
#include "claims/laboratory.hpp"
#include "claims/table.hpp"
#include "io/text.hpp"
#include "precision/needed.hpp"

namespace bitshade::claims {
namespace {

/// Texels tried for each side of a footprint, whatever the run's effort: fewer would find fewer
/// bits.
constexpr int search_tries = 800;

/// The widest of N layers as the method makes them.
interval widest_layer(const method& m, int layers, double overlap) {
  interval widest{0, 0};
  for (const interval& layer : m.intervals(m.uniform_splits(layers), overlap))
    if (layer.far - layer.near > widest.far - widest.near) widest = layer;
  return widest;
}

/// sigma_min as the method's floor of the widest layer makes it.
double effective_deviation(const method& m, int layers, double overlap, double deviation) {
  const interval widest = widest_layer(m, layers, overlap);
  const auto floor = static_cast<double>(m.floor(deviation * deviation, widest));
  return std::sqrt(floor) * (widest.far - widest.near);
}

std::vector<bit_search::needed_bits> curve_of(const laboratory& lab, double overlap,
                                              int roundings) {
  std::vector<bit_search::needed_bits> curve;
  for (const int layers : {1, 2, 4, 8}) {
    precision_question q;
    q.floor_deviation = effective_deviation(lab.under_test(), layers, overlap, 0.01);
    q.roundings = roundings;
    curve.push_back(bit_search::bits_needed(q, layers, overlap, false, search_tries));
  }
  return curve;
}

// C12 ---------------------------------------------------------------------------------------------

bool falls(const std::vector<bit_search::needed_bits>& curve) {
  for (std::size_t i = 1; i < curve.size(); ++i)
    if (!(curve[i].found < curve[i - 1].found)) return false;
  return true;
}

/// How far from -2 the slope of a curve without overlap may be.
///
/// Every point lies between what adversaries reach at least (bit_search::reachable_bits less
/// missed_bits) and the whole bound: the steepest and the flattest line within that.
double slope_deviation(const std::vector<bit_search::needed_bits>& curve) {
  double middle = 0, most = 0;
  for (const auto& point : curve) middle += std::log2(point.layers);
  middle /= static_cast<double>(curve.size());
  for (const bool steep : {false, true}) {
    auto extreme = curve;
    for (auto& point : extreme) {
      const double least =
          bit_search::reachable_bits(point) - bit_search::missed_bits(point.question);
      const bool early = std::log2(point.layers) < middle;
      point.found = early == steep ? point.predicted : least;
    }
    const auto line = bit_search::line_through(extreme, &bit_search::needed_bits::found);
    most = std::max(most, std::fabs(line.slope + 2));
  }
  return most;
}

outcome measure_less(laboratory& lab) {
  outcome out;
  const double full = least_overlap(0, 0, 0.01, tolerated_error);
  struct setting {
    const char* name;
    double overlap;
    int roundings;
  };
  for (const auto& [name, overlap, roundings] :
       {setting{"no overlap, stored once", 0, 1}, setting{"no overlap, stored 4 times", 0, 4},
        setting{"overlap 0.01, stored once", 0.01, 1},
        setting{"full overlap 0.16, stored once", full, 1}}) {
    const auto curve = curve_of(lab, overlap, roundings);
    double beyond = 0;
    for (const auto& point : curve) {
      out.add(std::string(name) + ", N = " + std::to_string(point.layers), point.found, "bits");
      beyond = std::max(beyond, point.found - point.predicted);
    }
    out.limit(std::string(name) + ": bits found beyond those predicted", beyond, 0);
    const auto line = bit_search::line_through(curve, &bit_search::needed_bits::found);
    out.add(std::string(name) + ": bits for each doubling of N", line.slope, "bits");
    out.claim(std::string(name) + ": every doubling of N needs fewer bits", falls(curve));
    if (overlap == 0)
      out.limit(std::string(name) + ": distance of that slope from -2", std::fabs(line.slope + 2),
                slope_deviation(curve));
  }
  out.remarks.push_back(
      "Bits are those of a unorm, with fractions, below which a footprint was found that errs by "
      "more than 1/255 at sigma_min = 0.01. Without a floor there is no such number of bits: where "
      "the variance is 0 the error goes to 1 in any format.");
  return out;
}

// C13 ---------------------------------------------------------------------------------------------

/// The smallest number of layers up to 64 with which no footprint found errs by more than eps in
/// unorm16; 65 where none suffices.
int layers_needed(const laboratory& lab, double deviation, double eps, int roundings,
                  bool full_overlap) {
  const double overlap = full_overlap ? least_overlap(0, 0, deviation, eps) : 0;
  const method& m = lab.under_test();
  for (int layers = 1; layers <= 64; ++layers) {
    bit_search::footprint_question q;
    q.store = bit_search::moment_store::unorm(16);
    q.roundings = roundings;
    q.floor = static_cast<double>(
        m.floor(deviation * deviation, widest_layer(m, layers, std::min(0.5, overlap))));
    q.tries = search_tries;
    if (bit_search::worst_footprint(q).error.size() <= eps) return layers;
    if (layers >= 16) layers += 7;  // a coarser step: the answer is many
  }
  return 65;
}

outcome measure_enough(laboratory& lab) {
  outcome out;
  constexpr int few = 4;
  bool all = true, kinder = true, overlapped = true;
  for (const double deviation : {0.03, 0.01, 0.003})
    for (const double eps : {1.0 / 255, 1.0 / 32})
      for (const int roundings : {1, 4}) {
        const int needed = layers_needed(lab, deviation, eps, roundings, false);
        out.add("sigma_min " + brief(deviation, 1) + ", error 1/" +
                    std::to_string(static_cast<int>(1 / eps + 0.5)) + ", stored " +
                    std::to_string(roundings) + (roundings == 1 ? " time" : " times") +
                    ": smallest N",
                needed, needed > 64 ? "(none)" : "");
        all = all && needed <= few;
        if (deviation >= 0.01 && roundings == 1) kinder = kinder && needed <= few;
      }
  for (const double deviation : {0.03, 0.01, 0.003}) {
    const int needed = layers_needed(lab, deviation, tolerated_error, 1, true);
    out.add("sigma_min " + brief(deviation, 1) + ", error 1/255, full overlap: smallest N", needed,
            needed > 64 ? "(none)" : "");
    overlapped = overlapped && needed <= 64;
  }
  out.add("bits that full overlaps and an error of 1/255 need, whatever N",
          std::log2(1 + steps_needed_with_full_overlap(tolerated_error, 1)), "bits");
  out.claim("4 layers of unorm16 suffice for every floor, error and number of stores", all);
  out.claim("with full overlaps some N suffices", overlapped);
  out.condition =
      "sigma_min is at least 0.01 of the depth range, moments are rounded once and layers overlap "
      "by little";
  out.provided("4 layers suffice", kinder);
  out.remarks.push_back(
      "Full overlaps, of sigma_min sqrt(1/eps - 1), make every layer wider than twice themselves, "
      "so that 16 bits and an error of 1/255 cannot both be had.");
  return out;
}

}  // namespace

claim less_precision_claim() {
  return {"C12",
          "With more layers, each layer needs less numeric precision.",
          "[LauritzenMcCool08] section 4",
          "The fewest bits that keep the visibility's error within 1/255, found by search on "
          "adversarial footprints and judged in exact arithmetic, against N, the overlap and the "
          "number of roundings.",
          measure_less,
          {}};
}

claim sixteen_bits_claim() {
  return {"C13",
          "16-bit fixed point suffices even with few layers.",
          "[LauritzenMcCool08] section 4",
          "The smallest N with which no adversarial footprint errs by more than what is tolerated "
          "in unorm16, for several floors, tolerances and numbers of roundings.",
          measure_enough,
          {}};
}

}  // namespace bitshade::claims
