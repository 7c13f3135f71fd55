#include "report/picture.hpp"

#include <png.h>

#include <csetjmp>

#include "io/error.hpp"

namespace bitshade {
namespace {

void append(png_structp png, png_bytep data, png_size_t size) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), size);
}

/// Only plain data between setjmp and the end: no destructor may be jumped over.
bool encode(const picture& p, const std::vector<png_color>& palette, std::vector<png_bytep>& rows,
            std::string& out) {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  if (info == nullptr || setjmp(png_jmpbuf(png))) {
    png_destroy_write_struct(&png, &info);
    return false;
  }
  png_set_write_fn(png, &out, append, nullptr);
  const int kind = p.channels == 3   ? PNG_COLOR_TYPE_RGB
                   : palette.empty() ? PNG_COLOR_TYPE_GRAY
                                     : PNG_COLOR_TYPE_PALETTE;
  png_set_IHDR(png, info, static_cast<png_uint_32>(p.width), static_cast<png_uint_32>(p.height), 8,
               kind, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (!palette.empty()) {
    png_set_PLTE(png, info, palette.data(), static_cast<int>(palette.size()));
    png_set_filter(png, 0, PNG_FILTER_NONE);  // neighbours of an index mean nothing
  }
  png_write_info(png, info);
  png_write_image(png, rows.data());
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  return true;
}

}  // namespace

std::string encode_png(const picture& p) {
  std::vector<png_color> palette;
  for (const rgb& c : p.palette) palette.push_back({c[0], c[1], c[2]});
  std::vector<png_bytep> rows;
  for (int y = 0; y < p.height; ++y) rows.push_back(const_cast<picture&>(p).at(0, y));
  std::string out;
  if (!encode(p, palette, rows, out))
    throw failure("a picture of " + std::to_string(p.width) + "x" + std::to_string(p.height) +
                  " pixels could not be encoded as PNG; ask for a smaller --view");
  return out;
}

}  // namespace bitshade
