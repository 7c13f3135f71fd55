// Recorded samples of renderers: the layout that docs/texture.md describes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bitshade/texture/sampler.hpp"
#include "io/texture_text.hpp"

namespace bitshade::test {

/// One file of samples: its lookups, and each renderer's results, row by row, channel by channel.
struct vector_file {
  std::string file;
  named_texture texture;
  sampler_state state;
  std::string kind;  ///< textureLod, textureGrad or aniso
  coordinates where;
  std::vector<std::string> renderers;
  std::vector<std::vector<float>> results;  ///< results[renderer][row * channels + channel]
};

/// Everything that a folder's index.csv lists. Throws failure with the file and the place.
std::vector<vector_file> read_vectors(const std::filesystem::path& folder);

/// The folder's files as text, by name: index.csv, textures.csv and one for each of `files`.
std::vector<std::pair<std::string, std::string>> print_vectors(
    const std::vector<vector_file>& files);

}  // namespace bitshade::test
