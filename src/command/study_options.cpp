#include "command/study_options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <stdexcept>

#include "command/filter_options.hpp"
#include "command/format_options.hpp"
#include "command/named_option.hpp"
#include "command/technique_options.hpp"
#include "io/build.hpp"
#include "io/error.hpp"
#include "io/nearest.hpp"
#include "io/numbers.hpp"
#include "io/text.hpp"

namespace bitshade::command {
namespace {

/// "a,b,c" as words; usage_error where one is missing or twice there.
std::vector<std::string> words_of(const std::string& list, const std::string& option) {
  std::vector<std::string> words = bitshade::split(list, ',');
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i].empty())
      throw usage_error(option + " has an empty place in '" + list +
                        "': write names between commas");
    if (std::find(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(i), words[i]) !=
        words.begin() + static_cast<std::ptrdiff_t>(i))
      throw usage_error(option + " names " + words[i] + " twice: once is enough");
  }
  return words;
}

technique technique_of(const std::string& name) {
  for (std::size_t i = 0; i < technique_names.size(); ++i)
    if (technique_names[i] == name) return static_cast<technique>(i);
  throw usage_error("--techniques: there is no technique '" + name + "'; " +
                    suggest(name, technique_names));
}

std::string format_of(const std::string& name) {
  if (name == "exact") return name;
  if (name.size() >= 4 && edit_distance(name, "exact") <= 1)
    throw usage_error("--formats: there is no format '" + name + "'; did you mean 'exact'?");
  if (choose_format(name).components.size() != 1)
    throw usage_error("--formats: " + name +
                      " packs components of different sizes, which moments " +
                      "do not fit; give a format of one number, such as unorm16");
  return name;
}

int layers_of(const std::string& word) {
  int n = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), n);
  if (error != std::errc() || end != word.data() + word.size() || n < 1 || n > 256)
    throw usage_error("--layers takes whole numbers from 1 to 256 between commas, but not '" +
                      word + "'");
  return n;
}

void choose_splits(const std::string& text, configuration& c) {
  // Every rule by its name; manual splits are told by their numbers.
  std::vector<std::string_view> rules;
  for (const auto name : split_rule_names) {
    if (name != split_rule_names[static_cast<std::size_t>(split_rule::manual)])
      rules.push_back(name);
  }
  const auto known = std::find(rules.begin(), rules.end(), text);
  if (known != rules.end()) {
    const auto at = std::find(split_rule_names.begin(), split_rule_names.end(), text);
    c.splits = static_cast<split_rule>(at - split_rule_names.begin());
  } else if (!text.empty() && (text[0] >= 'a' && text[0] <= 'z') && text != "inf" &&
             text != "nan") {
    throw usage_error(
        "--splits: there is no rule '" + text + "'; " + suggest(text, rules) +
        (nearest(text, rules).empty() ? ", or numbers between 0 and 1 with commas" : ""));
  } else {
    c.splits = split_rule::manual;
    c.manual_splits = parse_numbers(text, "--splits", 1, 255);
  }
}

}  // namespace

std::vector<technique> techniques_of(const std::string& list) {
  std::vector<technique> all;
  for (const std::string& name : words_of(list, "--techniques")) all.push_back(technique_of(name));
  return all;
}

std::vector<configuration> study_options::cells() const {
  configuration base = common;
  choose_splits(splits, base);
  std::vector<int> counts;
  for (const std::string& word : words_of(layers, "--layers")) counts.push_back(layers_of(word));
  if (base.splits == split_rule::manual) {
    const int needed = static_cast<int>(base.manual_splits.size()) + 1;
    if (!layers_given) counts = {needed};
    for (const int n : counts)
      if (n != needed && n != 1)
        throw usage_error("--splits " + splits + " makes " + std::to_string(needed) +
                          " layers, but --layers asks for " + std::to_string(n) +
                          ": leave one of the two out");
  }
  std::vector<configuration> all;
  for (const technique method : techniques_of(techniques)) {
    base.method = method;
    for (const int n : base.method == technique::lvsm ? counts : std::vector<int>{1}) {
      for (const std::string& format : words_of(formats, "--formats")) {
        configuration c = base;
        c.format = format_of(format);
        c.layers = n;
        if (n == 1) c.splits = split_rule::uniform, c.manual_splits.clear();
        try {
          c.validate();
        } catch (const std::invalid_argument& e) {
          throw usage_error(e.what());
        }
        all.push_back(std::move(c));
      }
    }
  }
  return all;
}

std::shared_ptr<study_options> add_study_options(CLI::App& app, const study_options& initial) {
  auto options = std::make_shared<study_options>(initial);
  study_options* const o = options.get();
  configuration* const c = &o->common;
  o->app = &app;
  const auto keep = [options](const std::string&) { return std::string(); };
  const std::string group = "What is computed";
  // The first option holds the options alive as long as the application.
  app.add_option("--techniques,--technique", o->techniques,
                 "hard, pcf, vsm, savsm, lvsm, evsm2, evsm4, esm, csm, msm, deep")
      ->capture_default_str()
      ->option_text("LIST")
      ->group(group)
      ->check(keep);
  app.add_option("--formats,--format", o->formats,
                 "Storage formats ('bitshade formats' lists them), or exact")
      ->capture_default_str()
      ->option_text("LIST")
      ->group(group);
  app.add_option_function<std::string>(
         "--layers", [o](const std::string& text) { o->layers = text, o->layers_given = true; },
         "Layers of an LVSM")
      ->default_str(o->layers)
      ->option_text("LIST")
      ->group(group);
  app.add_option("--splits", o->splits,
                 "uniform, lloyd, lloyd-view, optimal, receivers, or boundaries: 0.3,0.94")
      ->capture_default_str()
      ->option_text("RULE")
      ->group(group);
  app.add_option("--overlap", c->overlap, "Overlap of layers (delta), in depth")
      ->capture_default_str()
      ->option_text("N")
      ->group(group);
  app.add_option("--min-variance", c->min_variance,
                 "Floor of the variance (sigma_min^2), in depth^2")
      ->capture_default_str()
      ->option_text("N")
      ->group(group);
  add_filter_options(app, o->common, group);
  add_named_option(app, "--second-moment", c->second, second_moment_names,
                   "square, square-of-stored or centred: what stands beside the depth")
      ->group(group);
  app.add_flag("--noise-floor", c->noise_floor, "Never a floor under what the format's noise needs")
      ->group(group);
  app.add_flag("--slope-term", c->slope_term, "Receiver-slope term of the second moment")
      ->group(group);
  add_layer_options(app, *c);
  add_technique_options(app, *c);
  add_lloyd_options(app, c->lloyd);
  return options;
}

std::string arguments_of(const CLI::App& app, const std::vector<std::string>& left_out) {
  std::string out;
  for (const CLI::Option* option : app.get_options()) {
    if (option->count() == 0 || option->get_lnames().empty()) continue;
    const std::string& name = option->get_lnames().front();
    if (std::find(left_out.begin(), left_out.end(), name) != left_out.end()) continue;
    if (option->get_expected_max() == 0) {
      out += " --" + name;
      continue;
    }
    for (const std::string& value : option->results())
      out += " --" + name + " " + shell_quoted(value);
  }
  return out;
}

}  // namespace bitshade::command
