#include "io/depth_file.hpp"

#include <algorithm>
#include <array>

#include "io/atomic_file.hpp"
#include "io/error.hpp"
#include "io/nearest.hpp"
#include "io/png.hpp"

namespace bitshade {
namespace {

struct format {
  std::string_view ending;
  stored_depths (*decode)(std::span<const std::uint8_t>, const std::string&, const std::string&);
  std::vector<std::uint8_t> (*encode)(const image<float>&);
};

constexpr std::array<format, 4> formats{{{".exr", decode_exr, encode_exr},
                                         {".png", decode_depth_png, encode_depth_png},
                                         {".pfm", decode_pfm, encode_pfm},
                                         {".npy", decode_npy, encode_npy}}};

const format* format_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  for (const auto& f : formats) {
    if (f.ending == ending) return &f;
  }
  return nullptr;
}

const format& known_format_of(const std::filesystem::path& path) {
  if (const format* f = format_of(path)) return *f;
  throw usage_error("depth maps are .exr, .png, .pfm or .npy files, but " + path.string() +
                    " is none: give it one of these endings");
}

}  // namespace

bool is_depth_file(const std::filesystem::path& path) { return format_of(path) != nullptr; }

stored_depths read_depths(const std::filesystem::path& path, const std::string& channel) {
  const format& f = known_format_of(path);
  return f.decode(read_file(path), path.string(), channel);
}

void write_depths(const std::filesystem::path& path, const image<float>& depths) {
  const format& f = known_format_of(path);
  write_file(path, f.encode(depths));
}

std::size_t pick_channel(const std::vector<std::string>& channels, const std::string& wanted,
                         const std::string& name) {
  const auto index_of = [&](std::string_view one) {
    return static_cast<std::size_t>(std::find(channels.begin(), channels.end(), one) -
                                    channels.begin());
  };
  if (!wanted.empty()) {
    if (const auto i = index_of(wanted); i < channels.size()) return i;
    throw usage_error(
        name + " has no channel '" + wanted +
        "': " + suggest(wanted, std::vector<std::string_view>(channels.begin(), channels.end())));
  }
  if (channels.size() == 1) return 0;
  for (const char* usual : {"Z", "depth", "D", "Y"}) {
    if (const auto i = index_of(usual); i < channels.size()) return i;
  }
  std::string list;
  for (const auto& c : channels) list += " " + c;
  throw usage_error(
      name + " has several channels, and none is called Z: choose one with --channel:" + list);
}

void check_image_size(std::int64_t width, std::int64_t height, const std::string& name) {
  if (width < 1 || height < 1 || width > 65536 || height > 65536) {
    throw failure("cannot read " + name + ": it says it has " + std::to_string(width) + " x " +
                  std::to_string(height) +
                  " texels, but 1 to 65536 a side can be read; write it again");
  }
}

stored_depths decode_depth_png(std::span<const std::uint8_t> bytes, const std::string& name,
                               const std::string& channel) {
  static const std::vector<std::string> names[] = {
      {"Y"}, {"Y", "A"}, {"R", "G", "B"}, {"R", "G", "B", "A"}};
  const png_contents png = decode_png(bytes, name);
  if (png.bits != 16) {
    throw failure("cannot read " + name +
                  ": its 8 bits a channel hold 256 depths, too few for a "
                  "depth map; write it with 16 bits, or as .exr, .pfm or .npy");
  }
  const std::size_t index = pick_channel(names[png.codes.channels - 1], channel, name);
  stored_depths out;
  out.one = 65535;
  out.values = image<double>(png.codes.width, png.codes.height);
  for (std::size_t i = 0; i < out.values.texels.size(); ++i) {
    out.values.texels[i] =
        png.codes.texels[i * static_cast<std::size_t>(png.codes.channels) + index];
  }
  return out;
}

std::vector<std::uint8_t> encode_depth_png(const image<float>& depths) {
  image<std::uint16_t> codes(depths.width, depths.height);
  for (std::size_t i = 0; i < codes.texels.size(); ++i) {
    // 65535 d is exact in binary64 (24 + 16 bits), so that this rounds once, ties upwards.
    const double scaled = std::clamp(static_cast<double>(depths.texels[i]), 0.0, 1.0) * 65535;
    codes.texels[i] = static_cast<std::uint16_t>(scaled + 0.5);
  }
  return encode_png(codes);
}

}  // namespace bitshade
