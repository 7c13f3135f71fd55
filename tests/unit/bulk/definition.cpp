// Every kernel of every instruction set gives the definition's bits, over all axes of the rules.
#include "support/catch.hpp"

#include "support/bulk_cases.hpp"

namespace {

using namespace bitshade;
using bulk_cases::bits_of;

/// Encodings of every reach: fewer, as many and more exponent bits than either carrier; every family; odd widths.
const encoding encodings[] = {
    binary16::value, bfloat16::value, tf32::value, binary32::value, binary64::value, fp8_e4m3::value, fp8_e5m2::value,
    binary_encoding(2, 1), binary_encoding(2, 13), binary_encoding(7, 8), binary_encoding(5, 22),
    binary_encoding(5, 23), binary_encoding(7, 30), binary_encoding(8, 22), binary_encoding(9, 6),
    binary_encoding(9, 22), binary_encoding(10, 5), binary_encoding(11, 4), binary_encoding(11, 23),
    binary_encoding(10, 51), binary_encoding(11, 51),
    unsigned_binary_encoding(5, 6), unsigned_binary_encoding(5, 5), unsigned_binary_encoding(10, 22),
    unsigned_binary_encoding(11, 52),
    encoding{family::binary, 8, 7, 16, specials::single_nan, true},
    unorm_encoding(1), unorm_encoding(8), unorm_encoding(16), unorm_encoding(22), unorm_encoding(23),
    unorm_encoding(24), unorm_encoding(32), snorm_encoding(2), snorm_encoding(8), snorm_encoding(16),
    snorm_encoding(32), ufixed_encoding(0, 16), ufixed_encoding(8, 8), ufixed_encoding(0, 64),
    fixed_encoding(4, 12), fixed_encoding(16, 16), fixed_encoding(2, 0), fixed_encoding(32, 32)};

/// The streams of random bits change among the inputs.
constexpr std::uint64_t first_counter = (std::uint64_t{5} << rounding_stream::stream_bits) - 101;

template <class T>
void check_round(const encoding& e, const rules& r, const std::vector<T>& in) {
  const bulk::execution base{.seed = 7, .first_counter = first_counter};
  std::vector<T> expected(in.size()), got(in.size());
  for (std::size_t j = 0; j < in.size(); ++j) {
    expected[j] = static_cast<T>(round_to(e, in[j], r, rounding_bits(7, first_counter + j)));
  }
  for (const auto set : bulk_cases::sets()) {
    bulk::execution how = base;
    how.set = set;
    bulk::round(e, r, in, got, how);
    std::size_t j = 0;
    while (j + 1 < in.size() && bits_of(got[j]) == bits_of(expected[j])) ++j;
    INFO(bulk_cases::describe(e, r, set) << std::hex << " in=0x" << bits_of(in[j]) << " expected=0x"
                                         << bits_of(expected[j]) << " got=0x" << bits_of(got[j]));
    CHECK(bits_of(got[j]) == bits_of(expected[j]));
  }
}

template <class Code, class T>
void check_codes(const encoding& e, const rules& r, const std::vector<T>& in) {
  std::vector<Code> expected(in.size()), got(in.size());
  std::vector<T> expected_back(in.size()), back(in.size());
  for (std::size_t j = 0; j < in.size(); ++j) {
    expected[j] = static_cast<Code>(encode(e, in[j], r, rounding_bits(7, first_counter + j)));
    expected_back[j] = static_cast<T>(decode(e, expected[j], r));
  }
  for (const auto set : bulk_cases::sets()) {
    const bulk::execution how{.seed = 7, .first_counter = first_counter, .set = set};
    bulk::encode(e, r, in, std::span<Code>(got), how);
    bulk::decode(e, r, std::span<const Code>(expected), std::span<T>(back), how);
    std::size_t j = 0;
    while (j + 1 < in.size() && got[j] == expected[j] && bits_of(back[j]) == bits_of(expected_back[j])) ++j;
    INFO(bulk_cases::describe(e, r, set)
         << std::hex << " in=0x" << bits_of(in[j]) << " expected=0x" << std::uint64_t{expected[j]} << " got=0x"
         << std::uint64_t{got[j]} << " decoded expected=0x" << bits_of(expected_back[j]) << " got=0x"
         << bits_of(back[j]));
    CHECK(got[j] == expected[j]);
    CHECK(bits_of(back[j]) == bits_of(expected_back[j]));
  }
}

TEST_CASE("bulk::round gives round_to's bits, in binary32") {
  for (const encoding& e : encodings) {
    const auto in = bulk_cases::inputs<float>(e, 60, 60);
    for (const rules& r : bulk_cases::all_rules()) check_round(e, r, in);
  }
}

TEST_CASE("bulk::round gives round_to's bits, in binary64") {
  for (const encoding& e : encodings) {
    const auto in = bulk_cases::inputs<double>(e, 60, 60);
    for (const rules& r : bulk_cases::all_rules()) check_round(e, r, in);
  }
}

TEST_CASE("bulk::encode and decode give the definition's bits") {
  for (const encoding& e : encodings) {
    const auto in = bulk_cases::inputs<float>(e, 40, 40);
    const auto wide_in = bulk_cases::inputs<double>(e, 40, 40);
    for (const rules& r : bulk_cases::all_rules()) {
      if (e.width <= 8) check_codes<std::uint8_t>(e, r, in), check_codes<std::uint8_t>(e, r, wide_in);
      if (e.width <= 16) check_codes<std::uint16_t>(e, r, in), check_codes<std::uint16_t>(e, r, wide_in);
      if (e.width <= 32) check_codes<std::uint32_t>(e, r, in), check_codes<std::uint32_t>(e, r, wide_in);
      check_codes<std::uint64_t>(e, r, wide_in);
    }
  }
}

}  // namespace
