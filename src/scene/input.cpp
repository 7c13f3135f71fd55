// Whatever the user named: an embedded scene, a mesh or a captured depth map.
#include <algorithm>

#include "io/depth_file.hpp"
#include "io/error.hpp"
#include "io/nearest.hpp"
#include "scene/light.hpp"
#include "scene/scene.hpp"

namespace bitshade {
namespace {

/// Refuses an option that means nothing for this kind of input.
void refuse(const scene_options& options, std::initializer_list<const char*> meaningless,
            const std::string& kind, const std::string& cure) {
  for (const char* option : meaningless) {
    if (options.given.contains(option)) {
      throw usage_error(std::string(option) + " means nothing for " + kind + ": " + cure);
    }
  }
}

void refuse_captured(const scene_options& options, const std::string& kind) {
  refuse(options, {"--receivers", "--channel", "--depth-range", "--mask-invalid"}, kind,
         "leave it out, it is for captured depth maps");
}

void place_light(scene& s, const scene_options& options) {
  if (options.light_direction && options.light_position) {
    throw usage_error("--light and --light-position contradict each other: keep one of them");
  }
  const auto moved = [&](const glm::dvec3& from) {
    if (!options.light_to) return from;
    const double t = *options.time;  // there and back
    return from + (*options.light_to - from) * (t < 0.5 ? 2 * t : 2 - 2 * t);
  };
  if (options.light_to && !options.time)
    throw usage_error("--light-to moves the light of a series of pictures: give --animate, too");
  if (options.light_position) {
    aim_point_light(s, moved(*options.light_position));
  } else if (options.light_direction || options.light_to) {
    aim_directional_light(s, moved(options.light_direction.value_or(s.light.direction)));
  }
}

[[noreturn]] void nothing_of_that_name(const std::string& name) {
  std::vector<std::string_view> names;
  for (const auto& info : known_scenes()) names.push_back(info.name);
  const bool file_like = name.find_first_of("./\\") != std::string::npos;
  throw usage_error(file_like
                        ? name +
                              " is neither a mesh (.obj, .glb) nor a captured depth map (.exr, "
                              ".png, .pfm, .npy): check its ending"
                        : "unknown scene '" + name + "': " + suggest(name, names));
}

}  // namespace

frame load_input(const std::string& name, const scene_options& options) {
  const auto& infos = known_scenes();
  if (std::any_of(infos.begin(), infos.end(), [&](const auto& i) { return i.name == name; })) {
    refuse_captured(options, "an embedded scene");
    scene s = build_scene(name, options);
    place_light(s, options);
    return build_frame(s, options);
  }
  if (is_mesh_file(name)) {
    if (options.time && !options.light_to)
      throw usage_error("nothing moves in a mesh: with --animate give --light-to X,Y,Z");
    refuse_captured(options, "a mesh");
    scene s = load_mesh(name, options);
    place_light(s, options);
    return build_frame(s, options);
  }
  if (is_depth_file(name)) {
    if (options.time)
      throw usage_error(name + " is a captured depth map, which does not move: leave out --animate");
    refuse(options,
           {"--msaa", "--size", "--param", "--light", "--light-position", "--light-to", "--light-range",
            "--camera", "--metric", "--seed"},
           "a captured depth map", "leave it out, the map has been made already");
    return load_captured(name, options);
  }
  nothing_of_that_name(name);
}

}  // namespace bitshade
