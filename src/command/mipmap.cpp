// `bitshade mipmap`: the chain that a device makes of a texture.
#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "bitshade/texture/device_sampler.hpp"
#include "command/commands.hpp"
#include "command/texture_options.hpp"
#include "io/error.hpp"
#include "io/nearest.hpp"

namespace bitshade::command {
namespace {

struct options {
  std::string texture, name, format, preset = "exact", mips, out;
  bool json = false;
};

void make_chain(const options& given) {
  named_texture texture = read_texture(given.texture, given.name);
  texture.levels.resize(1);
  if (!given.format.empty())
    texture = in_format(choose_preset(given.preset), texture, given.format);
  filter_model model = choose_preset(given.preset, texture.format);
  if (!given.mips.empty()) {
    static constexpr std::string_view known[] = {"box", "centre", "area"};
    if (given.mips == "box")
      model.mips = mip_filter::box;
    else if (given.mips == "centre")
      model.mips = mip_filter::centre;
    else if (given.mips == "area")
      model.mips = mip_filter::area;
    else
      throw usage_error("--mips: no '" + given.mips + "'; " + suggest(given.mips, known));
  }
  complete_chain(model, texture);
  write_texture(texture, given.json, given.out);
}

}  // namespace

void add_mipmap(CLI::App& app) {
  auto given = std::make_shared<options>();
  CLI::App* command = app.add_subcommand(
      "mipmap",
      "Make a texture's mip chain as a device does\n"
      "The answer has the layout of --texture's .csv, one line a level, raw words.");
  command
      ->add_option("--texture", given->texture, "Texture: .csv, .png or .exr; its level 0 is taken")
      ->required()
      ->option_text("FILE");
  command->add_option("--name", given->name, "Which texture of a .csv that holds several")
      ->option_text("NAME");
  command->add_option("--format", given->format, "Store the texels in this format first")
      ->option_text("NAME");
  command
      ->add_option("--preset", given->preset,
                   "Whose arithmetic and stores: as for 'bitshade sample'")
      ->capture_default_str();
  command->add_option(
      "--mips", given->mips,
      "box, centre (bilinear at the texel's centre) or area; default: the preset's");
  command->add_flag("--json", given->json,
                    "A JSON array of levels, texels as arrays of raw words");
  command->add_option("--out", given->out, "File to write instead of standard output")
      ->option_text("FILE");
  command->footer(
      "Example:\n  bitshade mipmap --texture depth.png --preset llvmpipe --format half");
  command->callback([given] { make_chain(*given); });
}

}  // namespace bitshade::command
