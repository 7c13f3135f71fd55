// What a thread does while it asks again and again.
#pragma once

#if defined(__SSE2__)
#include <emmintrin.h>
#else
#include <thread>
#endif

namespace bitshade::bulk {

inline void pause() {
#if defined(__SSE2__)
  _mm_pause();
#else
  std::this_thread::yield();
#endif
}

}  // namespace bitshade::bulk
