// The first sentence of a report: what stands in for a single-layer VSM in binary32.
#include <algorithm>
#include <array>
#include <string_view>

#include "bitshade/study/measures.hpp"
#include "io/text.hpp"
#include "report/labels.hpp"
#include "report/summary.hpp"

namespace bitshade {
namespace {

constexpr int vsm_bytes = 8;  // two moments in binary32

std::string in_words(int n) {
  constexpr std::array<std::string_view, 13> words{
      "no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven",
      "twelve"};
  return n < static_cast<int>(words.size()) ? std::string(words[static_cast<std::size_t>(n)])
                                            : std::to_string(n);
}

std::string value_of(const row& r, const std::string& name) {
  const std::size_t at = r.configuration.find(" " + name + "=");
  if (at == std::string::npos) return "";
  const std::size_t from = at + name.size() + 2;
  return r.configuration.substr(from, r.configuration.find(' ', from) - from);
}

/// "Two uniform unorm16 layers"; "A VSM in unorm16".
std::string subject(const row& r) {
  if (r.technique != "lvsm" || r.layers == 1) return "A VSM in " + r.format;
  const std::string rule = value_of(r, "splits");
  const std::string kind = rule.find_first_of("0123456789") != std::string::npos ? "hand-split"
                           : rule == "lloyd-view"                               ? "relaxed"
                           : rule == "lloyd"                                    ? "relaxed"
                           : rule == "optimal" || rule == "receivers"           ? "optimally split"
                                                                                : rule;
  std::string text = in_words(r.layers) + " " + kind + " " + r.format + " layers";
  text[0] = static_cast<char>(text[0] >= 'a' && text[0] <= 'z' ? text[0] - 32 : text[0]);
  return text;
}

bool stands_in(const row& r) {
  return (r.technique == "vsm" || r.technique == "lvsm") && r.bytes_per_texel != 0 &&
         r.format != "binary32" && r.format != "binary64" && r.vsm_difference.count != 0;
}

/// Whether a's picture answers the question better than b's: within a step of an 8-bit display
/// first, then fewer bytes, then less difference.
bool better(const row& a, const row& b) {
  const bool a_matches = a.vsm_difference.p999 <= tolerated_error,
             b_matches = b.vsm_difference.p999 <= tolerated_error;
  if (a_matches != b_matches) return a_matches;
  if (a_matches && a.bytes_per_texel != b.bytes_per_texel)
    return a.bytes_per_texel < b.bytes_per_texel;
  return a.vsm_difference.p999 < b.vsm_difference.p999;
}

}  // namespace

std::string headline(std::span<const row> rows) {
  const row* best = nullptr;
  for (const row& r : rows)
    if (stands_in(r) && (best == nullptr || better(r, *best))) best = &r;
  if (best == nullptr) return "";
  const row& r = *best;
  const auto place = static_cast<std::size_t>(best - rows.data());
  const std::string settings = settings_of(rows)[place];
  const bool plural = r.technique == "lvsm" && r.layers > 1;
  const bool matches = r.vsm_difference.p999 <= tolerated_error;
  std::string text = subject(r) + (settings.empty() ? "" : " (" + settings + ")");
  text += matches ? (plural ? " match" : " matches") : (plural ? " come" : " comes");
  text += std::string(matches ? " a binary32 VSM on this scene to within " :
                                " within ") +
          brief(r.vsm_difference.p999) +
          (matches ? "" : " of a binary32 VSM on this scene") +
          " at 99.9 % of the pixels (" + brief(r.vsm_difference.largest) + " at most), in ";
  text += std::to_string(r.bytes_per_texel) + " bytes a texel";
  text += r.bytes_per_texel == vsm_bytes ? ", as many as its own"
          : r.bytes_per_texel < vsm_bytes
              ? " in place of " + std::to_string(vsm_bytes)
              : ", more than its " + std::to_string(vsm_bytes);
  const std::string filter = value_of(r, "min-variance");
  for (const row& other : rows) {
    if (other.technique != "vsm" || other.format != "binary32" ||
        value_of(other, "min-variance") != filter)
      continue;
    text += "; against the truth " + std::string(plural ? "they err" : "it errs") + " by " +
            brief(r.figures.total.rmse) + " RMSE, that by " + brief(other.figures.total.rmse);
    break;
  }
  return text + ".";
}

}  // namespace bitshade
