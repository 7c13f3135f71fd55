// Work that may crash, done in a process of its own.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace bitshade {

/// What `work` returned, or why there is nothing.
struct isolated_result {
  std::vector<std::uint8_t> bytes;
  std::string error;     ///< what() of the exception that left `work`
  bool crashed = false;  ///< the process died, or used more than `seconds` of processor time
};

/// Runs `work` in a child process and brings its bytes back.
///
/// For other people's parsers of hostile files: a memory error there costs the child alone. The
/// child prints nothing and leaves no core file. Failure  throws failure if no child can be
/// started.
isolated_result run_isolated(const std::function<std::vector<std::uint8_t>()>& work,
                             unsigned seconds);

}  // namespace bitshade
