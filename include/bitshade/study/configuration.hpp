// One cell of a study: a technique in a format, with everything that decides its bits.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "bitshade/study/choices.hpp"
#include "bitshade/study/filtering.hpp"
#include "bitshade/study/lloyd_choices.hpp"

namespace bitshade {

/// A technique, a format and their parameters; the defaults are an engine's usual choices.
///
/// Units    depths in [0,1]; min_variance in depth^2; overlap in depth; blur_sigma in texels.
struct configuration {
  technique method = technique::vsm;
  /// A name that parse_encoding knows, or "exact": no rounding anywhere.
  std::string format = "unorm16";

  int layers = 1;  ///< layers of an LVSM; other techniques have one
  split_rule splits = split_rule::uniform;
  std::vector<double> manual_splits;  ///< the layers-1 interior splits, for split_rule::manual
  double overlap = 0.01;              ///< delta of equation (8); engines: a few percent
  bool transition = false;            ///< blend two layers across their overlap
  layer_lookup lookup = layer_lookup::own;
  bool direct_index = false;  ///< uniform layers by ceil(t N) - 1 instead of by search
  double min_width = 0;       ///< splits closer than this are merged; 0: one step of the grid
  layer_warp warping = layer_warp::clamped;  ///< of depths beyond a layer's ends
  bool one_pass = false;      ///< all layers from one reading of the depths, packed in pairs
  lloyd_choices lloyd;        ///< for the rules that start with Lloyd relaxation

  int blur_taps = 9;  ///< along each axis; odd, 1 to 25; 0 and 1: none
  double blur_sigma = 2.0;
  filtering filtered;          ///< samples, shape and way of the blur, lookups
  double min_variance = 1e-5;  ///< sigma_min^2; the range 1e-6 .. 1e-4 is common
  bool noise_floor = false;    ///< never a floor under what the format's noise needs for 1/255
  bool slope_term = false;     ///< the receiver-slope term (12), limited at silhouettes
  int smallest_box = 9;        ///< least width of a SAT-VSM's rectangles, in texels
  double depth_bias = 0;       ///< a depth less than this before the receiver leaves it lit (hard, pcf, deep)
  second_moment second = second_moment::square;
  texel_filter filter = texel_filter::bilinear;
  int max_anisotropy = 1;  ///< 1: isotropic; up to 16

  double bleeding_reduction = 0;  ///< alpha of (11), 0 <= alpha < 1
  double bleeding_power = 1;      ///< the second form, p^power + lift; 1 and 0 are none
  double bleeding_lift = 0;
  double exponent = 5;            ///< c of ESM and EVSM; capped by the format
  double negative_exponent = 5;   ///< the second constant of EVSM with four components
  int terms = 4;                  ///< M of CSM
  double moment_bias = 6e-5;      ///< of the four-moment technique
  bool optimised_basis = true;    ///< quantisation basis of the four-moment technique
  moment_bound bound = moment_bound::hamburger;

