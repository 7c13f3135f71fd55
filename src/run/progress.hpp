// A progress bar with the time left, on a terminal and nowhere else.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace bitshade {

/// Draws on standard error while it is a terminal; silent when piped.
class progress {
 public:
  explicit progress(bool wanted = true);
  ~progress();
  progress(const progress&) = delete;
  progress& operator=(const progress&) = delete;

  void begin(std::size_t steps);
  /// What is being worked on now.
  void at(const std::string& label);
  /// One step done; `worked` is false for steps that cost nothing (already in the database).
  void step(bool worked);
  /// Takes the bar away.
  void end();

 private:
  void draw();

  bool shown_ = false;
  std::size_t steps_ = 0, done_ = 0, worked_ = 0;
  std::string label_;
  std::chrono::steady_clock::time_point start_;
};

/// "9 s", "2:05 min" or "1:02:03 h".
std::string duration(double seconds);

}  // namespace bitshade
