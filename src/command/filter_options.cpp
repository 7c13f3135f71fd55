#include "command/filter_options.hpp"

#include <CLI/CLI.hpp>

#include "command/named_option.hpp"

namespace bitshade::command {
void add_filter_options(CLI::App& app, configuration& how, const std::string& group) {
  const auto number = [&](const std::string& option, auto& to, const std::string& meaning) {
    app.add_option(option, to, meaning)->capture_default_str()->option_text("N")->group(group);
  };
  number("--msaa", how.filtered.msaa, "Samples a texel, resolved before shading: 1, 2, 4, 8");
  number("--blur", how.blur_taps, "Taps of the blur along each axis: odd, 0 for none");
  number("--blur-sigma", how.blur_sigma, "Standard deviation of its Gaussian, in texels");
  add_named_option(app, "--blur-shape", how.filtered.shape, blur_shape_names,
                   "gaussian or box: its weights")
      ->group(group);
  add_named_option(app, "--blur-way", how.filtered.way, blur_way_names,
                   "separable, one-pass or linear: two passes, one, or two of bilinear fetches")
      ->group(group);
  number("--blur-fraction-bits", how.filtered.fraction_bits,
         "Bits of a bilinear fetch's place between texels; 0: all");
  number("--lookups", how.filtered.lookups,
         "Each light is the mean of N x N lookups a texel apart: 1, 3, 5");
  add_named_option(app, "--filter", how.filter, filter_names, "nearest, bilinear or trilinear")
      ->group(group);
  number("--anisotropy", how.max_anisotropy, "Most probes of a footprint, 1 to 16");
  number("--smallest-box", how.smallest_box,
         "Least width of a summed-area table's rectangles, in texels");
}

}  // namespace bitshade::command
