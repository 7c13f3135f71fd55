#include "io/texture_exr.hpp"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>

#include <cstring>
#include <filesystem>
#include <vector>

#include "io/error.hpp"

namespace bitshade {
namespace {

/// OpenEXR's view of bytes in memory.
class memory_stream : public Imf::IStream {
 public:
  memory_stream(std::span<const std::uint8_t> bytes, const char* name)
      : Imf::IStream(name), bytes_(bytes) {}
  bool read(char out[], int count) override {
    if (count < 0 || static_cast<std::size_t>(count) > bytes_.size() - at_)
      throw std::runtime_error("the file ends too early");
    std::memcpy(out, bytes_.data() + at_, static_cast<std::size_t>(count));
    at_ += static_cast<std::size_t>(count);
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t at) override {
    if (at > bytes_.size()) throw std::runtime_error("the file ends too early");
    at_ = static_cast<std::size_t>(at);
  }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

std::vector<std::string> choose_channels(const Imf::ChannelList& list) {
  std::vector<std::string> names;
  for (const char* name : {"R", "G", "B", "A"})
    if (list.findChannel(name) != nullptr) names.emplace_back(name);
  if (!names.empty()) return names;
  for (const char* name : {"Y", "Z"})
    if (list.findChannel(name) != nullptr) return {name};
  for (auto c = list.begin(); c != list.end() && names.size() < 4; ++c)
    names.emplace_back(c.name());
  return names;
}

template <class Word>
coded_image read_channels(Imf::InputFile& file, const std::vector<std::string>& names,
                          Imf::PixelType type) {
  const auto window = file.header().dataWindow();
  const int width = window.max.x - window.min.x + 1, height = window.max.y - window.min.y + 1;
  coded_image result(width, height, static_cast<int>(names.size()));
  std::vector<Word> plane(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const auto stride = sizeof(Word), pitch = stride * static_cast<std::size_t>(width);
  for (std::size_t c = 0; c < names.size(); ++c) {
    // OpenEXR addresses a slice from the window's origin, which need not be 0.
    char* origin = reinterpret_cast<char*>(plane.data()) -
                   static_cast<std::ptrdiff_t>(stride) * window.min.x -
                   static_cast<std::ptrdiff_t>(pitch) * window.min.y;
    Imf::FrameBuffer frame;
    frame.insert(names[c], Imf::Slice(type, origin, stride, pitch));
    file.setFrameBuffer(frame);
    file.readPixels(window.min.y, window.max.y);
    for (std::size_t i = 0; i < plane.size(); ++i) result.texels[i * names.size() + c] = plane[i];
  }
  return result;
}

}  // namespace

named_texture decode_exr_texture(std::span<const std::uint8_t> bytes, const std::string& name) {
  try {
    memory_stream stream(bytes, name.c_str());
    Imf::InputFile file(stream, 1);
    const auto window = file.header().dataWindow();
    const auto width = std::int64_t{window.max.x} - window.min.x + 1;
    const auto height = std::int64_t{window.max.y} - window.min.y + 1;
    if (width < 1 || height < 1 || width > 65536 || height > 65536)
      throw failure(name + ": its data window is empty or over 65,536 a side; crop it");
    const Imf::ChannelList& list = file.header().channels();
    const std::vector<std::string> names = choose_channels(list);
    if (names.empty()) throw failure(name + ": no channels in it; write R, RG, RGB, RGBA or Y");
    const Imf::PixelType type = list[names[0].c_str()].type;
    for (const std::string& n : names) {
      const Imf::Channel& c = list[n.c_str()];
      if (c.type != type || (type != Imf::HALF && type != Imf::FLOAT) || c.xSampling != 1 ||
          c.ySampling != 1)
        throw failure(name + ": channel " + n +
                      " is neither half nor float like the others, or subsampled; convert it");
    }
    const int channels = static_cast<int>(names.size());
    named_texture result{
        std::filesystem::path(name).stem().string(),
        uniform_format(type == Imf::HALF ? binary16::value : binary32::value, channels),
        {}};
    result.levels.push_back(type == Imf::HALF
                                ? read_channels<std::uint16_t>(file, names, Imf::HALF)
                                : read_channels<std::uint32_t>(file, names, Imf::FLOAT));
    return result;
  } catch (const failure&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    throw failure(name + ": no readable OpenEXR file (" + e.what() + "); write it again");
  }
}

}  // namespace bitshade
