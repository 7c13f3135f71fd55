#include "io/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <string>

#include "io/error.hpp"

namespace bitshade {
namespace {

std::string cure(int error) {
  switch (error) {
    case ENOSPC:
    case EDQUOT:
      return "free some space or choose another place with --out";
    case EACCES:
    case EPERM:
    case EROFS:
      return "choose a place with --out that you may write to";
    case ENOENT:
      return "create the folder first or choose another place with --out";
    case ENOTDIR:
      return "a part of the path is a file: choose another place with --out";
    case EISDIR:
      return "it is a folder: name a file with --out";
    default:
      return "choose another place with --out";
  }
}

[[noreturn]] void cannot_write(const std::filesystem::path& path, int error) {
  throw failure("cannot write " + path.string() + ": " + std::strerror(error) + "; " + cure(error));
}

/// A file descriptor, and the name to remove unless keep() was called.
class part_file {
 public:
  part_file(std::filesystem::path name, int flags, bool temporary)
      : name_(std::move(name)), temporary_(temporary), fd_(::open(name_.c_str(), flags, 0666)) {}
  part_file(const part_file&) = delete;
  part_file& operator=(const part_file&) = delete;
  ~part_file() {
    if (fd_ >= 0) ::close(fd_);
    if (temporary_) ::unlink(name_.c_str());
  }
  bool is_open() const { return fd_ >= 0; }
  const std::filesystem::path& name() const { return name_; }
  void keep() { temporary_ = false; }

  /// 0, or the errno of the first write that failed.
  int write(std::span<const std::uint8_t> bytes) const {
    while (!bytes.empty()) {
      const ssize_t count = ::write(fd_, bytes.data(), bytes.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) return errno;
      bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
    return 0;
  }
  /// Some file systems report a full disk only here.
  int close() {
    const int result = ::close(fd_);
    fd_ = -1;
    return result == 0 ? 0 : errno;
  }

 private:
  std::filesystem::path name_;
  bool temporary_;
  int fd_;
};

/// The file that a chain of links ends in, so that a rename does not replace the link.
std::filesystem::path target_of(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_symlink(path, ignored)) return path;
  auto target = std::filesystem::weakly_canonical(path, ignored);
  return ignored ? path : target;
}

}  // namespace

void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes) {
  const std::filesystem::path target = target_of(path);
  struct stat status {};
  const bool exists = ::stat(target.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) cannot_write(path, EISDIR);
  if (exists && !S_ISREG(status.st_mode)) {
    const part_file device(target, O_WRONLY | O_CLOEXEC, false);
    if (!device.is_open()) cannot_write(path, errno);
    if (const int error = device.write(bytes)) cannot_write(path, error);
    return;
  }
  // A name of our own beside the target: the same file system, and no clash between threads.
  static std::atomic<unsigned> serial{0};
  std::string aside(".");
  aside.append(target.filename().string()).append(".").append(std::to_string(::getpid()));
  aside.append(".").append(std::to_string(serial++)).append(".part");
  part_file part(target.parent_path() / aside, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, true);
  if (!part.is_open()) {
    const int error = errno;
    part.keep();  // not ours: whatever has this name stays
    cannot_write(path, error);
  }
  if (const int error = part.write(bytes)) cannot_write(path, error);
  if (const int error = part.close()) cannot_write(path, error);
  if (::rename(part.name().c_str(), target.c_str()) != 0) cannot_write(path, errno);
  part.keep();
}

void write_file(const std::filesystem::path& path, std::string_view text) {
  write_file(path, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

void make_output_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) cannot_write(folder, error.value());
  if (!std::filesystem::is_directory(folder, error)) cannot_write(folder, ENOTDIR);
  // access() does not see a full disk or a read-only mount as a write does: try one.
  const auto probe = folder / (".bitshade." + std::to_string(::getpid()) + ".probe");
  const part_file file(probe, O_WRONLY | O_CREAT | O_CLOEXEC, true);
  if (!file.is_open()) cannot_write(folder, errno);
  const std::uint8_t byte[1] = {0};
  if (const int failed = file.write(byte)) cannot_write(folder, failed);
}

std::vector<std::uint8_t> read_file(const std::filesystem::path& path, std::uintmax_t limit) {
  const auto refuse = [&](const std::string& why) -> failure {
    return failure("cannot read " + path.string() + ": " + why);
  };
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) {
    throw refuse(std::string(std::strerror(errno)) +
                 (errno == ENOENT ? "; check the name" : "; check its permissions"));
  }
  struct closer {
    int fd;
    ~closer() { ::close(fd); }
  } const closing{fd};
  struct stat status {};
  if (::fstat(fd, &status) != 0) throw refuse(std::strerror(errno));
  if (S_ISDIR(status.st_mode)) throw refuse("it is a folder; name a file in it");
  if (S_ISREG(status.st_mode) && static_cast<std::uintmax_t>(status.st_size) > limit) {
    throw refuse("it has " + std::to_string(status.st_size) + " bytes, more than the " +
                 std::to_string(limit) + " that can be read; use a smaller file");
  }
  // What is no regular file does not say how long it is, and may never end.
  if (!S_ISREG(status.st_mode)) limit = std::min(limit, std::uintmax_t{1} << 28);
  std::vector<std::uint8_t> bytes;
  bytes.resize(S_ISREG(status.st_mode) ? static_cast<std::size_t>(status.st_size) + 1 : 1 << 16);
  std::size_t filled = 0;
  for (;;) {
    if (filled == bytes.size()) bytes.resize(bytes.size() * 2);
    const ssize_t count = ::read(fd, bytes.data() + filled, bytes.size() - filled);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw refuse(std::strerror(errno));
    if (count == 0) break;
    filled += static_cast<std::size_t>(count);
    if (filled > limit) throw refuse("it never ends, or is too long for what is no regular file; name one");
  }
  if (filled == 0) throw refuse("it is empty; write it again");
  bytes.resize(filled);
  return bytes;
}

}  // namespace bitshade
