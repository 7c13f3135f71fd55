// A sampler bound to a model that rounds between: every rounding is one, of an unrounded value.
#include <random>

#include "bitshade/interop/rational.hpp"
#include "bitshade/texture/device_sampler.hpp"
#include "bitshade/texture/exact_mips.hpp"
#include "support/catch.hpp"
#include "support/half_step.hpp"

using namespace bitshade;
using q = exact_rational;

namespace {

/// A rational rounded once to a format, as a number.
q once(const encoding& e, const q& x) { return q(decode(e, encode_exact(e, x))); }

struct subject {
  texel_format format;
  coded_image codes;
  image<q> texels;
};

/// Halves, which are exact in every carrier, or codes.
subject make(const encoding& e) {
  std::mt19937 random(29);
  subject s{uniform_format(e, 1), coded_image(5, 4, 1), image<q>(5, 4)};
  for (std::size_t i = 0; i < 20; ++i) {
    s.codes.texels[i] = encode(e, static_cast<double>(random() >> 8) * 0x1p-24);
    s.texels.texels[i] = q(decode(e, s.codes.texels[i]));
  }
  return s;
}

}  // namespace

TEST_CASE("intermediate roundings in a bound sampler are single ones, to any format") {
  const subject s = make(binary16::value);
  std::mt19937 random(31);
  for (const auto name : test::hard_formats) {
    filter_model m = *find_preset("vulkan-strict");  // weights of 8 bits
    m.rounded_to = test::format_named(name);
    const auto round = [&](const q& x) { return once(m.rounded_to, x); };
    for (const auto how :
         {intermediate::per_lerp, intermediate::per_product, intermediate::result}) {
      // A norm's numbers are no binary64 ones: between two of them a tie may fall to either side.
      if (how != intermediate::result && is_norm(m.rounded_to)) continue;
      m.rounding = how;
      const device_sampler sampler(m, s.format, {s.codes}, {});
      for (int i = 0; i < 60; ++i) {
        const float u = static_cast<float>(random() >> 8) * 0x1p-24f,
                    v = static_cast<float>(random() >> 8) * 0x1p-24f;
        const auto x = locate_axis<float>(m, u, 5, address::clamp),
                   y = locate_axis<float>(m, v, 4, address::clamp);
        const auto between = [&](const q& a, const q& b, float f) {
          const q step = q(f) * (b - a);
          return how == intermediate::per_product ? round(a + round(step))
                 : how == intermediate::per_lerp  ? round(a + step)
                                                  : a + step;
        };
        const auto row = [&](int j) {
          return between(s.texels.at(x.i0, j), s.texels.at(x.i1, j), x.weight);
        };
        q expected = between(row(y.i0), row(y.i1), y.weight);
        if (how == intermediate::result) expected = round(expected);
        CAPTURE(std::string(name), static_cast<int>(how), u, v);
        REQUIRE(sampler.lod(u, v, 0, 0) == certified_detail::nearest_of<float, q>(expected));
      }
    }
  }
}

TEST_CASE("integers scaled last and rounded once to a format: the scaled value is") {
  const subject s = make(unorm_encoding(16));
  filter_model m;
  m.texel = texel_rule::integers;
  m.rounding = intermediate::result;
  m.rounded_to = binary16::value;
  const device_sampler sampler(m, s.format, {s.codes}, {});
  for (int x = 0; x < 5; ++x) {
    const float u = (static_cast<float>(x) + 0.5f) / 5;
    const auto code = static_cast<double>(s.codes.at(x, 2));
    CHECK(static_cast<double>(sampler.lod(u, 0.625f, 0, 0)) ==
          round_to(binary16::value, code * static_cast<double>(1 / 65535.0f)));
  }
}
