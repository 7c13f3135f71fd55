// The plots of one input.
#pragma once

#include <string>

#include "report/html.hpp"

namespace bitshade {

/// All plots of a section as <figure>s with captions and commands; those without data are left out.
std::string plots_of(const report_section& section);

/// The figure with two pictures under a slider.
std::string slider_of(const report_section& section);

/// A <figure>: what is seen (an svg() of plot.hpp, an <img> of a data_uri), and its caption().
std::string figure(const std::string& inside, const std::string& caption_text);

/// A picture inside the page.
std::string data_uri(const std::string& png);

/// A caption with the command that reproduces the figure.
std::string caption(const std::string& title, const std::string& text, const std::string& command);

}  // namespace bitshade
