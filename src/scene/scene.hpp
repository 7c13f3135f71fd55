// A scene: triangles that know which planar surface they belong to, a light and a camera.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bitshade/study/frame.hpp"

namespace bitshade {

/// What a depth map stores of a point: claims.md T3. L is the light's place, D its direction.
///
///   linear     (z - near) / (far - near), z = (p - L).D: distance to the light's plane, fitted
///   plane      z / far: distance to the light's plane, from the light on
///   distance   |p - L| / far: Euclidean distance to the light's place
///   projected  far (z - near) / (z (far - near)): what a perspective projection leaves in a depth
///              buffer; for a directional light the same as linear
///   vertex     |p - L| / far at the triangle's corners, interpolated between them (right only for
///              planar metrics: that is the point of having it)
///
/// A directional light's L is the centre of the scene's bounding box less D times a distance that
/// keeps the whole scene in front of it ([Marinescu11]).
enum class depth_metric { linear, plane, distance, projected, vertex };

/// All metrics' names, in the enum's order.
const std::vector<std::string>& metric_names();
/// The metric of that name. Failure: usage_error with the nearest known name.
depth_metric metric_named(const std::string& name);

/// A light and the window through which it sees the scene. Right, down and direction are
/// orthonormal; (u, v) run along right and down.
struct light_view {
  bool point = false;  ///< a perspective projection from `position`; else orthographic
  glm::dvec3 position{0, 1, 0};
  glm::dvec3 direction{0, -1, 0};
  glm::dvec3 right{1, 0, 0};
  glm::dvec3 down{0, 0, 1};
  double half_width = 1;  ///< of the window: in world units, or as a tangent for a point light
  double half_height = 1;
  double near = 0;  ///< z of depth 0 and of depth 1 in the linear metric
  double far = 1;
};

/// A pinhole camera.
struct camera_view {
  glm::dvec3 eye{0, 1, 3};
  glm::dvec3 target{0, 0, 0};
  double field_of_view = 40;  ///< degrees, over the picture's height
};

/// Triangles, a light and a camera.
///
/// Shapes   surfaces.size() == triangles.size(); a surface is one plane (or one facet of a curved
///          mesh), numbered from 1, so that a texel of a receiver's own surface cannot occlude it.
/// Units    world units, y up.
struct scene {
  std::string name;
  std::vector<glm::vec3> vertices;
  std::vector<glm::uvec3> triangles;
  std::vector<std::uint32_t> surfaces;
  light_view light;
  bool fit_range = true;  ///< near and far are fitted to what the light sees; else as they stand
  camera_view camera;
};

/// What a user may ask of any input; every field has the option's name on the command line.
struct scene_options {
  int map_size = 1024;
  int view_width = 960;
  int view_height = 600;
  depth_metric metric = depth_metric::linear;
  std::map<std::string, std::string> parameters;  ///< --param key=value, of an embedded scene
  std::optional<glm::dvec3> light_direction;      ///< --light x,y,z: from the light to the scene
  std::optional<glm::dvec3> light_position;       ///< --light-position x,y,z
  std::optional<glm::dvec3> light_to;  ///< --light-to x,y,z: where that has gone at half the time
  std::optional<double> time;          ///< of a moving scene, from 0 to 1; none: it stands still
  std::optional<camera_view> camera;              ///< --camera ex,ey,ez,tx,ty,tz[,degrees]
  std::string light_range;                        ///< --light-range tight | near,far
  std::string receivers;  ///< --receivers FILE | plane | self | DEPTH, with a captured depth map
  std::string channel;    ///< --channel NAME, of an EXR or a colour PNG
  std::optional<std::pair<double, double>> depth_range;  ///< --depth-range near,far
  bool mask_invalid = false;                             ///< --mask-invalid
  std::uint64_t seed = 1;
  std::set<int> samples;  ///< --msaa: numbers of samples of a texel, beside its centre
  int threads = 0;  ///< 0: all cores

  /// The options that the user gave, such as "--size": what cannot go together is found by them,
  /// and a captured map keeps its own sizes unless they are here.
  std::set<std::string> given;
};

/// One named number of an embedded scene.
struct scene_parameter {
  std::string name;
  std::string meaning;
  double initial;
  double low, high;
  bool whole = false;  ///< only whole numbers
};

/// An embedded scene and its parameters.
struct scene_info {
  std::string name;
  std::string meaning;
  std::vector<scene_parameter> parameters;
};

/// The embedded scenes, in the order of docs/scenes.md.
const std::vector<scene_info>& known_scenes();

/// Builds an embedded scene.
///
/// Failure  usage_error for an unknown scene or parameter (with the nearest known one), and for a
///          value outside its range.
scene build_scene(const std::string& name, const scene_options& options);

/// Whether `path` ends in .obj or .glb, in either case.
bool is_mesh_file(const std::filesystem::path& path);

/// Reads a mesh (.obj, .glb), puts a ground plane under it, a light and a camera around it.
///
/// Failure  failure for a file that is missing, broken, empty, or without finite triangles.
scene load_mesh(const std::filesystem::path& file, const scene_options& options);

/// The light's depth map, its samples where more than one is asked for, and the camera's
/// receivers, by rays; the same bits for any thread count.
///
/// Failure  usage_error for sizes of zero or beyond memory, before anything is allocated.
frame build_frame(const scene& scene, const scene_options& options);

/// A captured depth map as a frame, with receivers as options.receivers says: `plane` (the default:
/// a plane across the light at the deepest depth drawn), a number (the plane's depth), `self` (the
/// map's own surface seen from the light), or a second depth image, a receiver at each pixel.
///
/// Failure  as read_depths, and failure for NaN, infinite or out-of-range depths unless
///          options.mask_invalid, with their count and the first one's place.
frame load_captured(const std::filesystem::path& file, const scene_options& options);

/// Whatever the user named: an embedded scene, a mesh or a captured depth map.
///
/// Failure  as its parts; a name that is neither a known scene nor a file gets the nearest scene.
frame load_input(const std::string& scene_or_path, const scene_options& options);

}  // namespace bitshade
