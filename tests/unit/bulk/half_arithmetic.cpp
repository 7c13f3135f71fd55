// Arithmetic on binary16 spans gives the integer definition's bits in every instruction set.
#include "support/catch.hpp"

#include <cfenv>

#include "bitshade/arithmetic/operations.hpp"
#include "support/bulk_cases.hpp"

namespace {

using namespace bitshade;
using codes = std::vector<std::uint16_t>;
constexpr encoding half = binary16::value;

/// Random codes with every corner against every corner among them.
void operands(codes& a, codes& b, codes& c) {
  const std::uint16_t corners[] = {0x0000, 0x8000, 0x0001, 0x8001, 0x03ff, 0x0400, 0x8400, 0x3c00, 0xbc00,
                                   0x3c01, 0x1400, 0x7bff, 0xfbff, 0x7c00, 0xfc00, 0x7e00, 0x7c01, 0xfd55};
  for (const auto x : corners) {
    for (const auto y : corners) {
      for (const auto z : corners) a.push_back(x), b.push_back(y), c.push_back(z);
    }
  }
  for (std::uint64_t j = 0; j < 60000; ++j) {
    const std::uint64_t r = random_bits(5, j);
    a.push_back(static_cast<std::uint16_t>(r)), b.push_back(static_cast<std::uint16_t>(r >> 16));
    // Every other addend lies near the product's end, where an fma that rounds twice goes wrong.
    c.push_back(static_cast<std::uint16_t>(j % 2 ? r >> 32 : (r >> 32 & 0x83ff) | (r >> 48 & 0x0c00)));
  }
}

TEST_CASE("bulk half arithmetic is the definition's") {
  codes a, b, c;
  operands(a, b, c);
  const struct {
    const char* name;
    void (*run)(const codes&, const codes&, const codes&, codes&, const bulk::execution&);
    std::uint64_t (*define)(std::uint64_t, std::uint64_t, std::uint64_t);
  } cases[] = {
      {"add", [](const codes& x, const codes& y, const codes&, codes& o, const bulk::execution& h) { bulk::add(x, y, o, h); },
       [](std::uint64_t x, std::uint64_t y, std::uint64_t) { return add(half, x, y); }},
      {"subtract", [](const codes& x, const codes& y, const codes&, codes& o, const bulk::execution& h) { bulk::subtract(x, y, o, h); },
       [](std::uint64_t x, std::uint64_t y, std::uint64_t) { return subtract(half, x, y); }},
      {"multiply", [](const codes& x, const codes& y, const codes&, codes& o, const bulk::execution& h) { bulk::multiply(x, y, o, h); },
       [](std::uint64_t x, std::uint64_t y, std::uint64_t) { return multiply(half, x, y); }},
      {"divide", [](const codes& x, const codes& y, const codes&, codes& o, const bulk::execution& h) { bulk::divide(x, y, o, h); },
       [](std::uint64_t x, std::uint64_t y, std::uint64_t) { return divide(half, x, y); }},
      {"sqrt", [](const codes& x, const codes&, const codes&, codes& o, const bulk::execution& h) { bulk::sqrt(x, o, h); },
       [](std::uint64_t x, std::uint64_t, std::uint64_t) { return square_root(half, x); }},
      {"fma", [](const codes& x, const codes& y, const codes& z, codes& o, const bulk::execution& h) { bulk::fma(x, y, z, o, h); },
       [](std::uint64_t x, std::uint64_t y, std::uint64_t z) { return fused_multiply_add(half, x, y, z); }}};
  codes got(a.size());
  for (const auto& t : cases) {
    codes expected(a.size());
    for (std::size_t j = 0; j < a.size(); ++j) expected[j] = static_cast<std::uint16_t>(t.define(a[j], b[j], c[j]));
    for (const auto set : bulk_cases::sets()) {
      for (const int direction : {FE_TONEAREST, FE_UPWARD}) {
        std::fesetround(direction);
        t.run(a, b, c, got, {.threads = 2, .set = set});
        std::fesetround(FE_TONEAREST);
        std::size_t j = 0;
        while (j + 1 < a.size() && got[j] == expected[j]) ++j;
        INFO(t.name << " set=" << bulk_cases::name_of(set) << std::hex << " a=0x" << a[j] << " b=0x" << b[j] << " c=0x"
                    << c[j] << " expected=0x" << expected[j] << " got=0x" << got[j]);
        CHECK(got[j] == expected[j]);
      }
    }
  }
}

}  // namespace
