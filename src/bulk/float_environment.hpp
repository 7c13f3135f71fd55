// The floating-point environment that every kernel runs in, and the caller's put back afterwards.
#pragma once

#include <cfenv>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace bitshade::bulk {

/// One rounding direction, subnormals kept, no traps; the destructor restores what was there. Exception flags may be
/// left raised, as any arithmetic leaves them.
class float_environment {
 public:
  enum class direction { nearest, down, up, toward_zero };  ///< in the order of MXCSR's field

  explicit float_environment(direction d) {
#if defined(__SSE2__)
    constexpr unsigned all_masked = 0x1f80, direction_field = 0x2000;
    const unsigned wanted = all_masked | direction_field * static_cast<unsigned>(d);
    saved_ = _mm_getcsr();
    // Writing the register stalls, and most callers have the wanted settings already.
    changed_ = (saved_ & ~flags) != wanted;
    if (changed_) _mm_setcsr(wanted);
#else
    std::feholdexcept(&saved_);
    constexpr int directions[] = {FE_TONEAREST, FE_DOWNWARD, FE_UPWARD, FE_TOWARDZERO};
    std::fesetround(directions[static_cast<int>(d)]);
#endif
  }
  ~float_environment() {
#if defined(__SSE2__)
    if (changed_) _mm_setcsr(saved_);
#else
    std::fesetenv(&saved_);
#endif
  }
  float_environment(const float_environment&) = delete;
  float_environment& operator=(const float_environment&) = delete;

 private:
#if defined(__SSE2__)
  static constexpr unsigned flags = 0x3f;
  unsigned saved_;
  bool changed_;
#else
  std::fenv_t saved_;
#endif
};

}  // namespace bitshade::bulk
