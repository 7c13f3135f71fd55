#include "precision/needed.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "io/text.hpp"

namespace bitshade::bit_search {

namespace {

/// The error's bound falls as the steps grow: where it is eps.
double predicted_steps(const precision_question& q) {
  double low = 1, high = 0x1p52;
  for (int i = 0; i < 200 && high / low > 1 + 0x1p-40; ++i) {
    const double middle = std::sqrt(low * high);
    (error_at(q, middle) <= q.tolerated ? high : low) = middle;
  }
  return high;
}

worst_case worst_at(const precision_question& q, const moment_store& store, int tries) {
  footprint_question f;
  f.store = store;
  f.roundings = q.roundings;
  f.floor = layer_floor_variance(q);
  f.tries = tries;
  return worst_footprint(f);
}

/// The most steps at which a footprint breaks eps, to within a thousandth: near `predicted`, since
/// adversaries reach nearly all of the bound. Of coarse grids some happen to have no code in a bad
/// place, so that each probe looks at a few neighbouring ones.
double breaking_steps(const precision_question& q, bool floating, double predicted, int tries) {
  if (floating) return 0;  // significands have whole bits
  const auto breaks = [&](double steps) {
    for (int n = 0; n < 4; ++n) {
      const moment_store store{false, static_cast<std::int64_t>(steps) - n};
      if (worst_at(q, store, tries).error.size() > q.tolerated) return true;
    }
    return false;
  };
  double high = predicted, low = predicted;
  do low /= 1.5;
  while (low > 3 && !breaks(low));
  if (low <= 3) return 0;
  while (high / low > 1.001 && high - low > 1) {
    const double middle = std::sqrt(low * high);
    (breaks(middle) ? low : high) = middle;
  }
  return low;
}

void check(const precision_question& q, int layers) {
  if (!(q.tolerated > 0 && q.tolerated < 1)) {
    throw std::invalid_argument("the tolerated error " + shortest(q.tolerated) +
                                " is not between 0 and 1");
  }
  if (!(layer_floor_variance(q) > 0 && layer_floor_variance(q) < 0.05)) {
    throw std::invalid_argument(
        "a floor of " + shortest(q.floor_deviation) + " in depth fills " + std::to_string(layers) +
        " layers of width " + brief(q.width) +
        ": no footprint can vary more than its floor there; ask for fewer layers or a lower floor");
  }
}

}  // namespace

needed_bits bits_needed(precision_question question, int layers, double overlap, bool floating,
                        int tries) {
  question.width = uniform_layer_width(layers, overlap);
  check(question, layers);
  needed_bits r;
  r.question = question;
  r.floating = floating;
  r.layers = layers;
  r.overlap = overlap;
  const double one = floating ? 0 : 1;
  const double steps = predicted_steps(question);
  r.predicted = std::log2(steps + one);
  r.variance_share = std::log2(steps_needed(question) + one);
  r.predicted_whole = floating ? significand_bits_needed(question) : unorm_bits_needed(question);
  r.found_whole = r.predicted_whole;
  while (r.found_whole > 1) {
    const int fewer = r.found_whole - 1;
    const auto store = floating ? moment_store::significand(fewer) : moment_store::unorm(fewer);
    const worst_case worst = worst_at(question, store, tries);
    if (worst.error.size() > question.tolerated) {
      r.witness = worst;
      break;
    }
    r.found_whole = fewer;
  }
  r.found =
      floating ? r.found_whole : std::log2(breaking_steps(question, floating, steps, tries) + one);
  return r;
}

double missed_bits(const precision_question& question) {
  return -std::log2(question.roundings == 1 ? reached_once : reached_repeatedly);
}

double reachable_bits(const needed_bits& p) {
  precision_question q = p.question;
  q.mean = 1 - std::sqrt(layer_floor_variance(q));
  return std::log2(steps_needed(q) + (p.floating ? 0 : 1));
}

fitted_line line_through(std::span<const needed_bits> curve, double needed_bits::*what) {
  fitted_line line;
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const auto n = static_cast<double>(curve.size());
  for (const needed_bits& p : curve) {
    const double x = std::log2(static_cast<double>(p.layers)), y = p.*what;
    sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  const double spread = n * sxx - sx * sx;
  line.slope = spread > 0 ? (n * sxy - sx * sy) / spread : 0;
  line.at_one = n > 0 ? (sy - line.slope * sx) / n : 0;
  for (const needed_bits& p : curve) {
    const double at = line.at_one + line.slope * std::log2(static_cast<double>(p.layers));
    line.largest_residual = std::max(line.largest_residual, std::fabs(p.*what - at));
  }
  return line;
}

std::vector<std::string> deviations(std::span<const needed_bits> curve) {
  std::vector<std::string> said;
  if (curve.size() < 2) return said;
  const needed_bits &first = curve.front(), &last = curve.back();
  const double octaves = std::log2(static_cast<double>(last.layers) / first.layers);
  const double expected = -2 * octaves, seen = last.found - first.found;
  const auto n = [](double v) { return brief(v, 3); };
  said.push_back("From " + std::to_string(first.layers) + " to " + std::to_string(last.layers) +
                 " layers 2 log2 N saves " + n(-expected) + " bits; the footprints found need " +
                 n(-seen) + " fewer, " + n(std::fabs(seen - expected)) +
                 (seen > expected ? " less is saved." : " more is saved."));
  const double overlap = 2 * std::log2(last.question.width * last.layers) -
                         2 * std::log2(first.question.width * first.layers);
  if (overlap > 0.005) {
    said.push_back("The overlap widens the layers and gives " + n(overlap) +
                   " bits back: delta N = " + n(last.overlap * last.layers) + ".");
  }
  const auto mean_share = [](const needed_bits& p) { return p.predicted - p.variance_share; };
  const double share = mean_share(last) - mean_share(first);
  said.push_back(
      "The bound's share for a wrong mean grows with the floor in layer units: it asks for " +
      n(mean_share(first)) + " bits at first and " + n(mean_share(last)) + " at last (" + n(share) +
      " more), which no footprint found needs.");
  // A receiver one deviation behind the mean keeps the mean away from 1, where D is largest.
  const auto mean_of = [](const needed_bits& p) {
    return 1 - std::sqrt(layer_floor_variance(p.question));
  };
  const auto lost = [](const needed_bits& p) { return p.variance_share - reachable_bits(p); };
  said.push_back(
      "The receiver has to fit behind the mean, so that no mean comes nearer to 1 than " +
      n(mean_of(first)) + " at first and " + n(mean_of(last)) + " at last: that alone saves " +
      n(lost(last) - lost(first)) + " bits.");
  const auto missed = [](const needed_bits& p) { return reachable_bits(p) - p.found; };
  said.push_back(
      "Of what is left the search misses " + n(missed(first)) + " bits at first and " +
      n(missed(last)) + " at last: coarser grids offer fewer bad codes. Footprints reach " +
      n(100 * std::exp2(-missed_bits(last.question))) + " % of the variance's bound at least, " +
      n(missed_bits(last.question)) + " bits.");
  return said;
}

}  // namespace bitshade::bit_search
