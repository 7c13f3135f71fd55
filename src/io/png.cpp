#include "io/png.hpp"

#include <png.h>

#include <csetjmp>
#include <cstring>

#include "io/atomic_file.hpp"
#include "io/error.hpp"

namespace bitshade {
namespace {

// libpng reports errors by longjmp, which must not cross a destructor: everything with one lives in
// the callers of encode() and decode(), and these hold plain data only.

struct message {
  char text[160] = "unknown error";
};

[[noreturn]] void on_error(png_structp png, png_const_charp text) {
  auto* out = static_cast<message*>(png_get_error_ptr(png));
  std::strncpy(out->text, text, sizeof out->text - 1);
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}  // a warning leaves the pixels whole

void append(png_structp png, png_bytep data, png_size_t size) {
  auto* out = static_cast<std::vector<std::uint8_t>*>(png_get_io_ptr(png));
  out->insert(out->end(), data, data + size);
}

struct source {
  const std::uint8_t* data;
  std::size_t left;
};

void take(png_structp png, png_bytep data, png_size_t size) {
  auto* in = static_cast<source*>(png_get_io_ptr(png));
  if (size > in->left) png_error(png, "the file ends too early");
  std::memcpy(data, in->data, size);
  in->data += size;
  in->left -= size;
}

constexpr int color_of(int channels) {
  constexpr int colors[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                            PNG_COLOR_TYPE_RGB_ALPHA};
  return colors[channels - 1];
}

template <class T>
bool encode(const image<T>& picture, const std::uint8_t* const* rows,
            std::vector<std::uint8_t>& out, message& error) {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &error, on_error, on_warning);
  if (!png) return false;
  png_infop info = png_create_info_struct(png);
  if (!info || setjmp(png_jmpbuf(png))) {
    png_destroy_write_struct(&png, &info);
    return false;
  }
  png_set_write_fn(png, &out, append, nullptr);
  png_set_IHDR(png, info, static_cast<png_uint_32>(picture.width),
               static_cast<png_uint_32>(picture.height), static_cast<int>(sizeof(T) * 8),
               color_of(picture.channels), PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  for (int y = 0; y < picture.height; ++y) png_write_row(png, rows[y]);
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return true;
}

std::vector<std::uint8_t> finish(bool done, std::vector<std::uint8_t>&& out, const message& error) {
  if (!done) throw failure(std::string("cannot encode a PNG picture: ") + error.text);
  return std::move(out);
}

template <class T>
void check(const image<T>& picture) {
  if (picture.width < 1 || picture.height < 1) {
    throw failure("cannot encode a PNG picture: it has no pixels");
  }
  if (picture.channels < 1 || picture.channels > 4) {
    throw failure("cannot encode a PNG picture of " + std::to_string(picture.channels) +
                  " channels: it takes 1 to 4");
  }
}

}  // namespace

std::vector<std::uint8_t> encode_png(const image<std::uint8_t>& picture) {
  check(picture);
  std::vector<const std::uint8_t*> rows;
  for (int y = 0; y < picture.height; ++y) rows.push_back(picture.row(y).data());
  std::vector<std::uint8_t> out;
  message error;
  const bool done = encode(picture, rows.data(), out, error);
  return finish(done, std::move(out), error);
}

std::vector<std::uint8_t> encode_png(const image<std::uint16_t>& picture) {
  check(picture);
  std::vector<std::uint8_t> bytes;  // PNG's codes are big-endian
  bytes.reserve(picture.texels.size() * 2);
  for (const std::uint16_t code : picture.texels) {
    bytes.push_back(static_cast<std::uint8_t>(code >> 8));
    bytes.push_back(static_cast<std::uint8_t>(code & 255));
  }
  std::vector<const std::uint8_t*> rows;
  for (int y = 0; y < picture.height; ++y) rows.push_back(bytes.data() + 2 * picture.offset(0, y));
  std::vector<std::uint8_t> out;
  message error;
  const bool done = encode(picture, rows.data(), out, error);
  return finish(done, std::move(out), error);
}

void write_png(const std::filesystem::path& path, const image<std::uint8_t>& picture) {
  write_file(path, encode_png(picture));
}

void write_png(const std::filesystem::path& path, const image<std::uint16_t>& picture) {
  write_file(path, encode_png(picture));
}

namespace {

struct reader {
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::size_t packed_row = 0;  ///< bytes of a row as the file holds it, before any widening
  ~reader() { png_destroy_read_struct(&png, &info, nullptr); }
};

/// Header and transformations; false on an error.
bool read_header(reader& r, source& in, message& error) {
  r.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &error, on_error, on_warning);
  if (!r.png) return false;
  r.info = png_create_info_struct(r.png);
  if (!r.info || setjmp(png_jmpbuf(r.png))) return false;
  png_set_read_fn(r.png, &in, take);
  png_set_user_limits(r.png, 65536, 65536);
  png_set_chunk_malloc_max(r.png, 8 << 20);  // text chunks are of no use here
  png_set_crc_action(r.png, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
  png_read_info(r.png, r.info);
  r.packed_row = png_get_rowbytes(r.png, r.info);
  png_set_expand(r.png);  // palettes to RGB, 1, 2 and 4 bits to 8
  png_set_interlace_handling(r.png);
  png_read_update_info(r.png, r.info);
  return true;
}

bool read_rows(reader& r, std::uint8_t** rows) {
  if (setjmp(png_jmpbuf(r.png))) return false;
  png_read_image(r.png, rows);
  png_read_end(r.png, nullptr);
  return true;
}

}  // namespace

png_contents decode_png(std::span<const std::uint8_t> bytes, const std::string& name) {
  message error;
  source in{bytes.data(), bytes.size()};
  reader r;
  if (bytes.size() < 8 || png_sig_cmp(bytes.data(), 0, 8) != 0) {
    throw failure("cannot read " + name + ": it is not a PNG file; check that its ending is right");
  }
  const auto refuse = [&] {
    return failure("cannot read " + name + ": " + error.text + "; write the PNG again");
  };
  if (!read_header(r, in, error)) throw refuse();
  const auto width = static_cast<int>(png_get_image_width(r.png, r.info));
  const auto height = static_cast<int>(png_get_image_height(r.png, r.info));
  const int channels = png_get_channels(r.png, r.info);
  const int bits = png_get_bit_depth(r.png, r.info);
  const std::size_t row_bytes = png_get_rowbytes(r.png, r.info);
  // Deflate cannot pack better than 1032:1, so a header that promises more lies; refuse it before
  // the memory is taken.
  if (r.packed_row * static_cast<std::size_t>(height) / 1032 > bytes.size()) {
    throw failure("cannot read " + name + ": " + std::to_string(width) + " x " +
                  std::to_string(height) + " pixels cannot be in " + std::to_string(bytes.size()) +
                  " bytes; write the PNG again");
  }
  std::vector<std::uint8_t> raw(row_bytes * static_cast<std::size_t>(height));
  std::vector<std::uint8_t*> rows;
  for (int y = 0; y < height; ++y)
    rows.push_back(raw.data() + row_bytes * static_cast<std::size_t>(y));
  if (!read_rows(r, rows.data())) throw refuse();

  png_contents out;
  out.bits = bits;
  out.codes = image<std::uint16_t>(width, height, channels);
  for (std::size_t i = 0; i < out.codes.texels.size(); ++i) {
    out.codes.texels[i] =
        static_cast<std::uint16_t>(bits == 16 ? raw[2 * i] << 8 | raw[2 * i + 1] : raw[i]);
  }
  return out;
}

}  // namespace bitshade
