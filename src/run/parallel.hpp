// Rows on all cores. Rows are independent, so that any number of threads gives the same bits.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cfenv>
#include <chrono>
#include <cstddef>

namespace bitshade {

/// The default floating-point environment (nearest even, subnormals kept) for a scope: whatever
/// the caller or another library has set must not reach a result.
class default_float_environment {
 public:
  default_float_environment() {
    std::fegetenv(&saved_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~default_float_environment() { std::fesetenv(&saved_); }
  default_float_environment(const default_float_environment&) = delete;
  default_float_environment& operator=(const default_float_environment&) = delete;

 private:
  std::fenv_t saved_;
};

/// Calls work(first, last) for ranges that cover [0, count), on `threads` threads (0: all cores;
/// never more).
template <class Work>
void for_ranges(int threads, std::size_t count, std::size_t grain, Work work) {
  const int cores = tbb::info::default_concurrency();
  tbb::task_arena arena(threads > 0 ? std::min(threads, cores) : cores);
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain), [&](const auto& range) {
      const default_float_environment environment;
      work(range.begin(), range.end());
    });
  });
}

/// Calls work(y) for each row.
template <class Work>
void for_rows(int threads, int rows, Work work) {
  for_ranges(threads, static_cast<std::size_t>(rows), 8, [&](std::size_t first, std::size_t last) {
    for (std::size_t y = first; y < last; ++y) work(static_cast<int>(y));
  });
}

/// Adds the seconds of its own life to a sum.
class stopwatch {
 public:
  explicit stopwatch(double& seconds) : seconds_(seconds) {}
  ~stopwatch() {
    seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  stopwatch(const stopwatch&) = delete;
  stopwatch& operator=(const stopwatch&) = delete;

 private:
  double& seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace bitshade
