#include "run/progress.hpp"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "io/text.hpp"

namespace bitshade {
namespace {

std::string two_digits(long n) { return (n < 10 ? "0" : "") + std::to_string(n); }

}  // namespace

std::string duration(double seconds) {
  const long s = static_cast<long>(seconds + 0.5);
  if (s < 60) return std::to_string(s) + " s";
  if (s < 3600) return std::to_string(s / 60) + ":" + two_digits(s % 60) + " min";
  return std::to_string(s / 3600) + ":" + two_digits(s / 60 % 60) + ":" + two_digits(s % 60) + " h";
}

progress::progress(bool wanted) {
  const char* terminal = std::getenv("TERM");
  shown_ = wanted && isatty(STDERR_FILENO) != 0 &&
           (terminal == nullptr || std::string_view(terminal) != "dumb");
}

progress::~progress() { end(); }

void progress::begin(std::size_t steps) {
  steps_ = steps;
  done_ = worked_ = 0;
  start_ = std::chrono::steady_clock::now();
}

void progress::at(const std::string& label) {
  label_ = label;
  draw();
}

void progress::step(bool worked) {
  ++done_;
  worked_ += worked;
  draw();
}

void progress::end() {
  if (shown_ && steps_ != 0) std::fputs("\r\x1b[K", stderr);
  steps_ = 0;
}

void progress::draw() {
  if (!shown_ || steps_ == 0) return;
  constexpr std::size_t width = 24;
  const std::size_t filled = done_ * width / steps_;
  std::string line = "[" + std::string(filled, '#') + std::string(width - filled, '.') + "] " +
                     std::to_string(done_) + "/" + std::to_string(steps_);
  if (worked_ > 0 && done_ < steps_) {
    const double spent =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    line += ", " +
            duration(spent / static_cast<double>(worked_) * static_cast<double>(steps_ - done_)) +
            " left";
  }
  line += "  " + label_;
  if (columns(line) > 79) line.resize(79);
  std::fputs(("\r\x1b[K" + line).c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace bitshade
