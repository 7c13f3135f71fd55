// `bitshade convert`: a texture's texels in another format, as a device stores them.
#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "command/commands.hpp"
#include "command/texture_options.hpp"

namespace bitshade::command {
namespace {

struct options {
  std::string texture, name, format, preset = "exact", out;
  bool json = false;
};

void convert(const options& given) {
  const named_texture texture = read_texture(given.texture, given.name);
  const named_texture result = in_format(choose_preset(given.preset), texture, given.format);
  write_texture(result, given.json, given.out);
}

}  // namespace

void add_convert(CLI::App& app) {
  auto given = std::make_shared<options>();
  CLI::App* command = app.add_subcommand(
      "convert",
      "Store a texture in another format as a device does\n"
      "All levels are converted. The answer has the layout of --texture's .csv, raw words.");
  command->add_option("--texture", given->texture, "Texture: .csv, .png or .exr")
      ->required()
      ->option_text("FILE");
  command->add_option("--name", given->name, "Which texture of a .csv that holds several")
      ->option_text("NAME");
  command
      ->add_option(
          "--format", given->format,
          "Format of each channel ('bitshade formats' lists them), or of the texel: RG16_UNORM")
      ->required()
      ->option_text("NAME");
  command
      ->add_option("--preset", given->preset,
                   "Whose loads and stores: as for 'bitshade sample'; exact rounds to nearest even")
      ->capture_default_str();
  command->add_flag("--json", given->json,
                    "A JSON array of levels, texels as arrays of raw words");
  command->add_option("--out", given->out, "File to write instead of standard output")
      ->option_text("FILE");
  command->footer("Example:\n  bitshade convert --texture depth.png --format half --preset d3d11");
  command->callback([given] { convert(*given); });
}

}  // namespace bitshade::command
