// The finer options of techniques: layers, Lloyd relaxation, light bleeding, comparators.
#pragma once

#include "bitshade/study/configuration.hpp"

namespace CLI {
class App;
}

namespace bitshade::command {

/// Adds --transition, --lookup, --layer-warp, --direct-index, --one-pass and --min-width.
void add_layer_options(CLI::App& app, configuration& c);

/// Adds --bleeding-*, the exponents, --terms and what concerns four moments.
void add_technique_options(CLI::App& app, configuration& c);

/// Adds --lloyd-*, every choice of Lloyd relaxation.
void add_lloyd_options(CLI::App& app, lloyd_choices& c);

}  // namespace bitshade::command
