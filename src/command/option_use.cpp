#include "command/option_use.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <stdexcept>

#include "command/study_options.hpp"
#include "io/error.hpp"
#include "io/text.hpp"

namespace bitshade::command {
namespace {

using config = const configuration&;

bool layered(config c) { return c.method == technique::lvsm && c.layers > 1; }
bool relaxed(config c) { return layered(c) && relaxes(c.splits); }
bool teleports(config c) { return relaxed(c) && c.lloyd.steps.teleport; }
bool exponential(config c) { return c.method == technique::evsm2 || c.method == technique::evsm4; }
bool kernel(config c) { return c.blurred() && has_kernel(c.method); }

/// How far an option reaches beyond the techniques that `used` names.
enum class reach {
  own,     ///< a technique's own parameter: nobody expects it to change another
  effect,  ///< an effect of several techniques: a list that mixes them is told of the others
  filter,  ///< a filter of several techniques, and of the truth that all are measured against
};

struct option_use {
  const char* name;
  reach how_far;
  const char* users;
  bool (*used)(config);
};

/// What is not here (techniques, formats) concerns every cell. --layers 1 is what all others have.
constexpr option_use uses[] = {
    {"layers", reach::own, "lvsm", [](config c) { return c.method == technique::lvsm; }},
    {"splits", reach::own, "lvsm of several layers", layered},
    {"overlap", reach::own, "lvsm of several layers", layered},
    {"transition", reach::own, "lvsm of several layers", layered},
    {"lookup", reach::own, "lvsm of several layers", layered},
    {"layer-warp", reach::own, "lvsm of several layers", layered},
    {"direct-index", reach::own, "lvsm of several layers", layered},
    {"min-width", reach::own, "lvsm of several layers whose splits are not uniform",
     [](config c) { return layered(c) && c.splits != split_rule::uniform; }},
    {"one-pass", reach::own, "lvsm", [](config c) { return c.method == technique::lvsm; }},
    {"lloyd-weights", reach::own, "lvsm with splits by lloyd, lloyd-view, receivers or optimal",
     [](config c) { return relaxed(c) || (layered(c) && c.splits == split_rule::optimal); }},
    {"lloyd-splits", reach::own, "lvsm with splits by lloyd, lloyd-view or receivers", relaxed},
    {"lloyd-sums", reach::own, "lvsm with splits by lloyd, lloyd-view or receivers", relaxed},
    {"lloyd-latency", reach::own, "lvsm with splits by lloyd, lloyd-view or receivers", relaxed},
    {"lloyd-teleport", reach::own, "lvsm with splits by lloyd, lloyd-view or receivers", relaxed},
    {"lloyd-scope", reach::own, "Lloyd relaxation whose splits teleport", teleports},
    {"lloyd-hysteresis", reach::own, "Lloyd relaxation whose splits teleport", teleports},
    {"lloyd-measure", reach::own, "lvsm with splits by lloyd, lloyd-view or receivers", relaxed},
    {"lloyd-rest", reach::own, "lvsm with splits by lloyd, lloyd-view or receivers", relaxed},
    {"lloyd-frames", reach::own, "lvsm with splits by lloyd, lloyd-view or receivers", relaxed},
    {"msaa", reach::filter, "techniques that resolve samples (all but hard and deep)",
     [](config c) { return takes_samples(c.method); }},
    {"blur", reach::filter, "techniques with a kernel (all but hard and savsm)",
     [](config c) { return has_kernel(c.method); }},
    {"blur-sigma", reach::filter, "a Gaussian blur of techniques with a kernel",
     [](config c) { return kernel(c) && c.filtered.shape == blur_shape::gaussian; }},
    {"blur-shape", reach::filter, "a blur of techniques with a kernel", kernel},
    {"blur-way", reach::effect, "techniques whose map is blurred (all but hard, pcf, savsm, deep)",
     [](config c) { return c.blurred() && blurs_its_map(c.method); }},
    {"blur-fraction-bits", reach::effect, "--blur-way linear",
     [](config c) {
       return c.blurred() && blurs_its_map(c.method) && c.filtered.way == blur_way::linear;
     }},
    {"lookups", reach::filter, "techniques with several lookups (all but hard, savsm, deep)",
     [](config c) { return averages_lookups(c.method); }},
    {"filter", reach::filter, "techniques with a kernel (all but hard and savsm)",
     [](config c) { return has_kernel(c.method); }},
    {"anisotropy", reach::filter, "techniques whose map is filtered (all but hard, pcf, savsm, deep)",
     [](config c) { return blurs_its_map(c.method); }},
    {"smallest-box", reach::own, "savsm",
     [](config c) { return c.method == technique::savsm; }},
    {"depth-bias", reach::own, "techniques that compare depths (hard, pcf, deep)",
     [](config c) { return compares_depths(c.method); }},
    {"min-variance", reach::effect, "techniques with a variance (vsm, savsm, lvsm, evsm2, evsm4)",
     [](config c) { return uses_floor(c.method); }},
    {"noise-floor", reach::effect, "techniques with a variance in a format, not exact",
     [](config c) { return uses_floor(c.method) && !c.exact(); }},
    {"slope-term", reach::effect, "techniques with a variance (vsm, savsm, lvsm, evsm2, evsm4)",
     [](config c) { return uses_floor(c.method); }},
    {"second-moment", reach::effect, "vsm, savsm and lvsm",
     [](config c) { return stores_variance(c.method); }},
    {"bleeding-reduction", reach::effect, "techniques that bleed (all but hard, pcf, deep)",
     [](config c) { return !compares_depths(c.method); }},
    {"bleeding-power", reach::effect, "techniques that bleed (all but hard, pcf, deep)",
     [](config c) { return !compares_depths(c.method); }},
    {"bleeding-lift", reach::effect, "techniques that bleed (all but hard, pcf, deep)",
     [](config c) { return !compares_depths(c.method); }},
    {"exponent", reach::own, "esm, evsm2 and evsm4",
     [](config c) { return exponential(c) || c.method == technique::esm; }},
    {"negative-exponent", reach::own, "evsm4",
     [](config c) { return c.method == technique::evsm4; }},
    {"terms", reach::own, "csm", [](config c) { return c.method == technique::csm; }},
    {"moment-bias", reach::own, "msm", [](config c) { return c.method == technique::msm; }},
    {"basis", reach::own, "msm", [](config c) { return c.method == technique::msm; }},
    {"moment-bound", reach::own, "msm", [](config c) { return c.method == technique::msm; }},
};

const option_use* use_of(const std::string& option) {
  const auto* const at = std::find_if(std::begin(uses), std::end(uses),
                                      [&](const option_use& u) { return option == u.name; });
  return at == std::end(uses) ? nullptr : at;
}

/// "msm, esm and 3 more" would hide what matters: every technique once.
std::string techniques_without(const option_use& use, const std::vector<configuration>& cells) {
  std::vector<std::string> names;
  for (const configuration& c : cells) {
    const std::string name(name_of(c.method));
    if (!use.used(c) && std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(name);
  }
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

bool is_used(const std::string& option, const configuration& c, measured how) {
  const option_use* const use = use_of(option);
  if (use == nullptr || use->used(c)) return true;
  return use->how_far == reach::filter && how == measured::against_truth;
}

std::string users_of(const std::string& option) {
  const option_use* const use = use_of(option);
  if (use == nullptr) throw std::out_of_range(option + " concerns every technique");
  return use->users;
}

std::vector<std::string> check_use(const CLI::App& app, const std::vector<configuration>& cells,
                                   measured how) {
  std::vector<std::string> notes;
  for (const CLI::Option* option : app.get_options()) {
    if (option->count() == 0 || option->get_lnames().empty()) continue;
    const std::string& name = option->get_lnames().front();
    const option_use* const use = use_of(name);
    if (use == nullptr || (name == "layers" && option->as<std::string>() == "1")) continue;
    const auto used = [&](const configuration& c) { return is_used(name, c, how); };
    if (std::none_of(cells.begin(), cells.end(), used))
      throw usage_error("--" + name + " is for " + use->users + ": leave it out");
    if (use->how_far != reach::effect) continue;
    const std::string others = techniques_without(*use, cells);
    if (!others.empty()) notes.push_back("--" + name + " changes nothing in " + others);
  }
  return notes;
}

std::string arguments_of(const CLI::App& app, std::vector<std::string> left_out,
                         const configuration& c) {
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames())
      if (!is_used(name, c)) left_out.push_back(name);
  return arguments_of(app, left_out);
}

void print_notes(const std::vector<std::string>& notes) {
  for (const std::string& note : notes)
    for (const std::string& line : wrap("Note: " + note + ".", 80)) std::cout << line << '\n';
}

}  // namespace bitshade::command
