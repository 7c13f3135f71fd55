// Every code of every small format decoded, every binary32 rounded to half (on request).
#include "support/catch.hpp"

#include <numeric>

#include "support/bulk_cases.hpp"

namespace {

using namespace bitshade;
using bulk_cases::bits_of;

template <class Code>
void check_all_codes(const encoding& e) {
  std::vector<Code> codes(std::size_t{1} << e.width);
  std::iota(codes.begin(), codes.end(), Code{0});
  for (const auto norm : {norm_decode::exact, norm_decode::reciprocal}) {
    const rules r{.norm = norm};
    std::vector<float> expected(codes.size()), got(codes.size());
    for (std::size_t j = 0; j < codes.size(); ++j) expected[j] = static_cast<float>(decode(e, codes[j], r));
    for (const auto set : bulk_cases::sets()) {
      if (set == bulk::instruction_set::scalar) continue;
      bulk::decode(e, r, std::span<const Code>(codes), got, {.set = set});
      std::size_t j = 0;
      while (j + 1 < codes.size() && bits_of(got[j]) == bits_of(expected[j])) ++j;
      INFO(bulk_cases::describe(e, r, set) << std::hex << " code=0x" << std::uint64_t{codes[j]} << " expected=0x"
                                           << bits_of(expected[j]) << " got=0x" << bits_of(got[j]));
      CHECK(bits_of(got[j]) == bits_of(expected[j]));
      if (e.kind == family::binary) continue;
      // What was decoded is rounded back to itself.
      std::vector<float> again(codes.size());
      bulk::round(e, r, expected, again, {.set = set});
      if (norm == norm_decode::exact) CHECK(again == expected);
    }
  }
}

TEST_CASE("bulk::decode of every code of every norm, fixed-point and binary format of up to 16 bits") {
  for (int n = 1; n <= 16; ++n) {
    check_all_codes<std::uint16_t>(unorm_encoding(n));
    if (n > 1) check_all_codes<std::uint16_t>(snorm_encoding(n));
  }
  for (int e = 2; e <= 11; ++e) check_all_codes<std::uint16_t>(binary_encoding(e, 15 - e));
  for (const encoding& e : {fp8_e4m3::value, fp8_e5m2::value}) check_all_codes<std::uint8_t>(e);
  check_all_codes<std::uint16_t>(fixed_encoding(4, 12));
  check_all_codes<std::uint16_t>(ufixed_encoding(8, 8));
}

TEST_CASE("bulk::round of dense inputs to every 16-bit binary format, in every direction") {
  for (int exponent = 2; exponent <= 11; ++exponent) {
    const encoding e = binary_encoding(exponent, 15 - exponent);
    const auto in = bulk_cases::inputs<float>(e, 4000, 2000);
    std::vector<float> expected(in.size()), got(in.size());
    for (int d = 0; d < 7; ++d) {
      const rules r{.direction = static_cast<rounding>(d)};
      for (std::size_t j = 0; j < in.size(); ++j) {
        expected[j] = static_cast<float>(round_to(e, in[j], r, rounding_bits(0, j)));
      }
      for (const auto set : bulk_cases::sets()) {
        if (set == bulk::instruction_set::scalar) continue;
        bulk::round(e, r, in, got, {.set = set});
        std::size_t j = 0;
        while (j + 1 < in.size() && bits_of(got[j]) == bits_of(expected[j])) ++j;
        INFO(bulk_cases::describe(e, r, set) << std::hex << " in=0x" << bits_of(in[j]) << " expected=0x"
                                             << bits_of(expected[j]) << " got=0x" << bits_of(got[j]));
        CHECK(bits_of(got[j]) == bits_of(expected[j]));
      }
    }
  }
}

TEST_CASE("bulk::decode of every code of unorm17 to unorm22 is the quotient rounded once") {
  for (int n = 17; n <= 22; ++n) {  // snorm of one bit more has the same quotients
    std::vector<std::uint32_t> codes(std::size_t{1} << n);
    std::iota(codes.begin(), codes.end(), 0u);
    std::vector<float> got(codes.size());
    for (const auto set : bulk_cases::sets()) {
      if (set == bulk::instruction_set::scalar || set == bulk::instruction_set::baseline) continue;
      bulk::decode(unorm_encoding(n), {}, std::span<const std::uint32_t>(codes), got, {.set = set});
      // binary64 holds more than twice binary32's digits: rounding the quotient twice is rounding it once [Figueroa95].
      const auto expected = [&](std::uint32_t c) { return static_cast<float>(static_cast<double>(c) / codes.back()); };
      std::size_t j = 0;
      while (j + 1 < codes.size() && got[j] == expected(codes[j])) ++j;
      INFO(bulk_cases::describe(unorm_encoding(n), {}, set) << std::hex << " code=0x" << codes[j] << " expected=0x"
                                                            << bits_of(expected(codes[j])) << " got=0x" << bits_of(got[j]));
      CHECK(got[j] == expected(codes[j]));
    }
  }
}

TEST_CASE("bulk::round of all 2^32 numbers of binary32 to half and bfloat16 is the definition's", "[.long]") {
  constexpr std::size_t block = std::size_t{1} << 20;
  std::vector<float> in(block), expected(block), got(block);
  for (const encoding& e : {binary16::value, bfloat16::value}) {
    for (std::uint64_t first = 0; first < std::uint64_t{1} << 32; first += block) {
      for (std::size_t j = 0; j < block; ++j) in[j] = std::bit_cast<float>(static_cast<std::uint32_t>(first + j));
      bulk::round(e, {}, in, expected, {.threads = 2, .set = bulk::instruction_set::scalar});
      for (const auto set : bulk_cases::sets()) {
        bulk::round(e, {}, in, got, {.set = set == bulk::instruction_set::scalar ? bulk::instruction_set::best : set});
        std::size_t j = 0;
        while (j + 1 < block && bits_of(got[j]) == bits_of(expected[j])) ++j;
        INFO(bulk_cases::describe(e, {}, set) << std::hex << " in=0x" << bits_of(in[j]) << " expected=0x"
                                              << bits_of(expected[j]) << " got=0x" << bits_of(got[j]));
        REQUIRE(bits_of(got[j]) == bits_of(expected[j]));
      }
    }
  }
}

}  // namespace
