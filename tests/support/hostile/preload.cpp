// Loaded before a program (LD_PRELOAD), it hands it the floating-point environment of hard case 42.
#include <cfenv>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace {

[[gnu::constructor]] void spoil() {
  std::fesetround(FE_UPWARD);
#if defined(__SSE2__)
  _mm_setcsr(_mm_getcsr() | 0x8040);  // flush to zero, denormals are zero
#endif
}

}  // namespace
