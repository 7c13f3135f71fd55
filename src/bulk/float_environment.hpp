// The floating-point environment that every kernel runs in, and the caller's put back afterwards.
#pragma once

#include <cfenv>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace bitshade::bulk {

/// To nearest or toward zero, subnormals kept, no traps; the destructor restores what was there, flags included.
class float_environment {
 public:
  enum class direction { nearest, toward_zero };

  explicit float_environment(direction d) {
#if defined(__SSE2__)
    constexpr unsigned all_masked = 0x1f80, toward_zero = 0x6000;
    saved_ = _mm_getcsr();
    _mm_setcsr(all_masked | (d == direction::toward_zero ? toward_zero : 0));
#else
    std::feholdexcept(&saved_);
    std::fesetround(d == direction::toward_zero ? FE_TOWARDZERO : FE_TONEAREST);
#endif
  }
  ~float_environment() {
#if defined(__SSE2__)
    _mm_setcsr(saved_);
#else
    std::fesetenv(&saved_);
#endif
  }
  float_environment(const float_environment&) = delete;
  float_environment& operator=(const float_environment&) = delete;

 private:
#if defined(__SSE2__)
  unsigned saved_;
#else
  std::fenv_t saved_;
#endif
};

}  // namespace bitshade::bulk
