#include "command/scene_options.hpp"

#include <CLI/CLI.hpp>
#include <charconv>
#include <functional>

#include "io/error.hpp"
#include "io/numbers.hpp"
#include "io/text.hpp"

namespace bitshade::command {
namespace {

glm::dvec3 vector_of(const std::string& text, const std::string& option) {
  const auto n = parse_numbers(text, option, 3, 3);
  return {n[0], n[1], n[2]};
}

/// "1920x1200" as two whole numbers.
std::pair<int, int> size_of(const std::string& text) {
  int width = 0, height = 0;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, width);
  if (first.ec == std::errc() && first.ptr != end && (*first.ptr == 'x' || *first.ptr == 'X')) {
    const auto second = std::from_chars(first.ptr + 1, end, height);
    if (second.ec == std::errc() && second.ptr == end) return {width, height};
  }
  throw usage_error("--view takes WIDTHxHEIGHT, such as 960x600, but not '" + text + "'");
}

}  // namespace

std::shared_ptr<scene_options> add_scene_options(CLI::App& app) {
  auto options = std::make_shared<scene_options>();
  auto* const o = options.get();
  // The application owns the callbacks, and with them the options.
  const auto add = [&]<class T>(const std::string& name, const std::string& meaning,
                                const std::string& type, std::function<void(const T&)> take) {
    return app
        .add_option_function<T>(
            name,
            [options, name, take](const T& value) {
              options->given.insert(name);
              take(value);
            },
            meaning)
        ->type_name(type)
        ->group("Scene");
  };
  const auto text = [&](const std::string& name, const std::string& meaning,
                        const std::string& type, std::function<void(const std::string&)> take) {
    add(name, meaning, type, std::move(take));
  };
  add("--size", "texels along each side of the depth map", "N",
      std::function([o](const int& size) { o->map_size = size; }))
      ->default_str(std::to_string(o->map_size));
  text("--view", "pixels of the picture (default 960x600)", "WxH",
       [o](const std::string& value) { std::tie(o->view_width, o->view_height) = size_of(value); });
  add("--param", "a parameter of the scene, may be repeated ('bitshade depth --list' names them)",
      "NAME=NUMBER", std::function([o](const std::vector<std::string>& list) {
        for (const auto& one : list) {
          const std::size_t equals = one.find('=');
          if (equals == 0 || equals == std::string::npos) {
            throw usage_error("--param takes NAME=NUMBER, but not '" + one + "'");
          }
          if (!o->parameters.emplace(one.substr(0, equals), one.substr(equals + 1)).second) {
            throw usage_error("--param " + one.substr(0, equals) + " is given twice; keep one");
          }
        }
      }))
      ->allow_extra_args(false);
  text("--metric",
       "what the map stores: linear, plane, distance, projected or vertex (default linear)", "NAME",
       [o](const std::string& value) { o->metric = metric_named(value); });
  text("--light", "direction of the light's rays", "X,Y,Z",
       [o](const std::string& value) { o->light_direction = vector_of(value, "--light"); });
  text("--light-position", "place of a point light", "X,Y,Z",
       [o](const std::string& value) { o->light_position = vector_of(value, "--light-position"); });
  text("--light-to",
       "with --animate: what --light or --light-position has become halfway through, and back",
       "X,Y,Z", [o](const std::string& value) { o->light_to = vector_of(value, "--light-to"); });
  text("--light-range", "depths that become 0 and 1: 'tight' fits them to what the light sees",
       "tight|NEAR,FAR", [o](const std::string& value) {
         if (value != "tight") {
           const auto n = parse_numbers(value, "--light-range", 2, 2);
           if (!(n[0] < n[1]))
             throw usage_error("--light-range takes NEAR below FAR, but not '" + value + "'");
         }
         o->light_range = value;
       });
  text("--camera", "eye, target and field of view in degrees (40)", "EX,EY,EZ,TX,TY,TZ[,DEG]",
       [o](const std::string& value) {
         const auto n = parse_numbers(value, "--camera", 6, 7);
         camera_view camera{{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, n.size() == 7 ? n[6] : 40};
         if (camera.eye == camera.target) {
           throw usage_error("--camera has its eye on its target: move one of them");
         }
         if (!(camera.field_of_view >= 0.1 && camera.field_of_view <= 170)) {
           throw usage_error("--camera takes a field of view of 0.1 to 170 degrees, but not " +
                             shortest(camera.field_of_view));
         }
         o->camera = camera;
       });
  text("--receivers",
       "with a captured depth map: a plane at its deepest depth (the default), the map's own "
       "surface, a plane at a depth, or a second depth image",
       "plane|self|DEPTH|FILE", [o](const std::string& value) { o->receivers = value; });
  text("--channel", "which channel of an EXR or a colour PNG holds the depth", "NAME",
       [o](const std::string& value) { o->channel = value; });
  text("--depth-range", "the captured map's own numbers that mean 0 and 1", "NEAR,FAR",
       [o](const std::string& value) {
         const auto n = parse_numbers(value, "--depth-range", 2, 2);
         if (n[0] == n[1])
           throw usage_error("--depth-range takes two different depths, but not '" + value + "'");
         o->depth_range = {n[0], n[1]};
       });
  app.add_flag_callback(
         "--mask-invalid",
         [options] {
           options->given.insert("--mask-invalid");
           options->mask_invalid = true;
         },
         "take NaN, infinite and out-of-range depths as never drawn, instead of refusing them")
      ->group("Scene");
  add("--seed", "seed of whatever is random in the scene", "N",
      std::function([o](const std::string& seed) { o->seed = parse_seed(seed, "--seed"); }))
      ->default_str(std::to_string(o->seed));
  add("--threads", "threads to use, 0 for all cores (the result is the same)", "N",
      std::function([o](const int& count) {
        if (count < 0 || count > 4096) {
          throw usage_error("--threads takes 1 to 4096, or 0 for all cores, but not " +
                            std::to_string(count));
        }
        o->threads = count;
      }))
      ->default_str("0");
  return options;
}

frame load_for(const std::string& name, scene_options options,
               const std::vector<configuration>& cells) {
  for (const configuration& c : cells) {
    if (c.filtered.msaa == 1) continue;
    options.samples.insert(c.filtered.msaa);
    options.given.insert("--msaa");
  }
  return load_input(name, options);
}

std::string scene_argument_help() {
  std::string names;
  for (const auto& info : known_scenes()) names += info.name + ", ";
  return names + "a mesh (.obj, .glb), or a captured depth map (.exr, .png, .pfm, .npy)";
}

}  // namespace bitshade::command
