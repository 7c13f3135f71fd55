// Outputs appear whole or not at all: written aside in the same folder, then renamed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace bitshade {

/// Writes `bytes` as the file `path`, replacing what was there only once every byte is on disk.
///
/// A device or a pipe (/dev/stdout) is written directly, since it cannot be renamed over.
/// Failure  throws failure with the path, the system's reason and the cure; the old file stays,
///          and nothing half-written is left.
void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);
void write_file(const std::filesystem::path& path, std::string_view text);

/// Makes sure that `folder` exists and takes files, before work is spent on what goes there.
///
/// Failure  throws failure with the path, the system's reason and the cure.
void make_output_folder(const std::filesystem::path& folder);

/// The whole of a file.
///
/// Failure  throws failure if it is missing, a folder, unreadable, empty, or larger than `limit`; what is no regular
///          file (a pipe, a device) may have 256 MiB.
std::vector<std::uint8_t> read_file(const std::filesystem::path& path,
                                    std::uintmax_t limit = std::uintmax_t{1} << 36);

}  // namespace bitshade
