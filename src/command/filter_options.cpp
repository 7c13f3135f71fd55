#include "command/filter_options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <span>

#include "io/error.hpp"
#include "io/nearest.hpp"

namespace bitshade::command {
namespace {

/// An option that takes one of a few names.
template <class Enum, std::size_t Count>
void add_choice(CLI::App& app, const std::string& option, Enum& to,
                const std::array<std::string_view, Count>& names, const std::string& meaning,
                const std::string& group) {
  Enum* const target = &to;
  app.add_option_function<std::string>(
         option,
         [target, &names, option](const std::string& name) {
           const auto at = std::find(names.begin(), names.end(), name);
           if (at == names.end()) {
             throw usage_error(option + ": there is no '" + name + "'; " + suggest(name, names));
           }
           *target = static_cast<Enum>(at - names.begin());
         },
         meaning)
      ->default_str(std::string(names[static_cast<std::size_t>(to)]))
      ->option_text("NAME")
      ->group(group);
}

}  // namespace

void add_filter_options(CLI::App& app, configuration& how, const std::string& group) {
  const auto number = [&](const std::string& option, auto& to, const std::string& meaning) {
    app.add_option(option, to, meaning)->capture_default_str()->option_text("N")->group(group);
  };
  number("--msaa", how.filtered.msaa, "Samples a texel, resolved before shading: 1, 2, 4, 8");
  number("--blur", how.blur_taps, "Taps of the blur along each axis: odd, 0 for none");
  number("--blur-sigma", how.blur_sigma, "Standard deviation of its Gaussian, in texels");
  add_choice(app, "--blur-shape", how.filtered.shape, blur_shape_names,
             "gaussian or box: its weights", group);
  add_choice(app, "--blur-way", how.filtered.way, blur_way_names,
             "separable, one-pass or linear: two passes, one, or two of bilinear fetches", group);
  number("--blur-fraction-bits", how.filtered.fraction_bits,
         "Bits of a bilinear fetch's place between texels; 0: all");
  number("--lookups", how.filtered.lookups,
         "Each light is the mean of N x N lookups a texel apart: 1, 3, 5");
  add_choice(app, "--filter", how.filter, filter_names, "nearest, bilinear or trilinear", group);
  number("--anisotropy", how.max_anisotropy, "Most probes of a footprint, 1 to 16");
}

}  // namespace bitshade::command
