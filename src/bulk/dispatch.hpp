// Which instructions run, and on how many threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <thread>
#include <vector>

#include "bitshade/arithmetic/bulk.hpp"

namespace bitshade::bulk {

/// The set itself, or the widest that the processor has where `best` is asked for.
/// Failure  std::invalid_argument where the processor lacks it.
instruction_set resolve(instruction_set set);

/// Calls work(begin, n) for pieces that cover [0, size), on as many threads as are asked for and worth their start.
template <class F>
void in_chunks(std::size_t size, unsigned threads, F work) {
  constexpr std::size_t grain = std::size_t{1} << 14;
  const std::size_t workers = std::min<std::size_t>(std::max(1u, threads), (size + grain - 1) / grain);
  if (workers <= 1) return work(std::size_t{0}, size);
  // Whole cache lines, whatever the type.
  const std::size_t share = (size / workers + 63) / 64 * 64;
  std::vector<std::jthread> crew;
  crew.reserve(workers);
  for (std::size_t begin = 0; begin < size; begin += share) {
    crew.emplace_back([=] { work(begin, std::min(share, size - begin)); });
  }
}

}  // namespace bitshade::bulk
