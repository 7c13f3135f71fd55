// Textures from OpenEXR: their channels, windows and tiles, and headers that promise too much.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfTiledOutputFile.h>

#include <cstring>
#include <string>

#include "io/atomic_file.hpp"
#include "io/error.hpp"
#include "io/texture_exr.hpp"
#include "support/catch.hpp"
#include "support/temporary_folder.hpp"

using namespace bitshade;

namespace {

constexpr int width = 5, height = 3, left = -7, top = 4;

/// Channel c of texel (x, y): another code everywhere.
std::uint32_t code(int x, int y, std::size_t c) {
  return static_cast<std::uint32_t>(0x3c00 + 100 * static_cast<int>(c) + 10 * y + x);
}

template <class Word>
named_texture through_file(const std::filesystem::path& path, std::vector<std::string> names,
                           Imf::PixelType type, bool tiled, Imf::LineOrder order) {
  Imf::Header header(Imath::Box2i({0, 0}, {9, 9}),
                     Imath::Box2i({left, top}, {left + width - 1, top + height - 1}));
  header.lineOrder() = order;
  std::vector<std::vector<Word>> planes(names.size());
  Imf::FrameBuffer source;
  for (std::size_t c = 0; c < names.size(); ++c) {
    header.channels().insert(names[c], Imf::Channel(type));
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) planes[c].push_back(static_cast<Word>(code(x, y, c)));
    constexpr auto pitch = static_cast<std::ptrdiff_t>(sizeof(Word)) * width;
    source.insert(names[c],
                  Imf::Slice(type,
                             reinterpret_cast<char*>(planes[c].data()) -
                                 static_cast<std::ptrdiff_t>(sizeof(Word)) * left - pitch * top,
                             sizeof(Word), static_cast<std::size_t>(pitch)));
  }
  if (tiled) {
    header.setTileDescription(Imf::TileDescription(2, 2, Imf::ONE_LEVEL));
    Imf::TiledOutputFile file(path.string().c_str(), header);
    file.setFrameBuffer(source);
    file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
  } else {
    Imf::OutputFile file(path.string().c_str(), header);
    file.setFrameBuffer(source);
    file.writePixels(height);
  }
  return decode_exr_texture(read_file(path), path.string());
}

}  // namespace

TEST_CASE("EXR textures: one to four channels, half and float, lines either way and tiles") {
  const temporary_folder folder;
  const std::vector<std::string> sets[] = {
      {"Y"}, {"R", "G"}, {"R", "G", "B"}, {"R", "G", "B", "A"}};
  for (const auto& names : sets)
    for (const bool tiled : {false, true})
      for (const auto order : {Imf::INCREASING_Y, Imf::DECREASING_Y}) {
        CAPTURE(names.size(), tiled, static_cast<int>(order));
        const auto check = [&](const named_texture& got, const encoding& e) {
          CHECK(got.name == "t");
          CHECK(got.format == uniform_format(e, static_cast<int>(names.size())));
          REQUIRE(got.levels.size() == 1);
          const coded_image& in = got.levels[0];
          REQUIRE((in.width == width && in.height == height));
          REQUIRE(in.texels.size() == names.size() * width * height);
          for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
              for (std::size_t c = 0; c < names.size(); ++c)
                CHECK(in.at(x, y, static_cast<int>(c)) == code(x, y, c));
        };
        check(through_file<std::uint16_t>(folder / "t.exr", names, Imf::HALF, tiled, order),
              binary16::value);
        check(through_file<std::uint32_t>(folder / "t.exr", names, Imf::FLOAT, tiled, order),
              binary32::value);
      }
}

TEST_CASE("EXR textures: a header of 65,536 x 65,536 texels without any takes no memory") {
  std::string bytes;
  const auto put = [&](auto value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
  };
  const auto attribute = [&](const char* name, const char* type, int size) {
    bytes += std::string(name) + '\0' + type + '\0';
    put(size);
  };
  put(20000630);
  put(2);
  attribute("channels", "chlist", 4 * 18 + 1);
  for (const char* name : {"A", "B", "G", "R"}) {
    bytes += std::string(name) + '\0';
    for (const int field : {2, 0, 1, 1}) put(field);
  }
  bytes += '\0';
  attribute("compression", "compression", 1);
  bytes += '\0';
  for (const char* window : {"dataWindow", "displayWindow"}) {
    attribute(window, "box2i", 16);
    for (const int edge : {0, 0, 65535, 65535}) put(edge);
  }
  attribute("lineOrder", "lineOrder", 1);
  bytes += '\0';
  attribute("pixelAspectRatio", "float", 4);
  put(1.0f);
  attribute("screenWindowCenter", "v2f", 8);
  put(0.0f);
  put(0.0f);
  attribute("screenWindowWidth", "float", 4);
  put(1.0f);
  bytes += '\0';
  bytes.append(8 * 65536, '\0');  // the table of places where lines begin, all unknown
  const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  CHECK_THROWS_AS(decode_exr_texture({data, bytes.size()}, "huge.exr"), failure);
  CHECK_THROWS_WITH(decode_exr_texture({data, bytes.size()}, "huge.exr"),
                    Catch::StartsWith("cannot read huge.exr: ") && Catch::Contains("missing"));
}
