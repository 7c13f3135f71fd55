#include "report/cell_pictures.hpp"

#include <utility>

#include "io/atomic_file.hpp"
#include "report/folder.hpp"

namespace bitshade {

std::string cell_stem(const std::string& scene, const configuration& c) {
  const std::string layers = c.method == technique::lvsm ? std::to_string(c.layers) : "";
  return file_stem(scene) + "-" + std::string(name_of(c.method)) + layers + "-" + c.format + "-";
}

cell_pictures::cell_pictures(std::filesystem::path folder, const std::string& scene,
                             const configuration& c)
    : folder_(std::move(folder)), stem_(cell_stem(scene, c)) {
  make_output_folder(folder_);
}

std::string cell_pictures::path_of(const std::string& name, const std::string& ending) const {
  return (folder_ / (stem_ + name + ending)).string();
}

void cell_pictures::add(const std::string& name, const std::string& meaning, const picture& p) {
  add(name, meaning, encode_png(p));
}

void cell_pictures::add(const std::string& name, const std::string& meaning,
                        const std::string& png) {
  const std::string path = path_of(name);
  write_file(path, png);
  files_[name] = path;
  list_ += "  " + path + (meaning.empty() ? "" : "  (" + meaning + ")") + '\n';
}

}  // namespace bitshade
