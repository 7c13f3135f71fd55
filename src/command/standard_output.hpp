// Standard output that knows whether its reader still listens.
#pragma once

#include <array>
#include <iostream>
#include <streambuf>

namespace bitshade::command {

/// Puts itself behind std::cout for its lifetime and remembers why a write failed.
///
/// A reader that leaves early (`bitshade … | head`) is no error: the rest is dropped in silence and
/// the work goes on. A full device is one, and finish() says so. After either std::cout is bad, by
/// which a filter, whose only work is its output, knows that it may end.
class standard_output : public std::streambuf {
 public:
  standard_output();
  ~standard_output() override;
  standard_output(const standard_output&) = delete;
  standard_output& operator=(const standard_output&) = delete;

  /// Writes what is left. Throws `failure` where the text did not arrive, unless the reader left.
  void finish();

 protected:
  int_type overflow(int_type c) override;
  int sync() override;

 private:
  bool drain();

  std::array<char, 1 << 14> buffer_{};
  std::streambuf* previous_ = nullptr;
  int error_ = 0;
};

}  // namespace bitshade::command
