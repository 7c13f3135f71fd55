#include "support/vector_files.hpp"

#include <algorithm>
#include <set>

#include "bitshade/formats/hexadecimal.hpp"
#include "bitshade/formats/text.hpp"
#include "io/atomic_file.hpp"
#include "io/error.hpp"
#include "io/text.hpp"

namespace bitshade::test {
namespace {

std::string text_of(const std::filesystem::path& path) {
  const std::vector<std::uint8_t> bytes = read_file(path);
  return {bytes.begin(), bytes.end()};
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines = split(text, '\n');
  while (!lines.empty() && lines.back().empty()) lines.pop_back();
  return lines;
}

float number(const std::string& text, const std::string& file) {
  const auto x = parse_number(text);
  if (!x) throw failure(file + ": '" + text + "' is no number");
  return static_cast<float>(decode(binary32::value, encode(binary32::value, *x)));
}

void read_samples(const std::filesystem::path& folder, vector_file& out) {
  const std::string text = text_of(folder / out.file);
  out.where = parse_coordinates(text, out.file);
  const std::vector<std::string> lines = lines_of(text);
  const std::vector<std::string> header = split(lines.front(), ',');
  const std::size_t first = out.where.gradient ? 6 : 3;
  const auto channels = static_cast<std::size_t>(out.texture.format.channels);
  for (std::size_t i = first; i < header.size(); i += channels)
    out.renderers.push_back(header[i].substr(0, header[i].rfind('_')));
  out.results.resize(out.renderers.size());
  for (std::size_t row = 1; row < lines.size(); ++row) {
    const std::vector<std::string> parts = split(lines[row], ',');
    for (std::size_t i = first; i < parts.size(); ++i)
      out.results[(i - first) / channels].push_back(number(parts[i], out.file));
  }
}

}  // namespace

std::vector<vector_file> read_vectors(const std::filesystem::path& folder) {
  const std::vector<named_texture> textures =
      parse_textures(text_of(folder / "textures.csv"), (folder / "textures.csv").string());
  std::vector<vector_file> result;
  const std::vector<std::string> index = lines_of(text_of(folder / "index.csv"));
  for (std::size_t i = 1; i < index.size(); ++i) {
    const std::vector<std::string> parts = split(index[i], ',');
    if (parts.size() != 7) throw failure("index.csv: a row has no 7 columns");
    vector_file file;
    file.file = parts[0];
    file.kind = parts[2];
    const auto found = std::find_if(textures.begin(), textures.end(),
                                    [&](const named_texture& t) { return t.name == parts[1]; });
    if (found == textures.end()) throw failure("index.csv: no texture " + parts[1]);
    file.texture = *found;
    file.state.u = file.state.v = parts[3] == "repeat" ? address::repeat : address::clamp;
    file.state.mips = parts[4] == "1" ? mip_selection::linear : mip_selection::none;
    file.state.max_anisotropy = std::stoi(parts[5]);
    read_samples(folder, file);
    if (file.where.lookups.size() != std::stoul(parts[6]))
      throw failure(file.file + ": not as many rows as index.csv says");
    result.push_back(std::move(file));
  }
  return result;
}

std::vector<std::pair<std::string, std::string>> print_vectors(
    const std::vector<vector_file>& files) {
  std::string index = "file,texture,kind,wrap,mipmap_linear,max_anisotropy,rows\n";
  std::string textures = "texture,format,level,width,height,texels_hex_row_major\n";
  std::set<std::string> printed;
  std::vector<std::pair<std::string, std::string>> result;
  for (const vector_file& f : files) {
    index += f.file + ',' + f.texture.name + ',' + f.kind + ',' +
             (f.state.u == address::repeat ? "repeat" : "clamp_to_edge") + ',' +
             (f.state.mips == mip_selection::linear ? '1' : '0') + ',' +
             std::to_string(f.state.max_anisotropy) + ',' + std::to_string(f.where.lookups.size()) +
             '\n';
    if (printed.insert(f.texture.name).second) textures += print_texture(f.texture);
    std::string text = f.where.gradient ? "u,v,dudx,dvdx,dudy,dvdy" : "u,v,lod";
    const auto channels = static_cast<std::size_t>(f.texture.format.channels);
    for (const std::string& r : f.renderers)
      for (std::size_t c = 0; c < channels; ++c) text += ',' + r + '_' + "rgba"[c];
    text += '\n';
    for (std::size_t row = 0; row < f.where.lookups.size(); ++row) {
      const auto& at = f.where.lookups[row];
      std::vector<double> numbers{at.u, at.v};
      if (f.where.gradient)
        numbers.insert(numbers.end(), {at.g.du_dx, at.g.dv_dx, at.g.du_dy, at.g.dv_dy});
      else
        numbers.push_back(at.lod);
      for (const auto& r : f.results)
        for (std::size_t c = 0; c < channels; ++c) numbers.push_back(r[row * channels + c]);
      for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (i > 0) text += ',';
        text += hexadecimal(numbers[i]);
      }
      text += '\n';
    }
    result.emplace_back(f.file, text);
  }
  result.emplace_back("index.csv", index);
  result.emplace_back("textures.csv", textures);
  return result;
}

}  // namespace bitshade::test
