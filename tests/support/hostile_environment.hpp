// The floating-point environment of a caller who means no good, for hard case 42.
#pragma once

#include <cfenv>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace hostile {

inline constexpr int directions[] = {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};

/// For its lifetime: another rounding direction, results flushed to zero, subnormal operands read as zero.
class environment {
 public:
  explicit environment(int direction) {
    std::fegetenv(&saved_);
    std::fesetround(direction);
#if defined(__SSE2__)
    _mm_setcsr(_mm_getcsr() | 0x8040);
#endif
    state_ = state();
  }
  ~environment() { std::fesetenv(&saved_); }
  environment(const environment&) = delete;
  environment& operator=(const environment&) = delete;

  /// Whether all is as the caller set it; exception flags may be raised.
  bool is_kept() const { return state() == state_; }

 private:
  static unsigned state() {
    unsigned all = static_cast<unsigned>(std::fegetround()) << 16;
#if defined(__SSE2__)
    constexpr unsigned exception_flags = 0x3f;
    all |= _mm_getcsr() & 0xffff & ~exception_flags;
#endif
    return all;
  }
  std::fenv_t saved_;
  unsigned state_ = 0;
};

/// Whether work() leaves every hostile environment as it is; what it computes there is for the caller to compare.
template <class Work>
bool keeps_environment(int direction, Work work) {
  const environment caller(direction);
  work();
  return caller.is_kept();
}

}  // namespace hostile
