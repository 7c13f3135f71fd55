// Depth maps in and out: exact codes, every type and order, and sentences for what is wrong.
#include "io/depth_file.hpp"

#include <ImfChannelList.h>
#include <ImfDeepScanLineOutputFile.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>
#include <ImfTileDescription.h>
#include <ImfTiledOutputFile.h>
#include <half.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "io/atomic_file.hpp"
#include "io/error.hpp"
#include "io/png.hpp"
#include "support/catch.hpp"
#include "support/refusals.hpp"
#include "support/temporary_folder.hpp"

using namespace bitshade;

namespace {

image<float> ramp(int width, int height) {
  image<float> out(width, height);
  for (std::size_t i = 0; i < out.texels.size(); ++i) {
    out.texels[i] = static_cast<float>(i) / static_cast<float>(out.texels.size());
  }
  return out;
}

std::vector<std::uint8_t> bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

/// A NumPy file of version 1 with the given dictionary and numbers.
std::vector<std::uint8_t> npy(const std::string& dictionary, const std::string& data) {
  std::string text = "\x93NUMPY";
  text += '\x01';
  text += '\0';
  text += static_cast<char>(dictionary.size());
  text += '\0';
  return bytes_of(text + dictionary + data);
}

std::string npy_of(const std::string& type, bool fortran, const std::string& shape) {
  return "{'descr': '" + type + "', 'fortran_order': " + (fortran ? "True" : "False") +
         ", 'shape': (" + shape + "), }\n";
}

template <class T>
std::string big_endian(std::initializer_list<T> values) {
  std::string out;
  for (const T value : values) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    for (std::size_t i = sizeof(T); i-- > 0;) out += bytes[i];
  }
  return out;
}

template <class T>
std::string little_endian(std::initializer_list<T> values) {
  std::string out;
  for (const T value : values) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    out.append(bytes, sizeof(T));
  }
  return out;
}

using doubles = std::vector<double>;

}  // namespace

TEST_CASE("binary32 depths come back bit for bit from EXR, PFM and NumPy files") {
  const temporary_folder folder;
  image<float> depths = ramp(7, 5);
  depths.texels[3] = std::numeric_limits<float>::denorm_min();
  depths.texels[4] = std::nextafter(1.0f, 0.0f);
  for (const char* name : {"a.exr", "a.pfm", "a.npy", "b.EXR"}) {
    INFO(name);
    write_depths(folder / name, depths);
    const stored_depths back = read_depths(folder / name, "");
    CHECK(back.one == 1);
    REQUIRE(back.values.width == 7);
    REQUIRE(back.values.height == 5);
    for (std::size_t i = 0; i < depths.texels.size(); ++i) {
      CHECK(back.values.texels[i] == static_cast<double>(depths.texels[i]));
    }
  }
}

TEST_CASE("16-bit PNG holds the nearest code of every depth") {
  image<float> depths(4, 1);
  depths.texels = {0.0f, 1.0f, 0.5f, 1.0f / 65535};
  const stored_depths back = decode_depth_png(encode_depth_png(depths), "p", "");
  CHECK(back.one == 65535);
  CHECK(back.values.texels == doubles{0, 65535, 32768, 1});
}

