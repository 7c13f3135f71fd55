#include "scene/limits.hpp"

#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "io/error.hpp"
#include "io/text.hpp"

namespace bitshade {
namespace {

std::string in_gib(std::uint64_t bytes) {
  return brief(static_cast<double>(bytes) * 0x1p-30) + " GiB";
}

void check_size(int size, const std::string& option) {
  if (size < 1 || size > 65536) {
    throw usage_error(option + " takes sizes from 1 to 65536, but not " + std::to_string(size));
  }
}

}  // namespace

std::uint64_t memory_limit() {
  const long pages = ::sysconf(_SC_PHYS_PAGES), page = ::sysconf(_SC_PAGESIZE);
  std::uint64_t limit = pages > 0 && page > 0
                            ? static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page)
                            : ~std::uint64_t{0};
  std::uint64_t group = 0;
  for (const char* file :
       {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
    if (std::ifstream(file) >> group) limit = std::min(limit, group);
  }
  return limit;
}

void check_memory(std::uint64_t bytes, const std::string& what, const std::string& cure) {
  // Half of it: whoever asks for such a map wants to work on it, too.
  const std::uint64_t limit = memory_limit();
  if (bytes > limit / 2) {
    throw usage_error(what + " takes " + in_gib(bytes) + ", more than half of this machine's " +
                      in_gib(limit) + ": " + cure);
  }
}

void check_sizes(const scene_options& options, std::size_t triangles) {
  check_size(options.map_size, "--size");
  check_size(options.view_width, "--view");
  check_size(options.view_height, "--view");
  const auto map = static_cast<std::uint64_t>(options.map_size);
  const auto pixels = static_cast<std::uint64_t>(options.view_width) *
                      static_cast<std::uint64_t>(options.view_height);
  // Embree's hierarchy takes about 100 bytes a triangle.
  const std::uint64_t geometry = static_cast<std::uint64_t>(triangles) * 160;
  std::uint64_t maps = 1;
  for (const int samples : options.samples) maps += static_cast<std::uint64_t>(samples);
  check_memory(maps * map * map * (sizeof(float) + sizeof(std::uint32_t)) + geometry,
               "a depth map of " + std::to_string(map) + " x " + std::to_string(map) + " texels",
               "ask for a smaller --size");
  check_memory(maps * map * map * 8 + geometry + pixels * sizeof(receiver),
               "a view of " + std::to_string(options.view_width) + " x " +
                   std::to_string(options.view_height) + " pixels",
               "ask for a smaller --view");
}

}  // namespace bitshade
