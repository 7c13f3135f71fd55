// Which instructions run, and on how many threads.
#pragma once

#include <algorithm>
#include <cstddef>

#include "bitshade/arithmetic/bulk.hpp"
#include "bitshade/arithmetic/workers.hpp"

namespace bitshade::bulk {

/// The set itself, or the widest that the processor has where `best` is asked for.
/// Failure  std::invalid_argument where the processor lacks it.
instruction_set resolve(instruction_set set);

/// How many threads may work at once.
inline unsigned threads_of(const execution& how) {
  return how.crew != nullptr ? how.crew->threads() : std::max(1u, how.threads);
}

/// work(k) for k = 0 .. pieces - 1, begun in this order: on the threads at hand, or on new ones.
template <class F>
void in_pieces(const execution& how, std::size_t pieces, const F& work) {
  const auto count = static_cast<unsigned>(pieces);
  const unsigned threads = std::min(threads_of(how), count);
  if (threads <= 1) {
    for (unsigned k = 0; k < count; ++k) work(k);
  } else if (how.crew != nullptr) {
    how.crew->run(count, work);
  } else {
    workers(threads).run(count, work);
  }
}

/// Calls work(begin, n) for pieces that cover [0, size), on as many threads as are asked for and worth their start.
template <class F>
void in_chunks(std::size_t size, const execution& how, F work) {
  constexpr std::size_t grain = std::size_t{1} << 14;
  const std::size_t threads = std::min<std::size_t>(threads_of(how), (size + grain - 1) / grain);
  if (threads <= 1) return work(std::size_t{0}, size);
  // Whole cache lines, whatever the type.
  const std::size_t share = (size / threads + 63) / 64 * 64;
  in_pieces(how, (size + share - 1) / share, [&](std::size_t k) {
    work(k * share, std::min(share, size - k * share));
  });
}

}  // namespace bitshade::bulk
