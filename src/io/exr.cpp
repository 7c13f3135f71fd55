// OpenEXR: half, float or uint channels, scan lines or tiles, any compression.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfOutputFile.h>

#include <cstring>
#include <new>

#include "io/depth_file.hpp"
#include "io/error.hpp"
#include "io/exr_memory.hpp"

namespace bitshade {
namespace {

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
  exr_memory memory(bytes, name);
  Imf::MultiPartInputFile parts(memory, 0, false);
  const Imf::Header& header = parts.header(0);
  std::vector<std::string> names;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c)
    names.emplace_back(c.name());
  if (names.empty()) throw failure("cannot read " + name + ": it has no channels; write it again");
  const std::string picked = names[pick_channel(names, channel, name)];
  const Imf::Channel& c = header.channels()[picked.c_str()];
  if (c.xSampling != 1 || c.ySampling != 1) {
    throw failure("cannot read " + name + ": its channel " + picked +
                  " is subsampled; write it at full size");
  }
  const Imath::Box2i window = checked_window(header, name);
  Imf::InputPart file(parts, 0);
  stored_depths out;
  if (c.type == Imf::UINT) {
    out.one = 4294967295.0;
    read_rows<std::uint32_t>(file, window, Imf::UINT, picked, out.values.texels);
  } else {  // halves widen to float without loss
    read_rows<float>(file, window, Imf::FLOAT, picked, out.values.texels);
  }
  out.values.width = window.max.x - window.min.x + 1;
  out.values.height = window.max.y - window.min.y + 1;
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
  } catch (const std::exception& e) {  // Iex::BaseExc, and the stream's own
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
