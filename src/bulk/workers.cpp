#include "bitshade/arithmetic/workers.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "bulk/pause.hpp"

namespace bitshade::bulk {

namespace {

/// Asks a question for some 20 microseconds; whether the answer was yes.
template <class Question>
bool spin_until(Question yes) {
  constexpr int tries = 1000;
  for (int i = 0; i < tries; ++i) {
    if (yes()) return true;
    pause();
  }
  return false;
}

}  // namespace

/// A call's pieces are claimed from one counter: whoever lowers it holds a piece, so that the call
/// cannot have ended and what it left here can be read. A thread that wakes late finds none.
struct workers::shared {
  alignas(64) std::atomic<unsigned> left = 0;
  alignas(64) std::atomic<unsigned> done = 0;
  alignas(64) std::atomic<std::uint32_t> calls = 0;  ///< counted up when there is something to do
  std::atomic<bool> stop = false;
  unsigned pieces = 0;
  void (*call)(const void*, unsigned) = nullptr;
  const void* work = nullptr;
  std::mutex failing;
  std::exception_ptr failed;
  std::vector<std::jthread> threads;  ///< last: the others outlive them

  void work_off() {
    for (unsigned n = left.load(std::memory_order_acquire); n > 0;) {
      if (!left.compare_exchange_weak(n, n - 1, std::memory_order_acq_rel)) continue;
      const unsigned all = pieces;
      try {
        call(work, all - n);
      } catch (...) {
        const std::scoped_lock lock(failing);
        if (!failed) failed = std::current_exception();
      }
      if (done.fetch_add(1, std::memory_order_acq_rel) + 1 == all) done.notify_one();
      n = left.load(std::memory_order_acquire);
    }
  }

  void serve() {
    for (;;) {
      const std::uint32_t seen = calls.load(std::memory_order_acquire);
      work_off();
      if (stop.load(std::memory_order_acquire)) return;
      const auto called = [&] { return calls.load(std::memory_order_acquire) != seen; };
      if (!spin_until(called)) calls.wait(seen, std::memory_order_acquire);
    }
  }

  void wake() {
    calls.fetch_add(1, std::memory_order_acq_rel);
    calls.notify_all();
  }

  ~shared() {
    stop.store(true, std::memory_order_release);
    wake();
  }
};

workers::workers(unsigned threads) : shared_(std::make_unique<shared>()) {
  for (unsigned k = 1; k < threads; ++k)
    shared_->threads.emplace_back([s = shared_.get()] { s->serve(); });
}

workers::~workers() = default;

unsigned workers::threads() const { return static_cast<unsigned>(shared_->threads.size()) + 1; }

void workers::run_all(unsigned pieces, void (*call)(const void*, unsigned), const void* work) {
  if (pieces == 0) return;
  shared& s = *shared_;
  s.pieces = pieces;
  s.call = call;
  s.work = work;
  s.done.store(0, std::memory_order_relaxed);
  s.left.store(pieces, std::memory_order_release);
  if (pieces > 1) s.wake();
  s.work_off();
  const auto ended = [&] { return s.done.load(std::memory_order_acquire) == pieces; };
  while (!ended()) {
    const unsigned before = s.done.load(std::memory_order_acquire);
    if (!spin_until(ended) && !ended() && before == s.done.load(std::memory_order_acquire))
      s.done.wait(before, std::memory_order_acquire);
  }
  if (s.failed) std::rethrow_exception(std::exchange(s.failed, nullptr));
}

}  // namespace bitshade::bulk
