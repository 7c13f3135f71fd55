#include "report/maps.hpp"

#include <algorithm>
#include <array>

#include "report/colours.hpp"

namespace bitshade {
namespace {

std::uint8_t grey(double v) {
  return static_cast<std::uint8_t>(std::clamp(v, 0.0, 1.0) * 255 + 0.5);  // NaN does not come here
}

/// Surfaces in a few quiet colours, so that one is told from the next.
rgb surface_colour(std::uint32_t surface) {
  static constexpr std::array<rgb, 5> colours{
      {{214, 207, 194}, {176, 196, 184}, {196, 178, 166}, {170, 184, 204}, {206, 196, 158}}};
  return colours[surface % colours.size()];
}

void legend_into(picture& p, int top) {
  constexpr int margin = 26;
  const int span = std::max(1, p.width - 2 * margin);
  for (int y = top; y < top + legend_height && y < p.height; ++y)
    for (int x = 0; x < p.width; ++x) *p.at(x, y) = paper_index;
  for (int y = top + 4; y < top + 14 && y < p.height; ++y)
    for (int x = 0; x < span && margin + x < p.width; ++x)
      *p.at(margin + x, y) = static_cast<std::uint8_t>(2 * error_steps * x / std::max(1, span - 1));
  struct tick {
    double step;  // in decades from the least error, signed
    std::string_view label;
  };
  // Wide pictures carry every decade, narrow ones the ends alone.
  static constexpr tick ticks[] = {{-4, "-1"},   {-3, "-.1"}, {-2, "-.01"}, {-1, "-.001"}, {0, "0"},
                                   {1, "+.001"}, {2, "+.01"}, {3, "+.1"},   {4, "+1"}};
  for (const tick& t : ticks) {
    if (p.width < 360 && t.step != -4 && t.step != 0 && t.step != 4) continue;
    const int x = margin + static_cast<int>((t.step + 4) / 8 * (span - 1));
    for (int y = top + 14; y < top + 17 && y < p.height; ++y)
      if (x < p.width) *p.at(x, y) = ink_index;
    draw_text(p, x - text_width(t.label) / 2, top + 19, t.label, ink_index);
  }
  if (p.width >= 560) {
    const int left = margin + span / 16, right = margin + 15 * span / 16;
    draw_text(p, left - text_width("too dark") / 2, top + 19, "too dark", ink_index);
    draw_text(p, right - text_width("too light") / 2, top + 19, "too light", ink_index);
  }
}

}  // namespace

std::vector<double> without_gaps(std::span<const double> values) {
  std::vector<double> out(values.begin(), values.end());
  for (double& v : out)
    if (v != v) v = 1;
  return out;
}

picture visibility_map(std::span<const double> visibility, int width, int height) {
  picture p(width, height, 1);
  std::transform(visibility.begin(), visibility.end(), p.bytes.begin(), grey);
  return p;
}

picture error_map(std::span<const double> value, std::span<const double> truth, int width,
                  int height) {
  picture p(width, height + legend_height, 1);
  p.palette = error_palette();
  for (std::size_t i = 0; i < value.size(); ++i) p.bytes[i] = error_index(value[i] - truth[i]);
  legend_into(p, height);
  return p;
}

picture error_legend(int width) {
  picture p(width, legend_height, 1);
  p.palette = error_palette();
  legend_into(p, 0);
  return p;
}

picture depth_map(const frame& input) {
  picture p(input.depth.width, input.depth.height, 1);
  std::transform(input.depth.texels.begin(), input.depth.texels.end(), p.bytes.begin(),
                 [](float d) { return grey(static_cast<double>(d)); });
  return p;
}

picture shaded_map(const frame& input, std::span<const double> visibility) {
  picture p(input.view_width, input.view_height, 3);
  for (std::size_t i = 0; i < input.receivers.size(); ++i) {
    const receiver& r = input.receivers[i];
    // Without a receiver: sky, a side that faces away, or a point outside the map, which is lit.
    const bool sky = r.surface == 0 && r.diffuse == 1;
    const double seen = r.surface == 0 ? 1 : visibility[i];
    const rgb colour = sky ? rgb{168, 186, 206} : surface_colour(r.surface);
    const double light = sky ? 1 : 0.22 + 0.78 * static_cast<double>(r.diffuse) * seen;
    for (std::size_t k = 0; k < 3; ++k) p.bytes[3 * i + k] = grey(colour[k] / 255.0 * light);
  }
  return p;
}

picture layer_map(const frame& input, std::span<const double> visibility,
                  std::span<const int> layers) {
  picture p(input.view_width, input.view_height, 3);
  const auto colours = categories();
  for (std::size_t i = 0; i < input.receivers.size(); ++i) {
    const bool none = input.receivers[i].surface == 0;
    const rgb colour =
        none ? rgb{255, 255, 255} : colours[static_cast<std::size_t>(layers[i]) % colours.size()];
    const double light = none ? 1 : 0.35 + 0.65 * visibility[i];
    for (std::size_t k = 0; k < 3; ++k) p.bytes[3 * i + k] = grey(colour[k] / 255.0 * light);
  }
  return p;
}

}  // namespace bitshade
