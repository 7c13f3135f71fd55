#include "bitshade/formats/text.hpp"

#include "bitshade/formats/decode.hpp"
#include "bitshade/formats/hexadecimal.hpp"
#include "bitshade/formats/packed.hpp"
#include "support/catch.hpp"

using namespace bitshade;

namespace {

constexpr std::uint64_t read(const encoding& e, std::string_view text, const rules& r = {}) {
  return encode(e, parse_number(text).value(), r);
}

// The same at compile time.
static_assert(read(binary64::value, "0.1") == std::bit_cast<std::uint64_t>(0.1));
static_assert(read(binary64::value, "1e-400", rules{rounding::up}) == 1);
static_assert(read(binary16::value, "2/3") == 0x3955);
static_assert(!parse_number("1e") && !parse_number("0x") && !parse_number("1/0"));

}  // namespace

TEST_CASE("text becomes the nearest binary64, as the compiler reads it") {
  CHECK(std::bit_cast<double>(read(binary64::value, "123456789012345678901234567890e-25")) ==
        123456789012345678901234567890e-25);
  CHECK(std::bit_cast<double>(read(binary64::value, "2.2250738585072011e-308")) == 2.2250738585072011e-308);
  CHECK(std::bit_cast<double>(read(binary64::value, "1.7976931348623158079e308")) == 0x1.fffffffffffffp+1023);
  CHECK(std::bit_cast<double>(read(binary64::value, "0x1.fffffffffffff8p-1")) == 1.0);
  CHECK(std::bit_cast<double>(read(binary64::value, "10000000000000000000000/1e22")) == 1.0);
}

TEST_CASE("one digit beyond a tie decides, however far away it stands") {
  std::string tie = "1.00048828125";  // 1 + 2^-11: between two binary16 numbers
  CHECK(read(binary16::value, tie) == 0x3c00);
  CHECK(read(binary16::value, tie + std::string(5000, '0')) == 0x3c00);
  CHECK(read(binary16::value, tie + std::string(5000, '0') + "1") == 0x3c01);
  // Code 1 of unorm16 is 1/65535 = 0.0000152590218966964...: no decimal hits it, any length falls on a side.
  const std::string below = "0.000015259021896696421759365224689097";
  CHECK(read(unorm_encoding(16), below, rules{rounding::down}) == 0);
  CHECK(read(unorm_encoding(16), below, rules{rounding::up}) == 1);
}

TEST_CASE("exponents of a billion and beyond are answered at once") {
  for (const char* text : {"1e1000000000", "0x1p1000000000", "1e99999999999999999999", "1/1e-1000000000"})
    CHECK(read(binary64::value, text) == 0x7ff0000000000000);
  for (const char* text : {"1e-1000000000", "0x1p-1000000000", "1/1e1000000000"})
    CHECK(read(binary64::value, text) == 0);
  CHECK(read(binary16::value, "1e1000000000/1e1000000000") == 0x3c00);
  CHECK(read(unorm_encoding(8), "-1e1000000000") == 0);
  CHECK(read(fixed_encoding(4, 4), "-1e1000000000") == 0x80);
  CHECK(read(binary16::value, "-0e1000000000") == 0x8000);
}

TEST_CASE("hexadecimal output names every number in the same way") {
  CHECK(hexadecimal(0x1p-1074) == "0x1p-1074");
  CHECK(hexadecimal(-0x1.8p-1073) == "-0x1.8p-1073");
  CHECK(hexadecimal(0x1.fffffffffffffp+1023) == "0x1.fffffffffffffp+1023");
  CHECK(hexadecimal(-0.0) == "-0x0p+0");
  CHECK(hexadecimal_bits(0x2a, 11) == "0x02a");
}

TEST_CASE("packed floats have no sign and keep NaN") {
  const double nan = std::bit_cast<double>(0x7ff8000000000000);
  const double inf = std::bit_cast<double>(0x7ff0000000000000);
  CHECK(encode_r11g11b10({65024, 1, 64512}) == (0x7bfu | (0x3c0u << 11) | (0x3dfu << 22)));
  CHECK(encode_r11g11b10({-1, -inf, -0.0}) == 0);
  CHECK(decode_r11g11b10(encode_r11g11b10({inf, nan, 3}))[0] == inf);
  CHECK(decode_r11g11b10(encode_r11g11b10({inf, nan, 3}))[1] != decode_r11g11b10(encode_r11g11b10({inf, nan, 3}))[1]);
}
