// Sizes that make no sense are refused before anything is allocated.
#pragma once

#include <cstddef>
#include <cstdint>

#include "scene/scene.hpp"

namespace bitshade {

/// Bytes that this process can have: the machine's memory, or less where a control group says so.
std::uint64_t memory_limit();

/// Checks map and view against 1 to 65,536 and, with a scene of `triangles`, against the memory.
///
/// Failure  usage_error with the option, what it would take, and what there is.
void check_sizes(const scene_options& options, std::size_t triangles);

/// The same for one allocation of `bytes`, called `what` in the message.
void check_memory(std::uint64_t bytes, const std::string& what, const std::string& cure);

}  // namespace bitshade
