#include "command/technique_options.hpp"

#include <CLI/CLI.hpp>
#include <array>

#include "command/named_option.hpp"

namespace bitshade::command {
namespace {

constexpr const char* what = "What is computed";

constexpr std::array<std::string_view, 2> basis_names{"dense", "optimised"};

CLI::Option* add_number(CLI::App& app, const std::string& name, double& value,
                        const std::string& meaning) {
  return app.add_option(name, value, meaning)->capture_default_str()->option_text("N")->group(what);
}

}  // namespace

void add_layer_options(CLI::App& app, configuration& c) {
  app.add_flag("--transition", c.transition, "Blend two layers across their overlap")->group(what);
  add_named_option(app, "--lookup", c.lookup, layer_lookup_names,
                   "own, nearer or every: the receiver's own layer, or the darkest of it and all "
                   "in front, or of all")
      ->group(what);
  add_named_option(app, "--layer-warp", c.warping, layer_warp_names,
                   "clamped or unclamped: what a layer makes of depths beyond its ends")
      ->group(what);
  app.add_flag("--direct-index", c.direct_index, "Compute a uniform layer's index, do not search")
      ->group(what);
  app.add_flag("--one-pass", c.one_pass,
               "Generate all layers in one pass, two in each four-component texture")
      ->group(what);
  add_number(app, "--min-width", c.min_width,
             "Least width of a layer, in depth: closer splits are merged");
}

void add_technique_options(CLI::App& app, configuration& c) {
  add_number(app, "--depth-bias", c.depth_bias,
             "Depth that a texel may lie before a receiver and leave it lit: hard, pcf, deep");
  add_number(app, "--bleeding-reduction", c.bleeding_reduction,
             "alpha of p' = (p - alpha)/(1 - alpha)");
  add_number(app, "--bleeding-power", c.bleeding_power,
             "a of the other form, p' = p^a + lift; its source takes 1.3");
  add_number(app, "--bleeding-lift", c.bleeding_lift, "lift of that form; its source takes 0.65");
  add_number(app, "--exponent", c.exponent, "c of ESM and EVSM");
  add_number(app, "--negative-exponent", c.negative_exponent, "Second c of evsm4");
  app.add_option("--terms", c.terms, "Terms of a convolution shadow map")
      ->capture_default_str()
      ->option_text("N")
      ->group(what);
  add_number(app, "--moment-bias", c.moment_bias, "Bias of four moments");
  add_named_option(app, "--basis", c.optimised_basis, basis_names,
                   "dense or optimised: how four moments are quantised")
      ->group(what);
  add_named_option(app, "--moment-bound", c.bound, moment_bound_names,
                   "hamburger or hausdorff: depths anywhere, or in the map's range")
      ->group(what);
}

}  // namespace bitshade::command
