// Threads that wait for work between calls. Compiled: link bitshade::bulk.
#pragma once

#include <memory>

namespace bitshade::bulk {

/// Threads started once and kept: to start one takes as long as a short pass over an image.
///
/// A caller makes them, and hands them to each call by execution::crew.
///
/// Shapes   `threads` work at once, the caller's own among them; 0 counts as 1.
/// Policy   after a call they ask for more for some 20 microseconds, then sleep. One call at a time.
/// Failure  std::system_error where the system has no thread left.
class workers {
 public:
  explicit workers(unsigned threads);
  ~workers();
  workers(const workers&) = delete;
  workers& operator=(const workers&) = delete;

  unsigned threads() const;

  /// work(k) for k = 0 .. pieces - 1, begun in this order, each by one of the threads; returns when
  /// all are done.
  ///
  /// Failure  rethrows the first exception of a piece, after the others have ended.
  template <class F>
  void run(unsigned pieces, const F& work) {
    run_all(pieces, [](const void* f, unsigned k) { (*static_cast<const F*>(f))(k); }, &work);
  }

 private:
  void run_all(unsigned pieces, void (*call)(const void*, unsigned), const void* work);

  struct shared;
  std::unique_ptr<shared> shared_;
};

}  // namespace bitshade::bulk
