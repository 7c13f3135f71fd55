// What the embedded scenes share: checked parameters, and one builder a scene.
#pragma once

#include <map>
#include <string>

#include "scene/scene.hpp"

namespace bitshade {

/// The values of one scene's parameters, all of them set and in range.
class parameter_values {
 public:
  parameter_values(std::map<std::string, double> values, std::uint64_t seed)
      : values_(std::move(values)), seed_(seed) {}
  double operator[](const std::string& name) const { return values_.at(name); }
  int count(const std::string& name) const { return static_cast<int>(values_.at(name)); }
  std::uint64_t seed() const { return seed_; }

 private:
  std::map<std::string, double> values_;
  std::uint64_t seed_;
};

/// A scene's description and how it is built.
struct embedded_scene {
  scene_info info;
  scene (*build)(const parameter_values&);
};

embedded_scene planes_scene();
embedded_scene garden_scene();
embedded_scene slope_scene();
embedded_scene beams_scene();
embedded_scene rts_scene();
embedded_scene city_scene();

/// The parameter that every embedded scene has: a moving scene's time.
scene_parameter animation_parameter(const std::string& what_moves);

}  // namespace bitshade
