#include "io/texture_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "bitshade/formats/name.hpp"
#include "bitshade/formats/text.hpp"
#include "bitshade/texture/mip.hpp"
#include "io/error.hpp"
#include "io/text.hpp"

namespace bitshade {
namespace {

std::string at_line(const std::string& file, std::size_t line) {
  return file + ", line " + std::to_string(line) + ": ";
}

std::string upper(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return result;
}

/// What of a foreign text a message may show: short, one line, printable.
std::string shown(std::string_view text) {
  std::string result(text.substr(0, 40));
  for (char& c : result)
    if (c < ' ' || c > '~') c = '?';
  return "'" + result + (text.size() > 40 ? "...'" : "'");
}

template <class Integer>
std::optional<Integer> integer(std::string_view text, int base) {
  Integer value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  if (error != std::errc{} || end != text.data() + text.size() || text.empty()) return std::nullopt;
  return value;
}

/// Calls `use` with each line's number and text, without its line end; blank lines are skipped.
template <class Use>
void each_line(std::string_view text, Use use) {
  std::size_t number = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    ++number;
    if (!line.empty()) use(number, line);
  }
}

constexpr int largest_side = 1 << 16;

coded_image parse_texels(std::string_view text, int width, int height, const texel_format& format,
                         const std::string& place) {
  const auto texels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  // Every texel takes a digit and a blank: a size that the text cannot fill is refused before it
  // is allocated.
  if (text.size() + 1 < 2 * texels)
    throw failure(place + "too few texels for " + std::to_string(width) + " x " +
                  std::to_string(height) + "; give one word a channel for each");
  coded_image result(width, height, format.channels);
  std::size_t i = 0;
  const auto channels = static_cast<std::size_t>(format.channels);
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    if (text.empty()) break;
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::vector<std::string> words = split(text.substr(0, end), '/');
    text.remove_prefix(end);
    if (words.size() != channels)
      throw failure(place + "a texel has " + std::to_string(words.size()) + " words, but " +
                    name_of(format) + " takes " + std::to_string(channels) + " separated by '/'");
    if (i == result.texels.size())
      throw failure(place + "more texels than " + std::to_string(width) + " x " +
                    std::to_string(height) + "; check width and height");
    for (std::size_t c = 0; c < channels; ++c) {
      const auto code = integer<std::uint64_t>(words[c], 16);
      const int bits = format.of[c].width;
      if (!code || (bits < 64 && (*code >> bits) != 0))
        throw failure(place + shown(words[c]) + " is no word of " + std::to_string(bits) +
                      " bits in hexadecimal");
      result.texels[i++] = *code;
    }
  }
  if (i != result.texels.size())
    throw failure(place + "too few texels for " + std::to_string(width) + " x " +
                  std::to_string(height) + "; give one word a channel for each");
  return result;
}

}  // namespace

texel_format parse_texel_format(std::string_view name, const std::string& place) {
  const std::string word = upper(name);
  if (word == "R11G11B10_FLOAT" || word == "R11G11B10") return r11g11b10_format();
  static constexpr std::string_view prefixes[] = {"RGBA", "RGB", "RG", "R"};
  for (const std::string_view prefix : prefixes) {
    if (!word.starts_with(prefix)) continue;
    if (word.size() > prefix.size() && word[prefix.size()] == ':') {
      const auto e = parse_encoding(name.substr(prefix.size() + 1));
      if (e) return uniform_format(*e, static_cast<int>(prefix.size()));
      break;
    }
    const std::vector<std::string> parts = split(word.substr(prefix.size()), '_');
    const auto bits = parts.size() == 2 ? integer<int>(parts[0], 10) : std::nullopt;
    if (!bits) break;
    std::optional<encoding> e;
    if (parts[1] == "UNORM") e = unorm_encoding(*bits);
    if (parts[1] == "SNORM") e = snorm_encoding(*bits);
    if (parts[1] == "FLOAT" || parts[1] == "SFLOAT") {
      if (*bits == 16) e = binary16::value;
      if (*bits == 32) e = binary32::value;
      if (*bits == 64) e = binary64::value;
    }
    if (e && is_valid(*e)) return uniform_format(*e, static_cast<int>(prefix.size()));
    break;
  }
  throw failure(place + shown(name) +
                " is no texture format; write R, RG, RGB or RGBA, bits and _UNORM, _SNORM or "
                "_FLOAT, as in RG16_UNORM, or any format behind a colon, as in RG:e5m7");
}

std::string name_of(const texel_format& format) {
  if (format == r11g11b10_format()) return "R11G11B10_FLOAT";
  const encoding& e = format.of[0];
  const std::string channels =
      std::string("RGBA").substr(0, static_cast<std::size_t>(format.channels));
  const auto named = [&](const char* kind) { return channels + std::to_string(e.width) + kind; };
  if (e.kind == family::unorm) return named("_UNORM");
  if (e.kind == family::snorm) return named("_SNORM");
  if (e == binary16::value || e == binary32::value || e == binary64::value) return named("_FLOAT");
  return channels + ':' + name_of(e);
}

