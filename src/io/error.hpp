// How the command fails: two exceptions, two exit codes, one sentence each.
#pragma once

#include <stdexcept>
#include <string>

namespace bitshade {

/// The user asked for something that cannot be meant: exit status 2.
/// what() is one sentence that names the place and the cure.
struct usage_error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What was asked for could not be done: exit status 1.
/// what() is one sentence that names the file, the place and the cure.
struct failure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace bitshade
