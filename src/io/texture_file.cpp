#include "io/texture_file.hpp"

#include <algorithm>
#include <vector>

#include "io/atomic_file.hpp"
#include "io/error.hpp"
#include "io/nearest.hpp"
#include "io/png.hpp"
#include "io/texture_exr.hpp"

namespace bitshade {
namespace {

std::string_view as_text(const std::vector<std::uint8_t>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

named_texture pick(std::vector<named_texture> all, const std::string& name,
                   const std::string& file) {
  std::vector<std::string_view> known;
  for (const named_texture& t : all) known.push_back(t.name);
  if (name.empty()) {
    if (all.size() == 1) return std::move(all.front());
    throw usage_error(file + " holds " + std::to_string(all.size()) +
                      " textures; pick one with --name, as in --name " + all.front().name);
  }
  for (named_texture& t : all)
    if (t.name == name) return std::move(t);
  throw usage_error("--name: " + file + " has no texture '" + name + "'; " + suggest(name, known));
}

named_texture from_png(const std::vector<std::uint8_t>& bytes, const std::string& file) {
  const png_contents png = decode_png(bytes, file);
  named_texture result{std::filesystem::path(file).stem().string(),
                       uniform_format(unorm_encoding(png.bits), png.codes.channels),
                       {}};
  coded_image codes(png.codes.width, png.codes.height, png.codes.channels);
  std::copy(png.codes.texels.begin(), png.codes.texels.end(), codes.texels.begin());
  result.levels.push_back(std::move(codes));
  return result;
}

}  // namespace

named_texture read_texture(const std::filesystem::path& path, const std::string& name) {
  const std::string file = path.string();
  std::string ending = path.extension().string();
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  if (ending != ".csv" && ending != ".png" && ending != ".exr")
    throw usage_error(file + ": a texture's name must end in .csv, .png or .exr");
  const std::vector<std::uint8_t> bytes = read_file(path);
  if (ending == ".csv") return pick(parse_textures(as_text(bytes), file), name, file);
  if (!name.empty()) throw usage_error("--name: " + file + " holds one texture; leave --name out");
  return ending == ".png" ? from_png(bytes, file) : decode_exr_texture(bytes, file);
}

}  // namespace bitshade
