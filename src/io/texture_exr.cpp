#include "io/texture_exr.hpp"

#include <ImfFrameBuffer.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>

#include <filesystem>
#include <new>
#include <vector>

#include "io/error.hpp"
#include "io/exr_memory.hpp"

namespace bitshade {
namespace {

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

/// One row at a time, so that memory grows only with rows that are really there.
template <class Word>
coded_image read_rows(Imf::InputPart& file, const Imath::Box2i& window,
                      const std::vector<std::string>& names, Imf::PixelType type) {
  coded_image result;
  result.width = window.max.x - window.min.x + 1;
  result.channels = static_cast<int>(names.size());
  std::vector<Word> row(static_cast<std::size_t>(result.width) * names.size());
  // A stride of 0 between lines puts every line into `row`; the base undoes the window's offset.
  const auto stride = static_cast<std::ptrdiff_t>(sizeof(Word) * names.size());
  Imf::FrameBuffer target;
  for (std::size_t c = 0; c < names.size(); ++c)
    target.insert(names[c],
                  Imf::Slice(type, reinterpret_cast<char*>(row.data() + c) - stride * window.min.x,
                             static_cast<std::size_t>(stride), 0));
  file.setFrameBuffer(target);
  for (int y = window.min.y; y <= window.max.y; ++y) {
    file.readPixels(y);
    result.texels.insert(result.texels.end(), row.begin(), row.end());
  }
  result.height = window.max.y - window.min.y + 1;
  return result;
}

}  // namespace

named_texture decode_exr_texture(std::span<const std::uint8_t> bytes, const std::string& name) {
  try {
    exr_memory memory(bytes, name);
    Imf::MultiPartInputFile parts(memory, 0, false);
    const Imf::Header& header = parts.header(0);
    const Imath::Box2i window = checked_window(header, name);
    const Imf::ChannelList& list = header.channels();
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
    Imf::InputPart file(parts, 0);
    result.levels.push_back(type == Imf::HALF
                                ? read_rows<std::uint16_t>(file, window, names, Imf::HALF)
                                : read_rows<std::uint32_t>(file, window, names, Imf::FLOAT));
    return result;
  } catch (const failure&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw failure("cannot read " + name + ": it does not fit into memory; write a smaller one");
  } catch (const std::exception& e) {
    const std::string why = e.what();
    throw failure("cannot read " + name + ": " + why.substr(0, why.find('\n')) +
                  "; write it again");
  }
}

}  // namespace bitshade
