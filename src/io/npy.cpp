// NumPy arrays: a magic word, a Python dictionary in text, then the numbers.
#include <Imath/half.h>

#include <array>
#include <bit>
#include <charconv>
#include <optional>

#include "io/depth_file.hpp"
#include "io/error.hpp"

namespace bitshade {
namespace {

constexpr std::array<std::uint8_t, 6> magic{0x93, 'N', 'U', 'M', 'P', 'Y'};

struct array_header {
  std::string type;  ///< such as "<f4"
  bool column_major = false;
  std::vector<std::int64_t> shape;
};

/// The dictionary's three entries, written in any order and spacing, as Python's literals.
class dictionary {
 public:
  dictionary(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  array_header parse() {
    array_header out;
    bool type = false, order = false, shape = false;
    expect('{');
    while (!accept('}')) {
      const std::string key = quoted();
      expect(':');
      if (key == "descr") {
        out.type = quoted();
        type = true;
      } else if (key == "fortran_order") {
        out.column_major = boolean();
        order = true;
      } else if (key == "shape") {
        out.shape = tuple();
        shape = true;
      } else {
        refuse();
      }
      if (!accept(',')) {
        expect('}');
        break;
      }
    }
    if (!type || !order || !shape) refuse();
    return out;
  }

 private:
  [[noreturn]] void refuse() const {
    throw failure("cannot read " + name_ +
                  ": its header is not that of a plain NumPy array; write it with numpy.save");
  }
  void skip() {
    while (!text_.empty() && (text_[0] == ' ' || text_[0] == '\n' || text_[0] == '\t'))
      text_.remove_prefix(1);
  }
  bool accept(char c) {
    skip();
    if (text_.empty() || text_[0] != c) return false;
    text_.remove_prefix(1);
    return true;
  }
  void expect(char c) {
    if (!accept(c)) refuse();
  }
  std::string quoted() {
    skip();
    if (text_.empty() || (text_[0] != '\'' && text_[0] != '"')) refuse();
    const std::size_t end = text_.find(text_[0], 1);
    if (end == std::string_view::npos) refuse();
    std::string out(text_.substr(1, end - 1));
    text_.remove_prefix(end + 1);
    return out;
  }
  bool boolean() {
    skip();
    for (const bool value : {false, true}) {
      const std::string_view word = value ? "True" : "False";
      if (text_.starts_with(word)) {
        text_.remove_prefix(word.size());
        return value;
      }
    }
    refuse();
  }
  std::vector<std::int64_t> tuple() {
    std::vector<std::int64_t> out;
    expect('(');
    while (!accept(')')) {
      skip();
      std::int64_t value = 0;
      const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), value);
      if (error != std::errc() || out.size() == 8) refuse();
      text_.remove_prefix(static_cast<std::size_t>(end - text_.data()));
      out.push_back(value);
      if (!accept(',')) {
        expect(')');
        break;
      }
    }
    return out;
  }

  std::string_view text_;
  const std::string& name_;
};

/// How one number is stored.
struct number_type {
  char kind;  ///< f or u
  std::size_t size;
  bool big_endian;

  double read(const std::uint8_t* bytes) const {
    std::uint64_t word = 0;
    for (std::size_t i = 0; i < size; ++i) {
      word |= static_cast<std::uint64_t>(bytes[big_endian ? size - 1 - i : i]) << (8 * i);
    }
    if (kind == 'u') return static_cast<double>(word);
    if (size == 8) return std::bit_cast<double>(word);
    if (size == 4) return std::bit_cast<float>(static_cast<std::uint32_t>(word));
    return static_cast<float>(Imath::half(Imath::half::FromBits, static_cast<std::uint16_t>(word)));
  }
};

number_type type_named(const std::string& text, const std::string& name) {
  if (text.size() == 3 && (text[0] == '<' || text[0] == '>' || text[0] == '=' || text[0] == '|')) {
    const std::string kind = text.substr(1);
    for (const char* known : {"f2", "f4", "f8", "u2", "u4"}) {
      if (kind == known) {
        return {kind[0], static_cast<std::size_t>(kind[1] - '0'), text[0] == '>'};
      }
    }
    if (kind == "u1" || kind == "i1" || kind == "b1") {
      throw failure("cannot read " + name +
                    ": its 8 bits a number hold 256 depths, too few for a "
                    "depth map; save it as uint16 or float32");
    }
  }
  throw failure("cannot read " + name + ": its numbers are of type '" + text.substr(0, 16) +
                "', but depths are f2, f4, f8, u2 or u4; convert it with astype('float32')");
}

}  // namespace

