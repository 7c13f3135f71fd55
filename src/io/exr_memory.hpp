// What both readers of OpenEXR share: bytes in memory as its stream, and a look at the header
// before anything of the size that it announces is allocated.
#pragma once

#include <ImfChannelList.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfPartType.h>

#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>

#include "io/depth_file.hpp"
#include "io/error.hpp"

namespace bitshade {

class exr_memory : public Imf::IStream {
 public:
  exr_memory(std::span<const std::uint8_t> bytes, const std::string& name)
      : Imf::IStream(name.c_str()), bytes_(bytes) {
    // OpenEXR's own guards, for what it allocates before the header can be looked at.
    [[maybe_unused]] static const bool guarded = [] {
      Imf::Header::setMaxImageSize(65536, 65536);
      Imf::Header::setMaxTileSize(4096, 4096);
      return true;
    }();
  }
  bool read(char out[], int count) override {
    if (count < 0 || static_cast<std::uint64_t>(count) > bytes_.size() - at_) {
      throw std::runtime_error("the file ends too early");
    }
    std::memcpy(out, bytes_.data() + at_, static_cast<std::size_t>(count));
    at_ += static_cast<std::uint64_t>(count);
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t at) override {
    if (at > bytes_.size()) throw std::runtime_error("it points beyond its own end");
    at_ = at;
  }

 private:
  std::span<const std::uint8_t> bytes_;
  std::uint64_t at_ = 0;
};

/// The data window of a flat image of sane size.
///
/// Failure  throws failure for a deep image, sizes that are no image's, and rows that take half a
///          gigabyte to decode: a header of a few bytes must not ask for it.
inline Imath::Box2i checked_window(const Imf::Header& header, const std::string& name) {
  if (header.hasType() && header.type() != Imf::SCANLINEIMAGE && header.type() != Imf::TILEDIMAGE)
    throw failure("cannot read " + name + ": it is a deep image; flatten it first");
  std::uint64_t texel_bytes = 0, channels = 0;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c, ++channels)
    texel_bytes += c.channel().type == Imf::HALF ? 2 : 4;
  const Imath::Box2i window = header.dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
  check_image_size(width, height, name);
  // Up to 256 lines or a row of tiles are decoded at a time.
  const std::uint64_t lines = header.hasTileDescription() ? header.tileDescription().ySize : 256;
  if (static_cast<std::uint64_t>(width) * texel_bytes * lines > (std::uint64_t{1} << 29))
    throw failure("cannot read " + name + ": " + std::to_string(channels) + " channels of " +
                  std::to_string(width) + " columns are too many; write the needed ones alone");
  return window;
}

}  // namespace bitshade