  bool exact() const { return format == "exact"; }
  bool blurred() const { return blur_taps > 1; }
  bool powered() const { return bleeding_power != 1 || bleeding_lift != 0; }
  /// Components a texel stores in one layer: 1 (depth), 2 or 4 moments, 2M Fourier terms.
  int channels() const;
  /// A text that is equal for two configurations exactly when their runs are: the database's key.
  std::string key() const;
  /// Throws std::invalid_argument with one sentence where the fields contradict each other.
  void validate() const;
};

inline bool uses_floor(technique t) {
  return t == technique::vsm || t == technique::savsm || t == technique::lvsm ||
         t == technique::evsm2 || t == technique::evsm4;
}

/// Whether a technique stores depths warped by an exponential.
inline bool warps_exponentially(technique t) {
  return t == technique::esm || t == technique::evsm2 || t == technique::evsm4;
}

/// Whether a technique gives the share of the footprint that is lit, not a bound: nothing bleeds.
inline bool compares_depths(technique t) {
  return t == technique::hard || t == technique::pcf || t == technique::deep;
}

/// Whether a rule starts with Lloyd relaxation.
inline bool relaxes(split_rule rule) {
  return rule == split_rule::lloyd || rule == split_rule::lloyd_view ||
         rule == split_rule::receivers;
}

inline bool stores_variance(technique t) {
  return t == technique::vsm || t == technique::savsm || t == technique::lvsm;
}

/// Whether a texel may be resolved from samples: a hard test and a deep map read its centre.
inline bool takes_samples(technique t) { return t != technique::hard && t != technique::deep; }

/// Whether several lookups make one light: of those, a SAT has its own rectangle.
inline bool averages_lookups(technique t) { return takes_samples(t) && t != technique::savsm; }

/// Whether what the technique stores is filtered as it is, by blurs, mips and probes; a PCF filters
/// answers, a SAT sums.
inline bool blurs_its_map(technique t) {
  return takes_samples(t) && t != technique::pcf && t != technique::savsm;
}

/// Whether the technique's footprint is made by the kernel of the blur.
inline bool has_kernel(technique t) { return t != technique::hard && t != technique::savsm; }

inline int configuration::channels() const {
  switch (method) {
    case technique::hard:
    case technique::pcf:
    case technique::esm:
    case technique::deep:  // as many nodes as its footprint has depths: the run counts them
      return 1;
    case technique::vsm:
    case technique::savsm:
    case technique::lvsm:
    case technique::evsm2:
      return 2;
    case technique::evsm4:
    case technique::msm:
      return 4;
    case technique::csm:
      return 2 * terms;
  }
  return 0;
}

inline std::string configuration::key() const {
  std::string text(name_of(method));
  const auto add = [&](std::string_view name, const std::string& value) {
    text.append(" ").append(name).append("=").append(value);
  };
  add("format", format);
  if (method == technique::lvsm) {
    add("layers", std::to_string(layers));
    if (one_pass) add("generation", "one-pass");
    if (layers > 1) {
      if (splits == split_rule::manual) {
        std::string list;
        for (const double s : manual_splits) {
          list.append(list.empty() ? "" : ",").append(detail::shortest(s));
        }
        add("splits", list);
      } else {
        add("splits", std::string(split_rule_names[static_cast<std::size_t>(splits)]));
      }
      add("overlap", detail::shortest(overlap));
      if (transition) add("transition", "on");
      if (lookup != layer_lookup::own) {
        add("lookup", std::string(layer_lookup_names[static_cast<std::size_t>(lookup)]));
      }
      if (direct_index && splits == split_rule::uniform) add("direct-index", "on");
      if (min_width > 0 && splits != split_rule::uniform) {
        add("min-width", detail::shortest(min_width));
      }
      if (relaxes(splits) && !lloyd.key().empty()) add("lloyd", lloyd.key());
      if (splits == split_rule::optimal && lloyd.weights != weight_limits{}) {
        add("lloyd", "weights:" + detail::shortest(lloyd.weights.low) + ".." +
                         detail::shortest(lloyd.weights.high));
      }
      if (warping != layer_warp::clamped) add("layer-warp", "unclamped");
    }
  }
  if (filtered.msaa > 1 && takes_samples(method)) add("msaa", std::to_string(filtered.msaa));
  if (blurred() && has_kernel(method)) {
    const bool box = filtered.shape == blur_shape::box;
    add("blur", std::to_string(blur_taps) + "/" + (box ? "box" : detail::shortest(blur_sigma)));
    if (blurs_its_map(method) && filtered.way == blur_way::one_pass) add("blur-way", "one-pass");
    if (blurs_its_map(method) && filtered.way == blur_way::linear) {
      add("blur-way", "linear/" + std::to_string(filtered.fraction_bits));
    }
  }
  if (filtered.lookups > 1 && averages_lookups(method)) {
    add("lookups", std::to_string(filtered.lookups));
  }
  if (uses_floor(method)) {
    add("min-variance", detail::shortest(min_variance));
    if (noise_floor && !exact()) add("noise-floor", "on");
    if (slope_term) add("slope-term", "on");
  }
  if (stores_variance(method)) {
    if (second != second_moment::square) {
      add("second-moment", std::string(second_moment_names[static_cast<std::size_t>(second)]));
    }
  }
  if (blurs_its_map(method)) {
    add("filter", std::string(filter_names[static_cast<std::size_t>(filter)]));
    if (max_anisotropy > 1) add("anisotropy", std::to_string(max_anisotropy));
  } else if (has_kernel(method) && filter == texel_filter::nearest) {
    add("filter", "nearest");
  }
  if (method == technique::savsm) add("smallest-box", std::to_string(smallest_box));
  if (compares_depths(method) && depth_bias != 0) add("depth-bias", detail::shortest(depth_bias));
  if (warps_exponentially(method)) {
    add("exponent", detail::shortest(exponent));
  }
  if (method == technique::evsm4) add("negative-exponent", detail::shortest(negative_exponent));
  if (method == technique::csm) add("terms", std::to_string(terms));
  if (method == technique::msm) {
    add("moment-bias", detail::shortest(moment_bias));
    if (!optimised_basis) add("basis", "dense");
    if (bound != moment_bound::hamburger) add("bound", "hausdorff");
  }
  if (bleeding_reduction != 0 && !compares_depths(method)) {
    add("bleeding-reduction", detail::shortest(bleeding_reduction));
  }
  if (powered() && !compares_depths(method)) {
    add("bleeding-power", detail::shortest(bleeding_power));
    add("bleeding-lift", detail::shortest(bleeding_lift));
  }
  return text;
}

inline void configuration::validate() const {
  const auto refuse = [](const std::string& why) { throw std::invalid_argument(why); };
  if (format.empty()) refuse("the format is empty: name one, such as unorm16");
  if (layers < 1 || layers > 256) {
    refuse("layers = " + std::to_string(layers) + " is outside 1 to 256");
  }
  if (splits == split_rule::manual) {
    if (manual_splits.size() + 1 != static_cast<std::size_t>(layers)) {
      refuse(std::to_string(manual_splits.size()) + " splits make " +
             std::to_string(manual_splits.size() + 1) + " layers, not " + std::to_string(layers) +
             ": leave out --layers or give one split fewer than layers");
    }
    double before = 0;
    for (const double s : manual_splits) {
      if (!(s > before && s < 1)) {
        refuse("the split " + detail::shortest(s) +
               " is not between 0 and 1 and above the split before it: list them in rising order");
      }
      before = s;
    }
  }
  if (!(overlap >= 0 && overlap <= 0.5)) {
    refuse("overlap = " + detail::shortest(overlap) + " is outside 0 to 0.5");
  }
  if (!(min_width >= 0 && min_width <= 0.5)) {
    refuse("min-width = " + detail::shortest(min_width) + " is outside 0 to 0.5");
  }
  if (direct_index && method == technique::lvsm && layers > 1 && splits != split_rule::uniform) {
    refuse("a layer's index is computed directly from uniform splits alone: search the others");
  }
  lloyd.validate();
  if (blur_taps < 0 || blur_taps > 25 || (blur_taps != 0 && blur_taps % 2 == 0)) {
    refuse("blur = " + std::to_string(blur_taps) + " taps: give 0 or an odd number up to 25");
  }
  if (!(blur_sigma > 0 && blur_sigma <= 64)) {
    refuse("blur sigma = " + detail::shortest(blur_sigma) + " is outside 0 to 64 texels");
  }
  filtered.validate();
  // Exact kernels hold floors of 1e-60 and more as integers of known width.
  if (!(min_variance == 0 || (min_variance >= 1e-60 && min_variance <= 1))) {
    refuse("min-variance = " + detail::shortest(min_variance) +
           " is neither 0 nor between 1e-60 and 1");
  }
  if (max_anisotropy < 1 || max_anisotropy > 16) {
    refuse("anisotropy = " + std::to_string(max_anisotropy) + " is outside 1 to 16");
  }
  if (!(bleeding_reduction >= 0 && bleeding_reduction < 1)) {
    refuse("bleeding reduction = " + detail::shortest(bleeding_reduction) +
           " is outside [0, 1): at 1 nothing would be left of any light");
  }
  if (!(bleeding_power > 0 && bleeding_power <= 100)) {
    refuse("bleeding power = " + detail::shortest(bleeding_power) + " is outside 0 to 100");
  }
  if (!(bleeding_lift >= 0 && bleeding_lift <= 1)) {
    refuse("bleeding lift = " + detail::shortest(bleeding_lift) + " is outside [0, 1]");
  }
  if (!(exponent > 0 && exponent <= 700 && negative_exponent > 0 && negative_exponent <= 700)) {
    refuse("an exponent is outside 0 to 700");
  }
  if (smallest_box < 1 || smallest_box > 256) {
    refuse("smallest box = " + std::to_string(smallest_box) + " texels is outside 1 to 256");
  }
  if (!(depth_bias >= 0 && depth_bias <= 0.5)) {
    refuse("depth bias = " + detail::shortest(depth_bias) + " is outside 0 to 0.5");
  }
  const bool layered = method == technique::lvsm && layers > 1;
  if (layered && transition && lookup != layer_lookup::own) {
    refuse("a transition blends a receiver's own layer with the next, but of several layers that " 
           "are looked up the darkest counts: leave out the one or the other");
  }
  if (layered && warping == layer_warp::unclamped && noise_floor) {
    refuse("the noise floor is derived for depths that a layer clamps to [0,1]: leave it out, or "
           "clamp");
  }
  if (terms < 1 || terms > 64) refuse("terms = " + std::to_string(terms) + " is outside 1 to 64");
  if (!(moment_bias >= 0 && moment_bias < 1)) {
    refuse("moment bias = " + detail::shortest(moment_bias) + " is outside [0, 1)");
  }
}

}  // namespace bitshade
