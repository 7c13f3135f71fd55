#include "scene/embedded.hpp"

#include <cmath>

#include "io/error.hpp"
#include "io/nearest.hpp"
#include "io/numbers.hpp"
#include "io/text.hpp"

namespace bitshade {
namespace {

const std::vector<embedded_scene>& all_scenes() {
  static const std::vector<embedded_scene> scenes{planes_scene(), garden_scene(), slope_scene(),
                                                  beams_scene(),  rts_scene(),    city_scene()};
  return scenes;
}

parameter_values values_of(const scene_info& info, const scene_options& options) {
  std::map<std::string, double> values;
  for (const auto& p : info.parameters) values[p.name] = p.initial;
  for (const auto& [name, text] : options.parameters) {
    const scene_parameter* found = nullptr;
    std::vector<std::string_view> names;
    for (const auto& p : info.parameters) {
      names.push_back(p.name);
      if (p.name == name) found = &p;
    }
    if (!found) {
      throw usage_error("the scene " + info.name + " has no parameter '" + name +
                        "': " + suggest(name, names));
    }
    const double value = parse_numbers(text, "--param " + name, 1, 1)[0];
    if (!(value >= found->low && value <= found->high) ||
        (found->whole && value != std::floor(value))) {
      throw usage_error("--param " + name + " takes a " + (found->whole ? "whole " : "") +
                        "number from " + shortest(found->low) + " to " + shortest(found->high) +
                        ", but not " + text);
    }
    values[name] = value;
  }
  if (options.time) {
    if (options.parameters.contains("animation"))
      throw usage_error("--animate runs through all of --param animation: leave one of them out");
    values["animation"] = *options.time;
  }
  return {std::move(values), options.seed};
}

}  // namespace

scene_parameter animation_parameter(const std::string& what_moves) {
  return {"animation", "time of " + what_moves, 0, 0, 1};
}

const std::vector<scene_info>& known_scenes() {
  static const std::vector<scene_info> infos = [] {
    std::vector<scene_info> list;
    for (const auto& s : all_scenes()) list.push_back(s.info);
    return list;
  }();
  return infos;
}

scene build_scene(const std::string& name, const scene_options& options) {
  std::vector<std::string_view> names;
  for (const auto& s : all_scenes()) {
    names.push_back(s.info.name);
    if (s.info.name == name) {
      scene built = s.build(values_of(s.info, options));
      built.name = name;
      return built;
    }
  }
  throw usage_error("unknown scene '" + name + "': " + suggest(name, names));
}

}  // namespace bitshade
