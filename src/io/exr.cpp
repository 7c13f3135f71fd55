// OpenEXR: half, float or uint channels, scan lines or tiles, any compression.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>

#include <cstring>
#include <new>

#include "io/depth_file.hpp"
#include "io/error.hpp"

namespace bitshade {
namespace {

class memory_input : public Imf::IStream {
 public:
  memory_input(std::span<const std::uint8_t> bytes, const std::string& name)
      : Imf::IStream(name.c_str()), bytes_(bytes) {}
  bool read(char out[], int count) override {
    if (count < 0 || static_cast<std::uint64_t>(count) > bytes_.size() - at_) {
      throw failure("the file ends too early");
    }
    std::memcpy(out, bytes_.data() + at_, static_cast<std::size_t>(count));
    at_ += static_cast<std::uint64_t>(count);
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t at) override {
    if (at > bytes_.size()) throw failure("it points beyond its own end");
    at_ = at;
  }

 private:
  std::span<const std::uint8_t> bytes_;
  std::uint64_t at_ = 0;
};

class memory_output : public Imf::OStream {
 public:
  memory_output() : Imf::OStream("memory") {}
  void write(const char data[], int count) override {
    const auto size = static_cast<std::size_t>(count);
    if (bytes.size() < at_ + size) bytes.resize(at_ + size);
    std::memcpy(bytes.data() + at_, data, size);
    at_ += size;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t at) override { at_ = at; }

  std::vector<std::uint8_t> bytes;

 private:
  std::uint64_t at_ = 0;
};

/// One row at a time, so that memory grows only with rows that are really there.
template <class T>
void read_rows(Imf::InputPart& file, const Imath::Box2i& window, Imf::PixelType type,
               const std::string& channel, std::vector<double>& out) {
  std::vector<T> row(static_cast<std::size_t>(window.max.x - window.min.x + 1));
  // A stride of 0 between lines puts every line into `row`; the base undoes the window's offset.
  char* const base =
      reinterpret_cast<char*>(row.data()) -
      static_cast<std::ptrdiff_t>(window.min.x) * static_cast<std::ptrdiff_t>(sizeof(T));
  Imf::FrameBuffer target;
  target.insert(channel, Imf::Slice(type, base, sizeof(T), 0));
  file.setFrameBuffer(target);
  for (int y = window.min.y; y <= window.max.y; ++y) {
    file.readPixels(y);
    out.insert(out.end(), row.begin(), row.end());
  }
}

stored_depths decode(std::span<const std::uint8_t> bytes, const std::string& name,
                     const std::string& channel) {
  // OpenEXR's own guards, for what it allocates before the header can be looked at.
  [[maybe_unused]] static const bool guarded = [] {
    Imf::Header::setMaxImageSize(65536, 65536);
    Imf::Header::setMaxTileSize(4096, 4096);
    return true;
  }();
  memory_input input(bytes, name);
  Imf::MultiPartInputFile parts(input, 0, false);
  const Imf::Header& header = parts.header(0);
  if (header.hasType() && header.type() != Imf::SCANLINEIMAGE && header.type() != Imf::TILEDIMAGE) {
    throw failure("cannot read " + name + ": it is a deep image; flatten it first");
  }
  std::vector<std::string> names;
  std::uint64_t texel_bytes = 0;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
    names.emplace_back(c.name());
    texel_bytes += c.channel().type == Imf::HALF ? 2 : 4;
  }
  if (names.empty()) throw failure("cannot read " + name + ": it has no channels; write it again");
  const std::string picked = names[pick_channel(names, channel, name)];
  const Imf::Channel& c = header.channels()[picked.c_str()];
  if (c.xSampling != 1 || c.ySampling != 1) {
    throw failure("cannot read " + name + ": its channel " + picked +
                  " is subsampled; write it at full size");
  }
  const Imath::Box2i window = header.dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
  check_image_size(width, height, name);
  // Up to 256 lines or a row of tiles are decoded at a time: a header of a few bytes must not ask
  // for gigabytes.
  const std::uint64_t lines = header.hasTileDescription() ? header.tileDescription().ySize : 256;
  if (static_cast<std::uint64_t>(width) * texel_bytes * lines > (std::uint64_t{1} << 29)) {
    throw failure("cannot read " + name + ": " + std::to_string(names.size()) + " channels of " +
                  std::to_string(width) + " columns are too many; write the depth alone");
  }

  Imf::InputPart file(parts, 0);
  stored_depths out;
  if (c.type == Imf::UINT) {
    out.one = 4294967295.0;
    read_rows<std::uint32_t>(file, window, Imf::UINT, picked, out.values.texels);
  } else {  // halves widen to float without loss
    read_rows<float>(file, window, Imf::FLOAT, picked, out.values.texels);
  }
  out.values.width = static_cast<int>(width);
  out.values.height = static_cast<int>(height);
  return out;
}

}  // namespace

stored_depths decode_exr(std::span<const std::uint8_t> bytes, const std::string& name,
                         const std::string& channel) {
  constexpr std::uint8_t magic[4] = {0x76, 0x2f, 0x31, 0x01};
  if (bytes.size() < 4 || std::memcmp(bytes.data(), magic, 4) != 0) {
    throw failure("cannot read " + name +
                  ": it is not an OpenEXR file; check that its ending is right");
  }
  try {
    return decode(bytes, name, channel);
  } catch (const usage_error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw failure("cannot read " + name + ": it does not fit into memory; write a smaller one");
  } catch (const std::exception& e) {  // Iex::BaseExc, and ours from within the stream
    const std::string why = e.what();
    if (why.starts_with("cannot read ")) throw;
    throw failure("cannot read " + name + ": " + why.substr(0, why.find('\n')) +
                  "; write it again");
  }
}

std::vector<std::uint8_t> encode_exr(const image<float>& depths) {
  Imf::Header header(depths.width, depths.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
  memory_output output;
  try {
    Imf::OutputFile file(output, header);
    Imf::FrameBuffer source;
    // OpenEXR's slices are not const, although an output file only reads them.
    auto* const base = reinterpret_cast<char*>(const_cast<float*>(depths.texels.data()));
    source.insert("Z", Imf::Slice(Imf::FLOAT, base, sizeof(float),
                                  sizeof(float) * static_cast<std::size_t>(depths.width)));
    file.setFrameBuffer(source);
    file.writePixels(depths.height);
  } catch (const std::exception& e) {
    throw failure(std::string("cannot encode an OpenEXR file: ") + e.what());
  }
  return std::move(output.bytes);
}

}  // namespace bitshade