std::vector<named_texture> parse_textures(std::string_view text, const std::string& file) {
  static constexpr std::string_view header =
      "texture,format,level,width,height,texels_hex_row_major";
  std::vector<named_texture> result;
  bool first = true;
  each_line(text, [&](std::size_t number, std::string_view line) {
    const std::string place = at_line(file, number);
    if (first) {
      first = false;
      if (line != header)
        throw failure(place + "the first line must be '" + std::string(header) + "'");
      return;
    }
    const std::vector<std::string> parts = split(line, ',');
    if (parts.size() != 6)
      throw failure(place + std::to_string(parts.size()) + " columns instead of 6 (" +
                    std::string(header) + ")");
    const texel_format format = parse_texel_format(parts[1], place);
    const auto level = integer<int>(parts[2], 10), width = integer<int>(parts[3], 10),
               height = integer<int>(parts[4], 10);
    if (parts[0].empty()) throw failure(place + "the texture's name is empty");
    if (!level || !width || !height || *width < 1 || *height < 1 || *width > largest_side ||
        *height > largest_side)
      throw failure(place + "level, width and height must be whole numbers, sizes from 1 to " +
                    std::to_string(largest_side));
    auto found = std::find_if(result.begin(), result.end(),
                              [&](const named_texture& t) { return t.name == parts[0]; });
    if (found == result.end()) {
      if (*level != 0) throw failure(place + shown(parts[0]) + " must start with its level 0");
      result.push_back({parts[0], format, {}});
      found = result.end() - 1;
    } else if (found->format != format) {
      throw failure(place + "all levels of " + shown(parts[0]) + " must have one format");
    }
    if (*level != static_cast<int>(found->levels.size()))
      throw failure(place + "level " + std::to_string(*level) + " of " + shown(parts[0]) +
                    " where level " + std::to_string(found->levels.size()) + " should follow");
    if (*level > 0) {
      const coded_image& below = found->levels.back();
      const bool single = below.width == 1 && below.height == 1;
      if (single || *width != std::max(1, below.width / 2) ||
          *height != std::max(1, below.height / 2))
        throw failure(place + "a level's sizes must be half the sizes below it, rounded down, " +
                      "never under 1, and 1 x 1 is the last");
    }
    found->levels.push_back(parse_texels(parts[5], *width, *height, format, place));
  });
  if (result.empty()) throw failure(file + ": no texture in it; see 'bitshade sample --help'");
  return result;
}

std::string raw_word(const texel_format& format, std::size_t channel, std::uint64_t word) {
  static constexpr char digits[] = "0123456789abcdef";
  std::string out;
  for (int shift = (format.of[channel].width + 3) / 4 * 4 - 4; shift >= 0; shift -= 4)
    out += digits[(word >> shift) & 15];
  return out;
}

std::string print_texture(const named_texture& texture) {
  std::string out;
  for (std::size_t level = 0; level < texture.levels.size(); ++level) {
    const coded_image& in = texture.levels[level];
    out += texture.name + ',' + name_of(texture.format) + ',' + std::to_string(level) + ',' +
           std::to_string(in.width) + ',' + std::to_string(in.height) + ',';
    const auto channels = static_cast<std::size_t>(in.channels);
    for (std::size_t i = 0; i < in.texels.size(); ++i) {
      if (i != 0) out += i % channels == 0 ? ' ' : '/';
      out += raw_word(texture.format, i % channels, in.texels[i]);
    }
    out += '\n';
  }
  return out;
}

coordinates parse_coordinates(std::string_view text, const std::string& file) {
  coordinates result;
  bool first = true;
  std::size_t columns = 0;
  each_line(text, [&](std::size_t number, std::string_view line) {
    const std::string place = at_line(file, number);
    const std::vector<std::string> parts = split(line, ',');
    if (first) {
      first = false;
      const auto begins = [&](std::initializer_list<std::string_view> names) {
        return parts.size() >= names.size() &&
               std::equal(names.begin(), names.end(), parts.begin());
      };
      result.gradient = begins({"u", "v", "dudx", "dvdx", "dudy", "dvdy"});
      if (result.gradient || begins({"u", "v", "lod"})) {
        columns = parts.size();
        result.named = true;
        return;
      }
      if (parts[0] == "u" || (parts.size() != 3 && parts.size() != 6))
        throw failure(place + "neither u,v,lod nor u,v,dudx,dvdx,dudy,dvdy");
      result.gradient = parts.size() == 6;
      columns = parts.size();
    }
    if (parts.size() != columns)
      throw failure(place + std::to_string(parts.size()) + " columns instead of " +
                    std::to_string(columns));
    float values[6] = {};
    for (std::size_t i = 0; i < (result.gradient ? 6u : 3u); ++i) {
      const auto written = parse_number(parts[i]);
      const double x =
          written ? decode(binary32::value, encode(binary32::value, *written)) : INFINITY;
      if (!(std::fabs(x) <= 0x1p30))
        throw failure(place + shown(parts[i]) +
                      " is no coordinate: write a decimal or a C99 hexadecimal float below 2^30");
      values[i] = static_cast<float>(x);
    }
    if (result.gradient)
      result.lookups.push_back(
          {values[0], values[1], 0, {values[2], values[3], values[4], values[5]}});
    else
      result.lookups.push_back({values[0], values[1], values[2], {}});
  });
  if (result.lookups.empty())
    throw failure(file +
                  ": no coordinates in it; give lines of u,v,lod or u,v,dudx,dvdx,dudy,dvdy");
  return result;
}

}  // namespace bitshade
