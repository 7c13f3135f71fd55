// A plot as a file of its own: the same SVG with the colours in it, on white.
#pragma once

#include <string>

#include "report/plot.hpp"

namespace bitshade {

/// `p` as an SVG document that needs no page around it.
std::string svg_file(const plot& p);

}  // namespace bitshade
