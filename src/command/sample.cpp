// `bitshade sample`: what a device's sampler returns, number by number.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <string>

#include "bitshade/formats/hexadecimal.hpp"
#include "bitshade/texture/ewa.hpp"
#include "command/commands.hpp"
#include "command/sampling.hpp"
#include "command/texture_options.hpp"
#include "io/atomic_file.hpp"
#include "io/error.hpp"
#include "io/nearest.hpp"
#include "io/numbers.hpp"

namespace bitshade::command {
namespace {

struct options {
  std::string texture, name, coordinates, format, preset = "exact", wrap = "clamp",
                                                  filter = "bilinear", border;
  int max_anisotropy = 1;
  bool json = false;
};

template <class Value, std::size_t N>
Value choose(const std::string& word, const std::string& option,
             const std::pair<std::string_view, Value> (&known)[N]) {
  std::vector<std::string_view> names;
  for (const auto& [name, value] : known) {
    if (word == name) return value;
    names.push_back(name);
  }
  throw usage_error(option + ": no '" + word + "'; " + suggest(word, names));
}

sampler_state state_of(const options& given) {
  static constexpr std::pair<std::string_view, address> wraps[] = {{"clamp", address::clamp},
                                                                   {"repeat", address::repeat},
                                                                   {"mirror", address::mirror},
                                                                   {"border", address::border}};
  enum class filter { nearest, bilinear, trilinear };
  static constexpr std::pair<std::string_view, filter> filters[] = {
      {"nearest", filter::nearest},
      {"bilinear", filter::bilinear},
      {"trilinear", filter::trilinear}};
  if (given.max_anisotropy < 1 || given.max_anisotropy > 16)
    throw usage_error("--max-anisotropy must be from 1 to 16");
  sampler_state state;
  state.u = state.v = choose(given.wrap, "--wrap", wraps);
  if (!given.border.empty()) {
    if (state.u != address::border)
      throw usage_error("--border has no meaning without --wrap border");
    const auto values = parse_numbers(given.border, "--border", 1, 4);
    for (std::size_t c = 0; c < 4; ++c) {
      // Binary32, as a sampler's border is set.
      state.border[c] =
          static_cast<double>(static_cast<float>(values[std::min(c, values.size() - 1)]));
      if (!(std::fabs(state.border[c]) < HUGE_VAL))
        throw usage_error("--border takes finite binary32 numbers, but not '" + given.border + "'");
    }
  }
  const filter chosen = choose(given.filter, "--filter", filters);
  state.linear = chosen != filter::nearest;
  state.mips = chosen == filter::trilinear ? mip_selection::linear : mip_selection::none;
  state.max_anisotropy = given.max_anisotropy;
  if (given.max_anisotropy > 1 && chosen != filter::trilinear)
    throw usage_error("--max-anisotropy needs --filter trilinear: probes choose their level");
  return state;
}

/// A line a lookup: r,g,.. or {"r": .., "g": ..}.
void answer(const texture_sampler& sampler, int channels, const coordinates& where, bool json) {
  static constexpr char letters[] = "rgba";
  if (json) {
    std::cout << '[';
  } else if (where.named) {
    for (int c = 0; c < channels; ++c) std::cout << (c == 0 ? "" : ",") << letters[c];
    std::cout << '\n';
  }
  bool first = true;
  for (const auto& at : where.lookups) {
    std::string line = !json ? "" : first ? "\n {" : ",\n {";
    first = false;
    for (int c = 0; c < channels; ++c) {
      const float value = where.gradient ? sampler.gradient(at.u, at.v, at.g, c)
                                         : sampler.lod(at.u, at.v, at.lod, c);
      const std::string number = hexadecimal(static_cast<double>(value));
      if (c > 0) line += json ? ", " : ",";
      line += json ? std::string("\"") + letters[c] + "\": \"" + number + '"' : number;
    }
    std::cout << line << (json ? "}" : "\n");
  }
  if (json) std::cout << "\n]\n";
}

/// Refuses ellipses that would take a second each: llvmpipe averages however long they are.
void check_ellipses(const filter_model& model, const named_texture& texture,
                    const sampler_state& state, const coordinates& where, const std::string& file) {
  constexpr double most_texels = 0x1p26;
  const bool unlimited = model.anisotropy == anisotropy_rule::ewa_unlimited;
  if (state.max_anisotropy <= 1 || (!unlimited && model.anisotropy != anisotropy_rule::ewa)) return;
  const coded_image& base = texture.levels.front();
  const int last = static_cast<int>(texture.levels.size()) - 1;
  for (std::size_t i = 0; i < where.lookups.size(); ++i) {
    const gradients& g = where.lookups[i].g;
    const int level =
        ewa_level(model, g, base.width, base.height, unlimited ? 0 : state.max_anisotropy);
    if (level >= last) continue;
    const ewa_ellipse ellipse(g, base.width, base.height, std::max(0, level));
    if (ewa_texels(ellipse) > most_texels)
      throw failure(file + ": lookup " + std::to_string(i + 1) + " averages an ellipse of over " +
                    std::to_string(static_cast<long>(most_texels)) + " texels of level " +
                    std::to_string(std::max(0, level)) + "; bring its derivatives closer together");
  }
}

void sample(const options& given) {
  const sampler_state state = state_of(given);
  named_texture texture = read_texture(given.texture, given.name);
  if (!given.format.empty())
    texture = in_format(choose_preset(given.preset), texture, given.format);
  const filter_model model = choose_preset(given.preset, texture.format);
  const std::vector<std::uint8_t> bytes = read_file(given.coordinates);
  const coordinates where = parse_coordinates(
      {reinterpret_cast<const char*>(bytes.data()), bytes.size()}, given.coordinates);
  if (state.max_anisotropy > 1 && !where.gradient)
    throw usage_error(
        "--max-anisotropy needs coordinates with derivatives: u,v,dudx,dvdx,dudy,dvdy");
  if (state.mips != mip_selection::none) complete_chain(model, texture);

  check_ellipses(model, texture, state, where, given.coordinates);
  answer(*make_texture_sampler(model, texture, state), texture.format.channels, where, given.json);
}

}  // namespace

void add_sample(CLI::App& app) {
  auto given = std::make_shared<options>();
  CLI::App* command = app.add_subcommand(
      "sample",
      "Sample a texture as a device does\n"
      "Results are C99 hexadecimal binary32, a line a lookup, a column a channel, headed where the "
      "coordinates are.");
  command
      ->add_option("--texture", given->texture,
                   "Texture: .csv (texture,format,level,width,height,texels), .png or .exr")
      ->required()
      ->option_text("FILE");
  command->add_option("--name", given->name, "Which texture of a .csv that holds several")
      ->option_text("NAME");
  command
      ->add_option("--coords", given->coordinates,
                   "Lookups: lines of u,v,lod or of u,v,dudx,dvdx,dudy,dvdy")
      ->required()
      ->option_text("FILE");
  command
      ->add_option("--format", given->format,
                   "Store the texels in this format first; 'bitshade formats' lists them")
      ->option_text("NAME");
  command
      ->add_option("--preset", given->preset,
                   "exact, d3d11, vulkan-strict, cuda, llvmpipe, llvmpipe-r8, softpipe or "
                   "swiftshader; llvmpipe means llvmpipe-r8 for 8-bit unorm, as it does there")
      ->capture_default_str();
  command->add_option("--wrap", given->wrap, "clamp, repeat, mirror or border")
      ->capture_default_str();
  command
      ->add_option("--border", given->border,
                   "What lies beyond with --wrap border: a number for all channels, or one each "
                   "(default 0)")
      ->option_text("N[,N..]");
  command
      ->add_option("--filter", given->filter,
                   "nearest, bilinear or trilinear; a chain that is missing is made as the "
                   "preset makes it")
      ->capture_default_str();
  command
      ->add_option("--max-anisotropy", given->max_anisotropy,
                   "Most probes along a footprint, 1 to 16")
      ->capture_default_str();
  command->add_flag("--json", given->json, "A JSON array, an object a lookup, instead of lines");
  command->footer(
      "Example, a device's own results against a preset:\n"
      "  bitshade sample --texture textures.csv --name rg16_16 --coords mine.csv \\\n"
      "                  --preset d3d11 > d3d11.csv");
  command->callback([given] { sample(*given); });
}

}  // namespace bitshade::command
