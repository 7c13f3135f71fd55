// Names for configurations that tell each from the others shown with it.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "run/row.hpp"

namespace bitshade {

/// For each row the settings by which it differs from rows of the same technique, layers and
/// format: "overlap 0.02, min-variance 1e-06"; empty where these three suffice.
std::vector<std::string> settings_of(std::span<const row> rows);

/// label_of() each row, with its settings where they are needed.
std::vector<std::string> distinct_labels(std::span<const row> rows);

/// The `limit` rows of least total error, in their order; all where there are no more.
std::vector<row> telling_rows(std::span<const row> rows, std::size_t limit);

/// A configuration's text without its format: equal for cells that share their exact reference.
std::string method_of(const row& r);

/// The order in which joined results are shown, whatever order they were computed in: technique,
/// layers, settings, format.
bool shown_before(const row& a, const row& b);

}  // namespace bitshade
