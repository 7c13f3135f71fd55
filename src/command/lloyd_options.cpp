// The choices of Lloyd relaxation on the command line.
#include <CLI/CLI.hpp>
#include <charconv>

#include "command/named_option.hpp"
#include "command/technique_options.hpp"
#include "io/numbers.hpp"
#include "run/storage.hpp"

namespace bitshade::command {
namespace {

constexpr const char* group = "Lloyd relaxation";

/// "all" as 0, or a number of splits.
int splits_of(const std::string& text) {
  if (text == "all") return 0;
  int n = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
  if (error != std::errc() || end != text.data() + text.size() || n < 1)
    throw usage_error("--lloyd-splits takes all, or how many splits move a frame, but not '" +
                      text + "'");
  return n;
}

void choose_target(const std::string& name, lloyd_options& steps) {
  steps.teleport = name != "off";
  if (!steps.teleport) return;
  const auto& names = teleport_target_names;
  const auto at = std::find(names.begin(), names.end(), name);
  if (at == names.end())
    throw usage_error("--lloyd-teleport: there is no target '" + name + "'; " +
                      (name == "on" ? "say which: layer-mean is the source's"
                                    : suggest(name, names) + ", or off"));
  steps.target = static_cast<teleport_target>(at - names.begin());
}

}  // namespace

void add_lloyd_options(CLI::App& app, lloyd_choices& c) {
  app.add_option_function<std::string>(
         "--lloyd-weights",
         [&c](const std::string& text) {
           const auto n = parse_numbers(text, "--lloyd-weights", 2, 2);
           c.weights = {n[0], n[1]};
         },
         "Variances below LOW weigh nothing, above HIGH no more than HIGH")
      ->default_str("4e-5,0.01")
      ->option_text("LOW,HIGH")
      ->group(group);
  app.add_option_function<std::string>(
         "--lloyd-splits",
         [&c](const std::string& text) { c.steps.splits_per_frame = splits_of(text); },
         "How many splits move a frame; its source moves 2")
      ->default_str("all")
      ->option_text("all|N")
      ->group(group);
  app.add_option_function<std::string>(
         "--lloyd-sums",
         [&c](const std::string& name) {
           if (name != "exact") storage_named(name);  // refuses what is no format
           c.sums = name;
         },
         "Format of the reduction's levels, such as unorm16, half or binary32, or exact")
      ->default_str(c.sums)
      ->option_text("FORMAT")
      ->group(group);
  app.add_option("--lloyd-latency", c.steps.latency, "Frames until sums are read back")
      ->capture_default_str()
      ->option_text("N")
      ->group(group);
  app.add_option_function<std::string>(
         "--lloyd-teleport",
         [&c](const std::string& name) { choose_target(name, c.steps); },
         "off, or where a split without samples goes: layer-mean, layer-middle, costly-half")
      ->default_str("layer-mean")
      ->option_text("NAME")
      ->group(group);
  add_named_option(app, "--lloyd-scope", c.steps.scope, teleport_scope_names,
                   "all or frame: whose weights count for that, every layer's or those beside a "
                   "split that the frame sums anyway")
      ->group(group);
  app.add_option("--lloyd-hysteresis", c.steps.hysteresis,
                 "A teleportation must lower the cost by this share")
      ->capture_default_str()
      ->option_text("N")
      ->group(group);
  add_named_option(app, "--lloyd-measure", c.steps.measure, rest_measure_names,
                   "move or cost: what must hold still at rest")
      ->group(group);
  app.add_option("--lloyd-rest", c.steps.rest,
                 "The largest move (in depth) or change of cost (a share) that counts as rest")
      ->default_str("2^-24")
      ->option_text("N")
      ->group(group);
  app.add_option("--lloyd-frames", c.most_frames, "Frames at most until rest")
      ->capture_default_str()
      ->option_text("N")
      ->group(group);
}

}  // namespace bitshade::command
