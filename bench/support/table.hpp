// Benchmarks as a table of ratios: what is timed in one run is compared in one run.
#pragma once

#include <benchmark/benchmark.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace bench {

/// One line of the table. Work is checked before it is timed: `check` returns an empty text, or what is wrong.
struct row {
  std::string group;
  std::string name;
  std::size_t elements = 1;             ///< the time is divided by this
  std::function<void()> work;
  std::function<std::string()> check;   ///< may be empty: a limit (copy) has no result of its own
  std::string base;                     ///< name of the row in the same group to divide by
  double limit = 0;                     ///< largest ratio that is wanted; 0: none is
  std::string beside = {};              ///< a row of the group whose own ratio the limit is relative to
  bool cold = false;                    ///< before every run of `work` the caches are filled with something else
};

class table {
 public:
  void add(row r) { rows_.push_back(std::move(r)); }

  /// Checks every row, times them all in interleaved repetitions, prints the minimum of each and its ratio.
  /// Returns main's exit status: 1 where a check failed, 2 where BENCH_STRICT is asked for and a limit is passed.
  int run(int argc, char** argv);

 private:
  std::vector<row> rows_;
};

}  // namespace bench