TEST_CASE("NumPy: every type, both byte orders, both layouts, channels") {
  const auto read = [](const std::vector<std::uint8_t>& bytes, const std::string& channel = "") {
    return decode_npy(bytes, "n", channel);
  };
  const doubles expected{0.25, 0.5, 1, 2};
  CHECK(read(npy(npy_of("<f4", false, "2, 2"), little_endian({0.25f, 0.5f, 1.f, 2.f})))
            .values.texels == expected);
  CHECK(
      read(npy(npy_of(">f4", false, "2, 2"), big_endian({0.25f, 0.5f, 1.f, 2.f}))).values.texels ==
      expected);
  CHECK(read(npy(npy_of("<f8", false, "2, 2"), little_endian({0.25, 0.5, 1., 2.}))).values.texels ==
        expected);
  CHECK(read(npy(npy_of(">f8", true, "2, 2"), big_endian({0.25, 1., 0.5, 2.}))).values.texels ==
        expected);
  CHECK(read(npy(npy_of("<f2", false, "1, 4"),
                 little_endian<std::uint16_t>({0x3400, 0x3800, 0x3C00, 0x4000})))
            .values.texels == expected);
  const auto codes =
      read(npy(npy_of(">u2", false, "4, 1"), big_endian<std::uint16_t>({0, 1, 256, 65535})));
  CHECK(codes.values.texels == doubles{0, 1, 256, 65535});
  CHECK(codes.one == 65535);
  CHECK(read(npy(npy_of("<u4", false, "1, 1"), little_endian<std::uint32_t>({0xFFFFFFFF}))).one ==
        4294967295.0);
  const auto two = npy(npy_of("<f4", false, "1, 2, 2"), little_endian({1.f, 2.f, 3.f, 4.f}));
  CHECK(read(two, "1").values.texels == doubles{2, 4});
  CHECK(holds(message_of([&] { read(two); }), "--channel: 0 1"));
  const auto columns = npy(npy_of("<f4", true, "1, 2, 2"), little_endian({1.f, 2.f, 3.f, 4.f}));
  CHECK(read(columns, "1").values.texels == doubles{3, 4});
}

TEST_CASE("NumPy files that are something else are refused with what to do") {
  const auto refusal = [](const std::vector<std::uint8_t>& bytes) {
    return message_of([&] { decode_npy(bytes, "n.npy", ""); });
  };
  const std::string four = little_endian({0.f});
  CHECK(holds(refusal(bytes_of("hello, world")), "not a NumPy file"));
  CHECK(holds(refusal(npy(npy_of("<f4", false, "2, 2"), four)), "ends after 4 of 16 bytes"));
  CHECK(holds(refusal(npy(npy_of("|u1", false, "1, 1"), four)), "8 bits"));
  CHECK(holds(refusal(npy(npy_of("<c8", false, "1, 1"), four)), "astype"));
  CHECK(holds(refusal(npy(npy_of("<i4", false, "1, 1"), four)), "'<i4'"));
  CHECK(holds(refusal(npy(npy_of("<f4", false, "1,"), four)), "1 axes"));
  CHECK(holds(refusal(npy(npy_of("<f4", false, "0, 3"), four)), "3 x 0 texels"));
  CHECK(holds(refusal(npy(npy_of("<f4", false, "70000, 3"), four)), "1 to 65536"));
  CHECK(holds(refusal(npy(npy_of("<f4", false, "-1, 3"), four)), "3 x -1"));
  CHECK(holds(
      refusal(npy("{'descr': [('a', '<f4')], 'fortran_order': False, 'shape': (1, 1)}", four)),
      "numpy.save"));
  CHECK(holds(refusal(npy("{'descr': '<f4', 'shape': (1, 1)}", four)), "numpy.save"));
  CHECK(holds(refusal(npy("{", four)), "numpy.save"));
}

TEST_CASE("PFM: either byte order, bottom row first, colour by channel") {
  const auto read = [](const std::string& text, const std::string& channel = "") {
    return decode_pfm(bytes_of(text), "p.pfm", channel);
  };
  CHECK(read("Pf\n1 2\n-1.0\n" + little_endian({3.f, 4.f})).values.texels == doubles{4, 3});
  CHECK(read("Pf 2 1 1\n" + big_endian({3.f, 4.f})).values.texels == doubles{3, 4});
  CHECK(read("PF\n1 1\n-1\n" + little_endian({1.f, 2.f, 3.f}), "G").values.texels == doubles{2});
  CHECK(holds(message_of([&] {
                read("PF\n1 1\n-1\n" + little_endian({1.f, 2.f, 3.f}));
              }),
              "R G B"));
  CHECK(holds(message_of([&] { read("P5\n1 1\n255\nx"); }), "not a PFM"));
  CHECK(holds(message_of([&] { read("Pf\n1 x\n-1\n"); }), "header"));
  CHECK(holds(message_of([&] { read("Pf\n2 2\n-1\n" + little_endian({1.f})); }), "4 of 16 bytes"));
  CHECK(holds(message_of([&] { read("Pf\n0 2\n-1\n"); }), "0 x 2"));
}

