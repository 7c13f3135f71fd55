#include "io/atomic_file.hpp"

#include <sys/resource.h>

#include <csignal>
#include <iterator>
#include <string>

#include "io/error.hpp"
#include "support/catch.hpp"
#include "support/refusals.hpp"
#include "support/temporary_folder.hpp"

namespace {

using bitshade::failure;
using bitshade::read_file;
using bitshade::write_file;

std::string text_of(const std::filesystem::path& path) {
  const auto bytes = read_file(path);
  return {bytes.begin(), bytes.end()};
}

auto entries(const std::filesystem::path& folder) {
  return std::distance(std::filesystem::directory_iterator(folder), {});
}

}  // namespace

TEST_CASE("a file is written whole and replaces what was there") {
  const temporary_folder folder;
  write_file(folder / "a.txt", "first");
  CHECK(text_of(folder / "a.txt") == "first");
  write_file(folder / "a.txt", "second, longer");
  CHECK(text_of(folder / "a.txt") == "second, longer");
  CHECK(entries(folder.path()) == 1);
}

TEST_CASE("a link is followed, not replaced") {
  const temporary_folder folder;
  write_file(folder / "real", "old");
  std::filesystem::create_symlink("real", folder / "link");
  write_file(folder / "link", "new");
  CHECK(std::filesystem::is_symlink(folder / "link"));
  CHECK(text_of(folder / "real") == "new");
}

TEST_CASE("a failed write leaves the old file and nothing else") {
  const temporary_folder folder;
  write_file(folder / "a.txt", "old");
  // A limit on the size of files stands in for a full disk.
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = before;
  small.rlim_cur = 1000;
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string text =
      message_of([&] { write_file(folder / "a.txt", std::string(5000, 'x')); });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  CHECK(text.find("cannot write") != std::string::npos);
  CHECK(text.find("a.txt") != std::string::npos);
  CHECK(text_of(folder / "a.txt") == "old");
  CHECK(entries(folder.path()) == 1);
}

TEST_CASE("where nothing can be written, the sentence names the place and the cure") {
  const temporary_folder folder;
  CHECK(message_of([&] { write_file(folder / "no/such/a", "x"); }).find("create the folder") !=
        std::string::npos);
  CHECK(message_of([&] { write_file(folder.path(), "x"); }).find("it is a folder") !=
        std::string::npos);
  CHECK(message_of([] { write_file("/dev/full", "x"); }).find("free some space") !=
        std::string::npos);
  write_file(folder / "file", "x");
  CHECK(message_of([&] {
          bitshade::make_output_folder(folder / "file/sub");
        }).find("choose another place") != std::string::npos);
  CHECK(message_of([] { bitshade::make_output_folder("/proc/bitshade"); }).find("cannot write") !=
        std::string::npos);
}

TEST_CASE("an output folder is made with its parents and left empty") {
  const temporary_folder folder;
  bitshade::make_output_folder(folder / "a/b");
  CHECK(std::filesystem::is_directory(folder / "a/b"));
  CHECK(entries(folder / "a/b") == 0);
}

TEST_CASE("what cannot be read says why") {
  const temporary_folder folder;
  CHECK(message_of([&] { read_file(folder / "none"); }).find("check the name") !=
        std::string::npos);
  CHECK(message_of([&] { read_file(folder.path()); }).find("a folder") != std::string::npos);
  write_file(folder / "empty", "");
  CHECK(message_of([&] { read_file(folder / "empty"); }).find("it is empty") != std::string::npos);
  write_file(folder / "big", std::string(100, 'x'));
  CHECK(message_of([&] { read_file(folder / "big", 99); }).find("100 bytes") != std::string::npos);
  CHECK(message_of([] { read_file("/dev/zero", 1 << 20); }).find("never ends") !=
        std::string::npos);
  CHECK(message_of([] { read_file("/dev/zero"); }).find("never ends") != std::string::npos);
}
