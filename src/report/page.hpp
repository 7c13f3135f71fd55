// The parts of report.html that no study changes.
#pragma once

#include <string_view>

namespace bitshade {

std::string_view page_style();
std::string_view page_script();

}  // namespace bitshade
