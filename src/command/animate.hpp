// `bitshade render --animate`: a moving scene as a numbered series of pictures.
#pragma once

#include <string>

#include "bitshade/study/configuration.hpp"
#include "scene/scene.hpp"

namespace bitshade::command {

struct animation {
  std::string scene;
  scene_options how;
  configuration cell;
  std::string out;
  int frames = 0;
  int steps = 1;  ///< of Lloyd relaxation, a frame
  bool json = false;
};

/// Renders every frame into the folder, with the splits' path as CSV and SVG. Frames that an
/// earlier run finished are taken from series.sqlite; every file appears whole or not at all.
void animate(const animation& given);

}  // namespace bitshade::command
