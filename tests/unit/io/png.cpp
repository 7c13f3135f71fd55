#include "io/png.hpp"

#include "io/atomic_file.hpp"
#include "io/error.hpp"
#include "support/catch.hpp"
#include "support/temporary_folder.hpp"

using bitshade::decode_png;
using bitshade::encode_png;
using bitshade::failure;
using bitshade::image;

TEST_CASE("PNG pictures of one to four channels come back code for code") {
  for (int channels = 1; channels <= 4; ++channels) {
    image<std::uint8_t> eight(5, 3, channels);
    image<std::uint16_t> sixteen(5, 3, channels);
    for (std::size_t i = 0; i < eight.texels.size(); ++i) {
      eight.texels[i] = static_cast<std::uint8_t>(i * 37);
      sixteen.texels[i] = static_cast<std::uint16_t>(i * 40503);
    }
    INFO("channels " << channels);
    const auto small = decode_png(encode_png(eight), "eight");
    CHECK(small.bits == 8);
    CHECK(std::equal(eight.texels.begin(), eight.texels.end(), small.codes.texels.begin()));
    const auto large = decode_png(encode_png(sixteen), "sixteen");
    CHECK(large.bits == 16);
    CHECK(large.codes == sixteen);
  }
}

TEST_CASE("pictures without pixels or with five channels are refused") {
  CHECK_THROWS_AS(encode_png(image<std::uint8_t>(0, 3)), failure);
  CHECK_THROWS_AS(encode_png(image<std::uint8_t>(2, 2, 5)), failure);
}

TEST_CASE("a PNG is written as a file") {
  const temporary_folder folder;
  const image<std::uint8_t> picture(2, 2, 3, std::uint8_t{9});
  bitshade::write_png(folder / "a.png", picture);
  CHECK(bitshade::read_file(folder / "a.png") == encode_png(picture));
}

TEST_CASE("a PNG header that promises more than its bytes can hold is refused before allocating") {
  auto bytes = encode_png(image<std::uint16_t>(4, 4, 4));
  bytes[18] = 0xC3;  // width 4 -> 0xC304 by 0xC304; the checksum is wrong now, too
  bytes[22] = 0xC3;
  CHECK_THROWS_AS(decode_png(bytes, "liar"), failure);
  std::uint32_t sum = ~std::uint32_t{0};  // of the chunk's name and data: CRC-32, made right again
  for (std::size_t i = 12; i < 29; ++i) {
    sum ^= bytes[i];
    for (int k = 0; k < 8; ++k) sum = sum >> 1 ^ ((sum & 1) != 0 ? 0xEDB88320u : 0);
  }
  for (std::size_t i = 0; i < 4; ++i)
    bytes[29 + i] = static_cast<std::uint8_t>(~sum >> (24 - 8 * i));
  CHECK_THROWS_WITH(decode_png(bytes, "liar"), Catch::Contains("pixels cannot be in"));
  // 20 gigabytes take 19 million bytes at least, packed as well as deflate can.
  bytes.resize(2'000'000);
  CHECK_THROWS_WITH(decode_png(bytes, "liar"), Catch::Contains("pixels cannot be in"));
}