stored_depths decode_npy(std::span<const std::uint8_t> bytes, const std::string& name,
                         const std::string& channel) {
  const auto truncated = [&] {
    return failure("cannot read " + name + ": it ends too early; write it again");
  };
  if (bytes.size() < magic.size() || !std::equal(magic.begin(), magic.end(), bytes.begin())) {
    throw failure("cannot read " + name +
                  ": it is not a NumPy file; check that its ending is right");
  }
  if (bytes.size() < 12) throw truncated();
  const std::size_t start = bytes[6] == 1 ? 10 : 12;
  std::size_t length = bytes[8] | static_cast<std::size_t>(bytes[9]) << 8;
  if (start == 12) {
    length |= static_cast<std::size_t>(bytes[10]) << 16 | static_cast<std::size_t>(bytes[11]) << 24;
  }
  if (bytes.size() - start < length) throw truncated();
  const array_header header =
      dictionary({reinterpret_cast<const char*>(bytes.data()) + start, length}, name).parse();
  const number_type type = type_named(header.type, name);
  const auto& shape = header.shape;
  if (shape.size() != 2 && shape.size() != 3) {
    throw failure("cannot read " + name + ": it has " + std::to_string(shape.size()) +
                  " axes, but a depth map has rows and columns (and perhaps channels); reshape it");
  }
  const std::int64_t height = shape[0], width = shape[1],
                     channels = shape.size() == 3 ? shape[2] : 1;
  check_image_size(width, height, name);
  if (channels < 1 || channels > 4096) {
    throw failure("cannot read " + name + ": it has " + std::to_string(channels) +
                  " channels, but 1 to 4096 can be read; save one of them");
  }
  std::vector<std::string> names;
  for (std::int64_t c = 0; c < channels; ++c) names.push_back(std::to_string(c));
  const auto index = static_cast<std::int64_t>(pick_channel(names, channel, name));
  const auto data = bytes.subspan(start + length);
  const auto expected = static_cast<std::size_t>(width * height * channels) * type.size;
  if (data.size() < expected) {
    throw failure("cannot read " + name + ": it ends after " + std::to_string(data.size()) +
                  " of " + std::to_string(expected) + " bytes of numbers; write it again");
  }
  stored_depths out;
  out.one = type.kind == 'f' ? 1 : type.size == 2 ? 65535 : 4294967295.0;
  out.values = image<double>(static_cast<int>(width), static_cast<int>(height));
  for (std::int64_t y = 0; y < height; ++y) {
    for (std::int64_t x = 0; x < width; ++x) {
      const std::int64_t at = header.column_major ? y + height * (x + width * index)
                                                  : (y * width + x) * channels + index;
      out.values.at(static_cast<int>(x), static_cast<int>(y)) =
          type.read(data.data() + static_cast<std::size_t>(at) * type.size);
    }
  }
  return out;
}

std::vector<std::uint8_t> encode_npy(const image<float>& depths) {
  std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (" +
                       std::to_string(depths.height) + ", " + std::to_string(depths.width) + "), }";
  // Blanks and a newline bring the numbers to a multiple of 64 bytes, as NumPy does.
  constexpr std::size_t prefix = 10;
  header.append(63 - (prefix + header.size()) % 64, ' ').push_back('\n');
  std::vector<std::uint8_t> out;
  out.reserve(prefix + header.size() + depths.texels.size() * 4);
  for (const std::uint8_t byte : magic) out.push_back(byte);
  for (const std::size_t byte :
       {std::size_t{1}, std::size_t{0}, header.size() & 255, header.size() >> 8}) {
    out.push_back(static_cast<std::uint8_t>(byte));
  }
  for (const char c : header) out.push_back(static_cast<std::uint8_t>(c));
  for (const float d : depths.texels) {
    const auto word = std::bit_cast<std::uint32_t>(d);
    for (int shift = 0; shift < 32; shift += 8)
      out.push_back(static_cast<std::uint8_t>(word >> shift));
  }
  return out;
}

}  // namespace bitshade
