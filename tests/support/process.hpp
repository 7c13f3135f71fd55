// The real command, run as a user runs it.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace bitshade::test {

struct outcome {
  int status = -1;  ///< exit status, or -1 where a signal ended it
  int signal = 0;
  std::string out, err;
};

struct run_options {
  std::filesystem::path folder;          ///< where it runs; empty: here
  std::vector<std::string> environment;  ///< NAME=VALUE in addition to ours
  std::string standard_output;           ///< a file or device in place of outcome::out
  std::optional<std::chrono::microseconds> kill_after;  ///< SIGKILL then
};

/// Runs a program to its end.
outcome run_program(const std::vector<std::string>& arguments, const run_options& options = {});

/// Runs the bitshade of this build.
outcome run_bitshade(std::vector<std::string> arguments, const run_options& options = {});

std::string contents(const std::filesystem::path& file);
void write(const std::filesystem::path& file, const std::string& bytes);

}  // namespace bitshade::test
