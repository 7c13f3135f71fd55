#include <algorithm>
#include <map>
#include <optional>

#include "io/text.hpp"
#include "report/labels.hpp"
#include "report/summary.hpp"

namespace bitshade {
namespace {

/// "LVSM with 2 layers in unorm16".
std::string plain_name(const row& r) {
  std::string technique;
  for (const char c : r.technique)
    technique += c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c;
  if (r.technique == "hard") technique = "the hard test";
  if (r.technique != "lvsm") return technique + " in " + r.format;
  return technique + " with " + std::to_string(r.layers) +
         (r.layers == 1 ? " layer in " : " layers in ") + r.format;
}

/// The names of rows in sentences; rows that share one are told apart by their settings.
class row_names {
 public:
  explicit row_names(std::span<const row> rows) : rows_(rows), settings_(settings_of(rows)) {}

  std::string operator()(const row& r) const {
    const std::string& more = settings_[static_cast<std::size_t>(&r - rows_.data())];
    return plain_name(r) + (more.empty() ? "" : " (" + more + ")");
  }

 private:
  std::span<const row> rows_;
  std::vector<std::string> settings_;
};

/// The error that an 8-bit display cannot show.
bool invisible(const row& r) { return r.figures.format.largest <= tolerated_error; }

std::string share(double value) { return percent(value) + " %"; }

const row* find(std::span<const row> rows, const std::string& technique, int layers,
                const std::string& format) {
  for (const row& r : rows)
    if (r.technique == technique && r.layers == layers && r.format == format) return &r;
  return nullptr;
}

/// The cheapest row whose format error no 8-bit display shows.
std::string cheapest(std::span<const row> rows, const row_names& name_of) {
  const row* best = nullptr;
  for (const row& r : rows) {
    if (r.bytes_per_texel == 0 || !invisible(r)) continue;
    if (best == nullptr || r.bytes_per_texel < best->bytes_per_texel ||
        (r.bytes_per_texel == best->bytes_per_texel &&
         r.figures.total.rmse < best->figures.total.rmse))
      best = &r;
  }
  if (best == nullptr) {
    const row* least = nullptr;
    for (const row& r : rows)
      if (r.bytes_per_texel != 0 &&
          (least == nullptr || r.figures.format.largest < least->figures.format.largest))
        least = &r;
    if (least == nullptr) return "";
    return "No stored format here keeps its own error under one step of an 8-bit display (1/255) "
           "at "
           "every pixel; " +
           name_of(*least) + " comes nearest, with at most " +
           brief(least->figures.format.largest) + ".";
  }
  return "The cheapest format whose own error no 8-bit display shows (under 1/255 at every "
         "pixel): " +
         name_of(*best) + ", " + std::to_string(best->bytes_per_texel) +
         " bytes a texel, at most " + brief(best->figures.format.largest) + " off.";
}

/// Layered rows against the single-layer VSM in binary32: the paper's own comparison (C14).
std::vector<std::string> against_binary32(std::span<const row> rows, const row_names& name_of) {
  const row* vsm = find(rows, "vsm", 1, "binary32");
  std::vector<std::string> out;
  if (vsm == nullptr) return out;
  // Of several settings of one name, that of the least error: a grid has thousands.
  std::map<std::pair<int, std::string>, const row*> best;
  for (const row& r : rows) {
    if (r.technique != "lvsm" || r.layers < 2 || r.bytes_per_texel == 0 ||
        r.bytes_per_texel > vsm->bytes_per_texel)
      continue;
    const row*& kept = best[{r.layers, r.format}];
    if (kept == nullptr || r.figures.format.p999 < kept->figures.format.p999) kept = &r;
  }
  for (const auto& [which, r] : best)
    out.push_back("In " + std::to_string(r->bytes_per_texel) + " bytes a texel, " + name_of(*r) +
                  " has a format error of at most " + brief(r->figures.format.p999) +
                  " at 99.9 % of the pixels; " + name_of(*vsm) + " has " +
                  brief(vsm->figures.format.p999) + " in " + std::to_string(vsm->bytes_per_texel) +
                  ".");
  return out;
}

std::string bleeding(std::span<const row> rows, const row_names& name_of) {
  const row *least = &rows[0], *most = &rows[0];
  for (const row& r : rows) {
    if (r.figures.bleed_area < least->figures.bleed_area) least = &r;
    if (r.figures.bleed_area > most->figures.bleed_area) most = &r;
  }
  if (most->figures.bleed_area == 0) return "No configuration bleeds.";
  std::string out = name_of(*most) + " bleeds most, over " + share(most->figures.bleed_area) +
                    " of the receivers";
  out += least->figures.bleed_area == most->figures.bleed_area
             ? "; no configuration bleeds less."
             : "; " + name_of(*least) + " bleeds least, over " +
                   (least->figures.bleed_area == 0 ? std::string("none")
                                                   : share(least->figures.bleed_area)) +
                   ".";
  return out;
}

std::string acne(std::span<const row> rows, const row_names& name_of) {
  const row* worst = nullptr;
  for (const row& r : rows)
    if (worst == nullptr || r.figures.acne_area > worst->figures.acne_area) worst = &r;
  if (worst->figures.acne_area == 0)
    return "No configuration shows acne: every lit receiver stays lit.";
  return name_of(*worst) + " shows the most acne: " + share(worst->figures.acne_area) +
         " of the receivers are lit in truth and darker by more than 1/255.";
}

/// Where a rule of splits other than the uniform one put them, and what bleeds there: hit or miss.
std::vector<std::string> splits_found(std::span<const row> rows) {
  std::vector<std::string> out;
  std::map<std::string, std::vector<const row*>> same;  // by rule and splits, over the formats
  for (const row& r : rows) {
    const std::size_t at = r.configuration.find(" splits=");
    if (at == std::string::npos || r.splits.size() < 3) continue;
    const std::string rule =
        r.configuration.substr(at + 8, r.configuration.find(' ', at + 8) - at - 8);
    if (rule == "uniform") continue;
    std::string list;
    for (std::size_t i = 1; i + 1 < r.splits.size(); ++i)
      list += (list.empty() ? "" : ", ") + brief(r.splits[i], 4);
    const bool named = rule.find_first_of("0123456789") == std::string::npos;
    same["With " + std::to_string(r.layers) + " layers " +
         (named ? "the rule '" + rule + "' splits" : "split") + " at " + list]
        .push_back(&r);
  }
  for (const auto& [where, cells] : same) {
    const auto bleeds = [](const row* r) { return r->figures.bleed_area; };
    const auto [least, most] = std::minmax_element(
        cells.begin(), cells.end(), [&](auto a, auto b) { return bleeds(a) < bleeds(b); });
    out.push_back(where + ", " +
                  (bleeds(*most) == 0 ? "no receiver bleeds"
                   : bleeds(*least) == bleeds(*most)
                       ? share(bleeds(*most)) + " of the receivers bleed"
                       : share(bleeds(*least)) + " (" + (*least)->format + ") to " +
                             share(bleeds(*most)) + " (" + (*most)->format +
                             ") of the receivers bleed") +
                  ".");
  }
  return out;
}

/// Where the format, not the method, is what a user would see.
std::string who_is_to_blame(std::span<const row> rows, const row_names& name_of) {
  std::vector<std::string> formats;
  int stored = 0;
  for (const row& r : rows) {
    if (r.bytes_per_texel == 0) continue;
    ++stored;
    if (r.figures.format.rmse > r.figures.method.rmse) formats.push_back(name_of(r));
  }
  if (stored == 0) return "";
  if (formats.empty())
    return "In all " + std::to_string(stored) +
           " stored configurations the method's error exceeds the format's: a wider format would "
           "change less than another technique.";
  std::string list;
  for (std::size_t i = 0; i < formats.size() && i < 3; ++i) list += (i ? ", " : "") + formats[i];
  if (formats.size() > 3) list += " and " + std::to_string(formats.size() - 3) + " more";
  return "The format costs more than the method (by RMSE) in " + std::to_string(formats.size()) +
         " of " + std::to_string(stored) + " stored configurations: " + list + ".";
}

}  // namespace

std::vector<std::string> findings(std::span<const row> rows) {
  std::vector<std::string> out;
  if (rows.empty()) return out;
  const auto add = [&](std::string sentence) {
    if (sentence.empty()) return;
    if (sentence[0] >= 'a' && sentence[0] <= 'z') sentence[0] = static_cast<char>(sentence[0] - 32);
    out.push_back(std::move(sentence));
  };
  const row_names name_of(rows);
  add(headline(rows));
  add(cheapest(rows, name_of));
  add(bleeding(rows, name_of));
  for (std::string& s : splits_found(rows)) add(std::move(s));
  add(acne(rows, name_of));
  for (std::string& s : against_binary32(rows, name_of)) add(std::move(s));
  add(who_is_to_blame(rows, name_of));
  return out;
}

}  // namespace bitshade
