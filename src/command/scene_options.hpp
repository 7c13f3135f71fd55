// The options that every command with a SCENE shares.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bitshade/study/configuration.hpp"
#include "scene/scene.hpp"

namespace CLI {
class App;
}

namespace bitshade::command {

/// Adds --size, --view, --param, --light, --light-position, --light-to, --light-range, --camera,
/// --metric, --receivers, --channel, --depth-range, --mask-invalid, --seed and --threads to `app`.
///
/// The options returned are filled while the arguments are parsed: read them in app's callback.
/// Failure  values that make no sense throw usage_error there.
std::shared_ptr<scene_options> add_scene_options(CLI::App& app);

/// load_input(), with the samples of a texel that configurations ask for.
frame load_for(const std::string& name, scene_options options,
               const std::vector<configuration>& cells);

/// The text for a SCENE argument's help: the embedded scenes and the file types.
std::string scene_argument_help();

}  // namespace bitshade::command
