// Every preset before both judges of the Khronos conformance suite.
#include <cmath>
#include <random>

#include "bitshade/interop/rational.hpp"
#include "bitshade/texture/device_sampler.hpp"
#include "bitshade/texture/exact_sampler.hpp"
#include "support/catch.hpp"
#include "support/filter_judge.hpp"

using namespace bitshade;
using namespace bitshade::test;

namespace {

struct verdict {
  int search = 0, strict8 = 0, strict16 = 0, carries = 0, strict8_without_carry = 0;  ///< refusals
};

constexpr int lookups = 400;

verdict judge(const filter_model& model, const encoding& e) {
  const texel_format format = uniform_format(e, e == unorm8::value ? 1 : 2);
  std::mt19937 random(11);
  coded_image codes(16, 16, format.channels);
  for (auto& t : codes.texels)
    t = is_norm(e) ? random() & low_bits(e.width)
                   : encode(e, static_cast<double>(random() >> 8) * 0x1p-24);
  const image<double> truth = load_image<double>(preset_detail::exact(), format, codes);
  const device_sampler device(model, format, {codes}, {});
  const exact_sampler<exact_rational> exact(format, {codes}, {});
  // The largest step in [0, 1], and the bits that the suite takes for results.
  const int bits = is_norm(e) ? e.width : e.fraction_bits;
  const double step =
      is_norm(e) ? 1.0 / static_cast<double>(low_bits(bits)) : std::ldexp(1.0, -bits - 1);
  verdict result;
  for (int i = 0; i < lookups; ++i) {
    float u = static_cast<float>(random() >> 8) * 0x1p-24f;
    const float v = static_cast<float>(random() >> 8) * 0x1p-24f;
    // Every eighth lookup lies just below a texel's centre, where nearest carries.
    if (i % 8 == 0) u = (static_cast<float>(random() % 15) + 1.5f - 0x1p-10f) / 16;
    std::vector<double> got;
    for (int c = 0; c < format.channels; ++c)
      got.push_back(model.name == "exact" ? exact.lod(u, v, 0, c) : device.lod(u, v, 0, c));
    // The suite's colour threshold is a step and a half of the format.
    if (!search_accepts(truth, u, v, address::clamp, got, {20, 7, 1.5 * step})) ++result.search;
    const bool strict = strict_accepts(truth, u, v, address::clamp, got, {8, step, bits});
    if (!strict) ++result.strict8;
    if (!strict_accepts(truth, u, v, address::clamp, got, {bits, step, bits})) ++result.strict16;
    const auto carries = [](float x) {  // nearest to 8 bits crosses into the next texel
      const double at = static_cast<double>(x) * 16 - 0.5;
      return at - std::floor(at) >= 1 - 0x1p-9;
    };
    const bool carry = carries(u) || carries(v);
    result.carries += carry ? 1 : 0;
    if (!strict && !carry) ++result.strict8_without_carry;
  }
  return result;
}

}  // namespace

TEST_CASE("the range search accepts every preset") {
  for (const filter_model& model : presets) {
    const verdict v =
        judge(model, model.order == accumulation::lerp_codes ? unorm8::value : unorm16::value);
    CAPTURE(std::string(model.name));
    CHECK(v.search == 0);
  }
}

TEST_CASE("the strict model: 8-bit floor passes, 8-bit nearest fails at carries alone") {
  const verdict floor8 = judge(*find_preset("vulkan-strict"), unorm16::value);
  CHECK(floor8.strict8 == 0);
  CHECK(floor8.carries >= lookups / 8);
  const verdict nearest8 = judge(*find_preset("d3d11"), unorm16::value);
  CHECK(nearest8.strict8_without_carry == 0);
  CHECK(nearest8.strict8 > 0);
  CHECK(nearest8.strict8 <= nearest8.carries);
}

TEST_CASE("the strict model: full weights pass on a grid as fine as the format, not on 8 bits") {
  for (const char* name : {"exact", "llvmpipe", "softpipe", "swiftshader"}) {
    const verdict v = judge(*find_preset(name), unorm16::value);
    CAPTURE(name);
    CHECK(v.strict16 == 0);
    CHECK(v.strict8 > lookups / 2);  // a device so precise has to declare its precision
  }
}

TEST_CASE("the strict model on the presets left: cuda's 1.8 weights and llvmpipe's 8-bit path") {
  // Weights rounded to nearest may reach 1, the same value as a carry.
  const verdict cuda = judge(*find_preset("cuda"), unorm16::value);
  CHECK(cuda.strict8_without_carry == 0);
  CHECK(cuda.strict8 <= cuda.carries);
  const verdict r8 = judge(*find_preset("llvmpipe-r8"), unorm8::value);
  CAPTURE(r8.strict8);
  CHECK(r8.strict8_without_carry == 0);
}

TEST_CASE("both models on half textures: as on unorm16, in every preset that takes them") {
  for (const filter_model& model : presets) {
    if (model.order == accumulation::lerp_codes) continue;
    const verdict v = judge(model, binary16::value);
    CAPTURE(std::string(model.name));
    CHECK(v.search == 0);
    const bool coarse = model.grid_bits > 0 || model.weight_bits > 0;
    CHECK(v.strict8_without_carry <= (coarse ? 0 : lookups));
    if (model.name == "vulkan-strict") CHECK(v.strict8 == 0);
    if (!coarse) CHECK(v.strict16 == 0);
  }
}

TEST_CASE("both judges refuse a filter that is wrong") {
  filter_model coarse = *find_preset("vulkan-strict");
  coarse.grid_bits = 3;
  const verdict v = judge(coarse, unorm16::value);
  CHECK(v.search > 0);
  CHECK(v.strict8 > 0);
}
