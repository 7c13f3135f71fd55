// The options that say how a shadow map is filtered, before shading and while it is read.
#pragma once

#include <string>

#include "bitshade/study/configuration.hpp"

namespace CLI {
class App;
}

namespace bitshade::command {

/// Adds --msaa, --blur and its finer options, --lookups, --filter, --anisotropy and
/// --smallest-box, which write to
/// `how`; its values are the defaults in the help. `how` must outlive the application.
void add_filter_options(CLI::App& app, configuration& how, const std::string& group);

}  // namespace bitshade::command
