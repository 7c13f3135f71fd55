// C14, C20 and C21: layers beside a VSM of the same size, other splits, and Fourier series.
#include <algorithm>
#include <cmath>

#include "claims/footprint.hpp"
#include "claims/laboratory.hpp"
#include "claims/table.hpp"
#include "io/text.hpp"

namespace bitshade::claims {
namespace {

configuration of(technique method, const char* format, int layers = 1) {
  configuration how;
  how.method = method;
  how.format = format;
  how.layers = layers;
  return how;
}

double widest(const std::vector<interval>& layers) {
  double most = 0;
  for (const interval& layer : layers) most = std::max(most, layer.far - layer.near);
  return most;
}

// C14 ---------------------------------------------------------------------------------------------

outcome measure_alike(laboratory& lab) {
  outcome out;
  bool same_size = true, alike = true, as_fine = true;
  for (const char* name : {"garden", "slope", "beams", "rts", "planes"}) {
    const frame& scene = lab.scene(name);
    const auto two = lab.picture(scene, of(technique::lvsm, "unorm16", 2));
    const auto vsm = lab.picture(scene, of(technique::vsm, "binary32"));
    same_size = same_size && two.got.bytes_per_texel == vsm.got.bytes_per_texel;
    const std::string head = std::string(name) + ": ";
    out.add(head + "RMSE, two layers of unorm16", two.figures.total.rmse);
    out.add(head + "RMSE, VSM of binary32", vsm.figures.total.rmse);
    out.add(head + "99.9th percentile of the format error, unorm16", two.figures.format.p999);
    out.add(head + "99.9th percentile of the format error, binary32", vsm.figures.format.p999);
    alike = alike && two.figures.total.rmse <= vsm.figures.total.rmse + tolerated_error;
    as_fine = as_fine && two.figures.format.p999 <= tolerated_error;
    if (std::string(name) == "garden") {
      out.add("bytes a texel, two layers of unorm16", two.got.bytes_per_texel, "B");
      out.add("bytes a texel, VSM of binary32", vsm.got.bytes_per_texel, "B");
    }
  }
  const method& m = lab.under_test();
  out.add("bits that two layers of 16 are worth at their default overlap",
          16 - 2 * std::log2(widest(m.intervals(m.uniform_splits(2), configuration{}.overlap))),
          "bits");
  out.claim("the same bytes a texel", same_size);
  out.claim("in no scene an RMSE that is larger by more than 1/255", alike);
  out.claim("in every scene a format error below 1/255 for 999 of 1000 receivers", as_fine);
  out.condition =
      "the whole error counts: the method's own, which layers lower, hides the format's";
  out.provided("the same bytes a texel", same_size);
  out.provided("in no scene an RMSE that is larger by more than 1/255", alike);
  return out;
}

// C20 ---------------------------------------------------------------------------------------------

/// A layer's noise in world units goes with its width: the widest one is the worst depth's.
evaluation uniform_is_best(const method& m, const sample& s) {
  const auto made = layers_from(m, s.reals("splits"), 0);
  const auto count = static_cast<int>(made.layers.size());
  const number uniform(widest(m.intervals(m.uniform_splits(count), 0)) - split_grid);
  const number other(widest(made.layers));
  return {true,
          other < uniform,
          uniform - other,
          {{"widest layer", other}, {"widest uniform layer, less 2^-24", uniform}}};
}

const trial narrowest_maximum{"no splits have a narrower widest layer than uniform ones",
                              {{"splits", quantity::grid, 1, 7}},
                              uniform_is_best};

outcome measure_uniform(laboratory& lab) {
  outcome out;
  out.claim("no splits have a narrower widest layer",
            out.none_in(lab.search(narrowest_maximum, 2001, 6000), "random splits"));
  bool least = true;
  for (const char* name : {"garden", "slope", "beams", "rts"}) {
    const frame& scene = lab.scene(name);
    double error[2];
    for (const auto rule : {split_rule::uniform, split_rule::lloyd}) {
      configuration how = of(technique::lvsm, "unorm16", 4);
      how.splits = rule;
      how.overlap = 0;
      how.min_variance = 1e-7;
      const auto picture = lab.picture(scene, how);
      const bool lloyd = rule == split_rule::lloyd;
      error[lloyd] = picture.figures.format.rmse;
      out.add(std::string(name) + ", 4 layers of unorm16, " + (lloyd ? "Lloyd" : "uniform") +
                  ": RMSE of the format error",
              error[lloyd]);
      double most = 0;
      for (std::size_t i = 1; i < picture.got.splits.size(); ++i)
        most = std::max(most, picture.got.splits[i] - picture.got.splits[i - 1]);
      if (lloyd) out.add(std::string(name) + ", Lloyd: widest layer", most);
    }
    least = least && error[0] <= error[1];
  }
  out.claim("in every scene uniform splits have a smaller format error than Lloyd's", least);
  out.condition = "every depth counts alike: the worst one over the whole range is at its best";
  out.provided("no splits have a narrower widest layer", out.counterexamples.empty());
  return out;
}

// C21 ---------------------------------------------------------------------------------------------

/// The share of receivers that bleed.
double bleeding(laboratory& lab, const frame& scene, const configuration& how) {
  return 100 * lab.picture(scene, how).figures.bleed_area;
}

outcome measure_series(laboratory& lab) {
  outcome out;
  // One occluder close in front of one receiver: nothing overlaps.
  const frame& single = lab.scene("planes", {{"coverage", "0"}, {"dy", "0.05"}});
  bool smaller = true, smaller_while_small = true, vanishing = true, equal_bytes = true;
  for (const char* name : {"garden", "beams"}) {
    const frame& scene = lab.scene(name);
    double first[2] = {}, last[2] = {};
    for (const int layers : {2, 4, 6, 8}) {
      configuration lvsm = of(technique::lvsm, "unorm16", layers);
      lvsm.splits = split_rule::lloyd;
      configuration csm = of(technique::csm, "unorm8");
      csm.terms = 2 * layers;
      const auto ours = lab.picture(scene, lvsm), theirs = lab.picture(scene, csm);
      equal_bytes = equal_bytes && ours.got.bytes_per_texel == theirs.got.bytes_per_texel;
      const std::string head = std::string(name) + ", " + std::to_string(4 * layers) + " B: ";
      out.add(head + "RMSE, LVSM of " + std::to_string(layers) + " layers",
              ours.figures.total.rmse);
      out.add(head + "RMSE, CSM of " + std::to_string(2 * layers) + " terms",
              theirs.figures.total.rmse);
      const bool ours_is_smaller = ours.figures.total.rmse < theirs.figures.total.rmse;
      smaller = smaller && ours_is_smaller;
      if (layers <= 4) smaller_while_small = smaller_while_small && ours_is_smaller;
      if (layers == 2) first[0] = ours.figures.total.rmse, first[1] = theirs.figures.total.rmse;
      last[0] = ours.figures.total.rmse, last[1] = theirs.figures.total.rmse;
    }
    vanishing = vanishing && last[0] < first[0] && last[1] < first[1];
  }
  configuration csm = of(technique::csm, "unorm8");
  configuration lvsm = of(technique::lvsm, "unorm16", 2);
  lvsm.min_variance = 1e-7;  // a floor lights every shadow: it must fade within 0.05
  const double lvsm_alone = bleeding(lab, single, lvsm);
  const double csm_alone = bleeding(lab, single, csm);
  out.add("one occluder: LVSM of 2 layers bleeds", lvsm_alone, "% of receivers");
  out.add("one occluder: CSM of 4 terms bleeds", csm_alone, "% of receivers");
  out.claim("at equal bytes LVSM has the smaller error", equal_bytes && smaller);
  out.claim("without overlapping occluders LVSM does not bleed and CSM does",
            lvsm_alone == 0 && csm_alone > 0);
  out.claim("four times the storage lowers either one's error", vanishing);
  out.condition = "storage is at most 16 bytes a texel, and errors alone are compared";
  out.provided("up to 16 bytes LVSM has the smaller error", equal_bytes && smaller_while_small);
  return out;
}

}  // namespace

claim two_layers_claim() {
  return {"C14",
          "Two uniform layers of 16 bits take the memory of a VSM of 32 bits and behave alike.",
          "[LauritzenMcCool08] section 4",
          "Five scenes, rendered both ways: bytes, errors against the truth, and each format's own "
          "error.",
          measure_alike,
          {}};
}

claim uniform_splits_claim() {
  return {"C20",
          "Uniform splits give the best numeric precision.",
          "[LauritzenMcCool08] section 5",
          "The widest layer of random splits against the uniform ones', and the format error of "
          "uniform and Lloyd's splits on four scenes.",
          measure_uniform,
          {&narrowest_maximum}};
}

claim fourier_claim() {
  return {"C21",
          "LVSM needs less storage than convolution shadow maps; these bleed at every occluder, "
          "LVSM only where occluders overlap; both vanish with enough storage.",
          "[LauritzenMcCool08] section 6, fig. 8",
          "N = 2, 4, 6, 8 layers of unorm16 at Lloyd's splits beside M = 4, 8, 12, 16 terms of "
          "unorm8, of equal bytes, on two scenes; and one occluder 0.05 in front of one receiver.",
          measure_series,
          {}};
}

}  // namespace bitshade::claims
