// Portable float maps: three lines of text, then binary32 rows from the bottom up.
#include <bit>
#include <charconv>
#include <cstring>

#include "io/depth_file.hpp"
#include "io/error.hpp"

namespace bitshade {
namespace {

constexpr bool is_blank(std::uint8_t c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

/// The header's words, one after another.
class words {
 public:
  words(std::span<const std::uint8_t> bytes, const std::string& name)
      : bytes_(bytes), name_(name) {}

  std::string_view next() {
    while (at_ < bytes_.size() && is_blank(bytes_[at_])) ++at_;
    const std::size_t start = at_;
    while (at_ < bytes_.size() && !is_blank(bytes_[at_])) ++at_;
    return {reinterpret_cast<const char*>(bytes_.data()) + start, at_ - start};
  }
  template <class T>
  T number() {
    const std::string_view word = next();
    T value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || error != std::errc() || end != word.data() + word.size()) {
      throw failure(
          "cannot read " + name_ +
          ": its header is not that of a PFM file (Pf, width, height, scale); write it again");
    }
    return value;
  }
  /// What follows the one blank after the header.
  std::span<const std::uint8_t> rest() const {
    return at_ < bytes_.size() ? bytes_.subspan(at_ + 1) : std::span<const std::uint8_t>();
  }

 private:
  std::span<const std::uint8_t> bytes_;
  const std::string& name_;
  std::size_t at_ = 0;
};

}  // namespace

stored_depths decode_pfm(std::span<const std::uint8_t> bytes, const std::string& name,
                         const std::string& channel) {
  words header(bytes, name);
  const std::string_view magic = header.next();
  if (magic != "Pf" && magic != "PF") {
    throw failure("cannot read " + name + ": it is not a PFM file; check that its ending is right");
  }
  const auto width = header.number<std::int64_t>();
  const auto height = header.number<std::int64_t>();
  const auto scale = header.number<double>();  // only its sign matters: negative is little-endian
  check_image_size(width, height, name);
  const std::size_t channels = magic == "PF" ? 3 : 1;
  const std::size_t index = channels == 3 ? pick_channel({"R", "G", "B"}, channel, name)
                                          : pick_channel({"Z"}, channel, name);
  const auto data = header.rest();
  const std::size_t expected = static_cast<std::size_t>(width * height) * channels * 4;
  if (data.size() < expected) {
    throw failure("cannot read " + name + ": it ends after " + std::to_string(data.size()) +
                  " of " + std::to_string(expected) + " bytes of pixels; write it again");
  }
  stored_depths out;
  out.values = image<double>(static_cast<int>(width), static_cast<int>(height));
  for (int y = 0; y < out.values.height; ++y) {
    for (int x = 0; x < out.values.width; ++x) {
      const std::size_t pixel = out.values.offset(x, out.values.height - 1 - y) * channels + index;
      const std::uint8_t* const b = data.data() + pixel * 4;
      const auto word = scale < 0 ? static_cast<std::uint32_t>(b[0] | b[1] << 8 | b[2] << 16) |
                                        static_cast<std::uint32_t>(b[3]) << 24
                                  : static_cast<std::uint32_t>(b[3] | b[2] << 8 | b[1] << 16) |
                                        static_cast<std::uint32_t>(b[0]) << 24;
      out.values.at(x, y) = std::bit_cast<float>(word);
    }
  }
  return out;
}

std::vector<std::uint8_t> encode_pfm(const image<float>& depths) {
  const std::string header =
      "Pf\n" + std::to_string(depths.width) + " " + std::to_string(depths.height) + "\n-1.0\n";
  std::vector<std::uint8_t> out(header.begin(), header.end());
  out.reserve(out.size() + depths.texels.size() * 4);
  for (int y = depths.height - 1; y >= 0; --y) {
    for (const float d : depths.row(y)) {
      const auto word = std::bit_cast<std::uint32_t>(d);
      for (int shift = 0; shift < 32; shift += 8)
        out.push_back(static_cast<std::uint8_t>(word >> shift));
    }
  }
  return out;
}

}  // namespace bitshade