TEST_CASE("PNG depth maps of 8 bits are refused, colour ones ask for a channel") {
  CHECK(holds(
      message_of([] { decode_depth_png(encode_png(image<std::uint8_t>(2, 2)), "p.png", ""); }),
      "8 bits"));
  image<std::uint16_t> colour(1, 1, 3);
  colour.texels = {1, 2, 3};
  CHECK(holds(message_of([&] { decode_depth_png(encode_png(colour), "p.png", ""); }), "R G B"));
  CHECK(decode_depth_png(encode_png(colour), "p.png", "B").values.texels == doubles{3});
}

TEST_CASE("EXR: half, uint and float channels, picked by name; windows off the origin; tiles") {
  const temporary_folder folder;
  const std::string path = (folder / "many.exr").string();
  std::vector<Imath::half> halves{0.25f, 0.5f};
  std::vector<std::uint32_t> words{7, 0xFFFFFFFF};
  std::vector<float> floats{0.1f, 0.9f};
  {
    Imf::Header header(Imath::Box2i({0, 0}, {9, 9}), Imath::Box2i({5, -3}, {6, -3}));
    header.channels().insert("light.R", Imf::Channel(Imf::HALF));
    header.channels().insert("id", Imf::Channel(Imf::UINT));
    header.channels().insert("depth", Imf::Channel(Imf::FLOAT));
    Imf::FrameBuffer source;
    const auto slice = [&](Imf::PixelType type, auto& data) {
      const std::size_t size = sizeof(data[0]);
      char* const base =
          reinterpret_cast<char*>(data.data()) - 5 * static_cast<std::ptrdiff_t>(size);
      return Imf::Slice(type, base, size, 0);
    };
    source.insert("light.R", slice(Imf::HALF, halves));
    source.insert("id", slice(Imf::UINT, words));
    source.insert("depth", slice(Imf::FLOAT, floats));
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(source);
    file.writePixels(1);
  }
  CHECK(read_depths(path, "light.R").values.texels == doubles{0.25, 0.5});
  CHECK(read_depths(path, "id").values.texels == doubles{7, 4294967295.0});
  CHECK(read_depths(path, "id").one == 4294967295.0);
  CHECK(read_depths(path, "").values.texels ==
        doubles{static_cast<double>(0.1f), static_cast<double>(0.9f)});
  CHECK(holds(message_of([&] { read_depths(path, "dept"); }), "did you mean 'depth'?"));

  const std::string tiled = (folder / "tiled.exr").string();
  image<float> depths = ramp(37, 19);
  {
    Imf::Header header(37, 19);
    header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
    header.setTileDescription(Imf::TileDescription(16, 8, Imf::ONE_LEVEL));
    Imf::TiledOutputFile file(tiled.c_str(), header);
    Imf::FrameBuffer source;
    source.insert("Z", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(depths.texels.data()),
                                  sizeof(float), sizeof(float) * 37));
    file.setFrameBuffer(source);
    file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
  }
  const stored_depths back = read_depths(tiled, "");
  for (std::size_t i = 0; i < depths.texels.size(); ++i) {
    REQUIRE(back.values.texels[i] == static_cast<double>(depths.texels[i]));
  }
}

TEST_CASE("EXR files that are deep, empty or something else are refused") {
  const temporary_folder folder;
  const std::string path = (folder / "deep.exr").string();
  {
    Imf::Header header(2, 2);
    header.setType(Imf::DEEPSCANLINE);
    header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
    header.compression() = Imf::ZIPS_COMPRESSION;
    Imf::DeepScanLineOutputFile file(path.c_str(), header);
  }
  CHECK(holds(message_of([&] { read_depths(path, ""); }), "deep.exr"));
  CHECK(holds(message_of([] { decode_exr(bytes_of("GIF89a"), "x.exr", ""); }),
              "not an OpenEXR file"));
  CHECK(holds(message_of([] { decode_exr(bytes_of("\x76\x2f\x31\x01"), "x.exr", ""); }),
              "cannot read x.exr"));
}

TEST_CASE("endings are checked before anything is written") {
  const temporary_folder folder;
  CHECK(holds(message_of([&] { write_depths(folder / "a.jpg", ramp(2, 2)); }),
              "usage: depth maps are .exr"));
  CHECK(holds(message_of([&] { read_depths(folder / "a", ""); }), "usage: depth maps are .exr"));
  CHECK(std::filesystem::is_empty(folder.path()));
}
