// bitshade depth: what a light sees of a scene, as a file that any tool can read, this one
// included.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <limits>
#include <nlohmann/json.hpp>

#include "command/commands.hpp"
#include "command/scene_options.hpp"
#include "io/depth_file.hpp"
#include "io/error.hpp"
#include "io/text.hpp"

namespace bitshade::command {
namespace {

struct depth_arguments {
  std::string scene;
  std::string out;
  std::string receivers_out;
  bool list = false;
  bool json = false;
};

void list_scenes(bool json) {
  if (json) {
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    for (const auto& info : known_scenes()) {
      nlohmann::ordered_json parameters = nlohmann::ordered_json::array();
      for (const auto& p : info.parameters) {
        parameters.push_back({{"name", p.name},
                              {"meaning", p.meaning},
                              {"default", p.initial},
                              {"low", p.low},
                              {"high", p.high},
                              {"whole", p.whole}});
      }
      all.push_back({{"name", info.name}, {"meaning", info.meaning}, {"parameters", parameters}});
    }
    std::cout << all.dump(2) << '\n';
    return;
  }
  for (const auto& info : known_scenes()) {
    std::cout << info.name << ": " << info.meaning << '\n';
    for (const auto& p : info.parameters) {
      std::cout << "  " << pad_right(p.name + "=" + shortest(p.initial), 18) << "  "
                << pad_right(shortest(p.low) + " to " + shortest(p.high), 14) << "  " << p.meaning
                << '\n';
    }
  }
}

/// The receivers' depths as a picture; 1 where there is none.
image<float> receiver_depths(const frame& f) {
  image<float> out(f.view_width, f.view_height, 1, 1.0f);
  for (std::size_t i = 0; i < out.texels.size(); ++i) {
    if (f.receivers[i].surface != 0) out.texels[i] = f.receivers[i].t;
  }
  return out;
}

void write_depth(const depth_arguments& given, const scene_options& options) {
  if (given.scene.empty()) throw usage_error("name a SCENE, or --list to see the embedded ones");
  if (given.out.empty())
    throw usage_error("--out is missing: name a .exr, .png, .pfm or .npy file");
  for (const auto& path : {given.out, given.receivers_out}) {
    if (!path.empty() && !is_depth_file(path)) {
      throw usage_error("depth maps are .exr, .png, .pfm or .npy files, but " + path +
                        " is none: give it one of these endings");
    }
  }
  const frame f = load_input(given.scene, options);
  write_depths(given.out, f.depth);
  if (!given.receivers_out.empty()) write_depths(given.receivers_out, receiver_depths(f));

  float low = 1, high = 0;
  std::size_t drawn = 0;
  for (const float d : f.depth.texels) {
    if (d >= 1) continue;
    ++drawn;
    low = std::min(low, d);
    high = std::max(high, d);
  }
  const auto receivers = static_cast<std::size_t>(std::count_if(
      f.receivers.begin(), f.receivers.end(), [](const auto& r) { return r.surface != 0; }));
  if (given.json) {
    nlohmann::ordered_json out{{"scene", f.name},
                               {"file", given.out},
                               {"width", f.depth.width},
                               {"height", f.depth.height},
                               {"texels_below_1", drawn},
                               {"receivers", receivers},
                               {"pixels", f.receivers.size()}};
    if (drawn > 0) {
      out["nearest"] = low;
      out["farthest"] = high;
    }
    std::cout << out.dump(2) << '\n';
    return;
  }
  std::cout << given.out << ": " << f.depth.width << " x " << f.depth.height << " texels, " << drawn
            << " below depth 1";
  if (drawn > 0) std::cout << ", from " << brief(low, 6) << " to " << brief(high, 6);
  std::cout << "; " << receivers << " of " << f.receivers.size() << " pixels are receivers\n";
}

}  // namespace

void add_depth(CLI::App& app) {
  CLI::App* const depth =
      app.add_subcommand("depth", "Write a light's depth map of a scene to a file");
  const auto given = std::make_shared<depth_arguments>();
  depth->add_option("SCENE", given->scene, scene_argument_help());
  depth->add_option("--out", given->out, "depth map to write: .exr, .png (16 bits), .pfm or .npy")
      ->type_name("FILE");
  depth
      ->add_option("--receivers-out", given->receivers_out,
                   "also write the picture's receiver depths, 1 where there is none")
      ->type_name("FILE");
  depth->add_flag("--list", given->list, "list the embedded scenes and their parameters");
  depth->add_flag("--json", given->json, "print JSON");
  const auto options = add_scene_options(*depth);
  depth->callback([given, options] {
    if (given->list) {
      list_scenes(given->json);
    } else {
      write_depth(*given, *options);
    }
  });
}

}  // namespace bitshade::command
