// The same functions at compile time: each line is a test that the compiler runs.
#include "bitshade/arithmetic/policy.hpp"
#include "bitshade/arithmetic/real.hpp"
#include "bitshade/arithmetic/select.hpp"
#include "bitshade/formats/name.hpp"
#include "bitshade/formats/random.hpp"
#include "bitshade/formats/round_to.hpp"
#include "support/catch.hpp"

namespace {
using namespace bitshade;

static_assert(encode(binary16::value, 1.0) == 0x3c00);
static_assert(decode(unorm16::value, 65535) == 1.0);
static_assert(decode(unorm16::value, 1) == 1.0 / 65535);
static_assert(decode(unorm8::value, 77) == 77.0 / 255);
static_assert(decode(unorm_encoding(32), 1234567) == 1234567.0 / 4294967295.0);
static_assert(encode(fp8_e4m3::value, 448) == 0x7e);
static_assert(encode(fp8_e4m3::value, 464) == 0x7e);
static_assert(encode(fp8_e4m3::value, 464.0625) == 0x7f);
static_assert(encode(unorm16::value, 0.5) == 32768);
static_assert(encode(fixed_encoding(4, 12), -8) == 0x8000);
static_assert(encode(fixed_encoding(4, 12), -1e300) == 0x8000);
static_assert(decode(snorm16::value, 0x8000) == -1);
static_assert(parse_encoding("half") == binary16::value);
static_assert(parse_encoding("fixed4.12") == fixed_encoding(4, 12));
static_assert(!parse_encoding("e12m3") && !parse_encoding("unorm33") && !parse_encoding("unorm8x"));
static_assert(real<binary16>(1) + real<binary16>(0x1p-11) == real<binary16>(1));
static_assert(select(true, 1, 2) == 1);

struct half_filter : policy<unorm16> {
  using filter = real<binary16>;
};
static_assert(numeric_policy<half_filter> && std::is_empty_v<half_filter>);
static_assert(std::is_same_v<half_filter::shade, float> && std::is_same_v<policy<binary64>::shade, double>);
}  // namespace

TEST_CASE("names survive a round trip") {
  for (const auto& known : known_encodings) CHECK(parse_encoding(name_of(known.value)) == known.value);
  for (const char* name : {"e5m7", "unorm12", "snorm9", "ufixed2.30", "fixed4.12", "ue5m6"}) {
    CHECK(name_of(parse_encoding(name).value()) == name);
  }
}
