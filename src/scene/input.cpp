// Whatever the user named: an embedded scene, a mesh or a captured depth map.
#include "scene/embedded.hpp"
#include "scene/light.hpp"

namespace bitshade {

frame load_input(const std::string& name, const scene_options& options) {
  scene s = build_scene(name, options);
  if (options.light_direction) aim_directional_light(s, *options.light_direction);
  if (options.light_position) aim_point_light(s, *options.light_position);
  return build_frame(s, options);
}

}  // namespace bitshade
