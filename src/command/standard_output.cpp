#include "command/standard_output.hpp"

#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <string>

#include "io/error.hpp"

namespace bitshade::command {

standard_output::standard_output() {
  std::signal(SIGPIPE, SIG_IGN);  // a reader that leaves must not end a study
  setp(buffer_.data(), buffer_.data() + buffer_.size());
  previous_ = std::cout.rdbuf(this);
}

standard_output::~standard_output() {
  drain();
  std::cout.rdbuf(previous_);
}

void standard_output::finish() {
  drain();
  if (error_ != 0 && error_ != EPIPE)
    throw failure(std::string("standard output: ") + std::strerror(error_) +
                  "; send the output somewhere with room");
}

standard_output::int_type standard_output::overflow(int_type c) {
  if (!drain()) return traits_type::eof();
  if (!traits_type::eq_int_type(c, traits_type::eof())) {
    *pptr() = traits_type::to_char_type(c);
    pbump(1);
  }
  return traits_type::not_eof(c);
}

int standard_output::sync() {
  return drain() ? 0 : -1;
}

bool standard_output::drain() {
  const char* from = pbase();
  while (error_ == 0 && from != pptr()) {
    const ssize_t n = ::write(STDOUT_FILENO, from, static_cast<std::size_t>(pptr() - from));
    if (n >= 0)
      from += n;
    else if (errno != EINTR)
      error_ = errno;
  }
  setp(buffer_.data(), buffer_.data() + buffer_.size());
  return error_ == 0;
}

}  // namespace bitshade::command
