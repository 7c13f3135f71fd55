#include "scene/isolated.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <exception>

#include "io/error.hpp"

namespace bitshade {
namespace {

constexpr std::uint8_t done = 'd', threw = 't';  // the first byte that the child sends

bool send(int fd, const std::uint8_t* data, std::size_t size) {
  while (size > 0) {
    const ssize_t count = ::write(fd, data, size);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    data += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

[[noreturn]] void be_child(int fd, const std::function<std::vector<std::uint8_t>()>& work,
                           unsigned seconds) {
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGINT, SIGTERM}) {
    ::signal(signal, SIG_DFL);  // the parent's handlers are not for us
  }
  const rlimit none{0, 0}, time{seconds, seconds};
  ::setrlimit(RLIMIT_CORE, &none);
  ::setrlimit(RLIMIT_CPU, &time);
  if (const int null = ::open("/dev/null", O_WRONLY); null >= 0) {
    ::dup2(null, STDOUT_FILENO);
    ::dup2(null, STDERR_FILENO);
  }
  bool sent = false;
  try {
    const auto bytes = work();
    sent = send(fd, &done, 1) && send(fd, bytes.data(), bytes.size());
  } catch (const std::exception& e) {
    sent = send(fd, &threw, 1) &&
           send(fd, reinterpret_cast<const std::uint8_t*>(e.what()), std::strlen(e.what()));
  } catch (...) {
  }
  ::_exit(sent ? 0 : 1);  // no destructors: what they would flush belongs to the parent
}

}  // namespace

isolated_result run_isolated(const std::function<std::vector<std::uint8_t>()>& work,
                             unsigned seconds) {
  const auto cannot = [] {
    return failure(std::string("cannot start a process to read the file in: ") +
                   std::strerror(errno) + "; close other programs");
  };
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) throw cannot();
  const pid_t child = ::fork();
  if (child < 0) {
    ::close(ends[0]);
    ::close(ends[1]);
    throw cannot();
  }
  if (child == 0) {
    ::close(ends[0]);
    be_child(ends[1], work, seconds);
  }
  ::close(ends[1]);
  isolated_result out;
  std::vector<std::uint8_t> buffer(1 << 16);
  bool first = true, failed = false;
  for (;;) {
    const ssize_t count = ::read(ends[0], buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    auto begin = buffer.begin();
    if (first) {
      failed = *begin++ == threw;
      first = false;
    }
    out.bytes.insert(out.bytes.end(), begin, buffer.begin() + count);
  }
  ::close(ends[0]);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  out.crashed = first || !WIFEXITED(status) || WEXITSTATUS(status) != 0;
  if (out.crashed || failed) {
    if (failed) out.error.assign(out.bytes.begin(), out.bytes.end());
    out.bytes.clear();
  }
  return out;
}

}  // namespace bitshade
