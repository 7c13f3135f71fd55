// What a verification prints: a line for each comparison, with everything needed to repeat it.
#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace verify {

/// How many results were compared, how many differed, and the first that did.
struct tally {
  std::uint64_t seen = 0, wrong = 0;
  char first[160] = "";

  /// `format` and what follows describe the difference, as printf takes them.
  template <class... Values>
  void expect(bool equal, const char* format, Values... values) {
    ++seen;
    if (equal || wrong++ != 0) return;
    std::snprintf(first, sizeof first, format, values...);
  }
};

/// Prints what a comparison found, and remembers whether all were right.
class report {
 public:
  void line(const std::string& what, const tally& t) {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - since_).count();
    since_ = now;
    std::printf("%-52s %14llu  %llu wrong  %7.1f s\n", what.c_str(), static_cast<unsigned long long>(t.seen),
                static_cast<unsigned long long>(t.wrong), seconds);
    if (t.wrong != 0) std::printf("  the first: %s\n", t.first);
    std::fflush(stdout);
    failed_ = failed_ || t.wrong != 0 || t.seen == 0;
  }
  int status() const { return failed_ ? 1 : 0; }

 private:
  std::chrono::steady_clock::time_point since_ = std::chrono::steady_clock::now();
  bool failed_ = false;
};

/// The number after `--every`: 1, the default, takes all inputs. 0 where the command line is another.
inline std::uint64_t every(int argc, char* argv[]) {
  if (argc == 1) return 1;
  if (argc == 3 && std::strcmp(argv[1], "--every") == 0) return std::strtoull(argv[2], nullptr, 10);
  return 0;
}

/// What ctest takes for "not here".
constexpr int skipped = 77;

}  // namespace verify
