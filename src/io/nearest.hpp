// "Did you mean …?": the nearest known name to one that nobody knows.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace bitshade {

/// Number of single-character edits (insert, delete, replace, swap of neighbours) between two
/// words.
int edit_distance(std::string_view a, std::string_view b);

/// The candidate nearest to `word`, or nothing where none is near enough to be meant
/// (more than a third of the longer word's letters, at least two, would have to change).
std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates);

/// The end of an error sentence about an unknown name:
/// "did you mean 'half'?", or else "known are a, b and c".
std::string suggest(std::string_view word, std::span<const std::string_view> candidates);

}  // namespace bitshade
