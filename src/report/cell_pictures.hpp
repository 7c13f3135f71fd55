// The pictures of one configuration, as every command that draws one names, writes and lists them.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "bitshade/study/configuration.hpp"
#include "report/picture.hpp"

namespace bitshade {

/// What the names of a configuration's files start with: SCENE-TECHNIQUE[LAYERS]-FORMAT-.
std::string cell_stem(const std::string& scene, const configuration& c);

class cell_pictures {
 public:
  /// Makes the folder where there is none.
  /// Failure  usage_error where nothing can be written there.
  cell_pictures(std::filesystem::path folder, const std::string& scene, const configuration& c);

  /// STEM + name + ending in the folder.
  std::string path_of(const std::string& name, const std::string& ending = ".png") const;

  /// Writes a picture, or its PNG bytes, whole or not at all.
  void add(const std::string& name, const std::string& meaning, const picture& p);
  void add(const std::string& name, const std::string& meaning, const std::string& png);

  /// Paths by name.
  const nlohmann::ordered_json& files() const { return files_; }
  /// A line each: path and meaning.
  const std::string& list() const { return list_; }

 private:
  std::filesystem::path folder_;
  std::string stem_;
  nlohmann::ordered_json files_ = nlohmann::ordered_json::object();
  std::string list_;
};

}  // namespace bitshade
