// The caller's floating-point environment, put aside and given back.
#pragma once

#include <cfenv>

namespace bitshade {

/// For its lifetime rounding is to nearest, and subnormal numbers are neither flushed nor read as zeros.
///
/// encode, decode, operations.hpp and the elementary functions are integers and need none of this; the operators of
/// `real` that go through their carrier do, where the caller may have changed the environment.
class default_environment {
 public:
  default_environment() {
    std::fegetenv(&saved_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~default_environment() { std::fesetenv(&saved_); }
  default_environment(const default_environment&) = delete;
  default_environment& operator=(const default_environment&) = delete;

 private:
  std::fenv_t saved_;
};

}  // namespace bitshade
