// The fast exact path against rationals, bit for bit.
#include "support/catch.hpp"

#include <cmath>
#include <cstdint>
#include <random>

#include "bitshade/interop/rational.hpp"
#include "bitshade/texture/certified.hpp"

using namespace bitshade;

namespace {

template <class R>
void compare(const exact_source& in, std::mt19937& random, int coordinate_bits, int count,
             certified_counts& counts, double border = 0) {
  const address modes[] = {address::clamp, address::repeat, address::mirror, address::border};
  for (int i = 0; i < count; ++i) {
    const auto draw = [&] {
      const auto steps =
          static_cast<std::int64_t>(random() % (std::uint64_t{3} << coordinate_bits));
      return static_cast<float>(std::ldexp(static_cast<double>(steps), -coordinate_bits) - 1);
    };
    const float u = draw(), v = draw();
    const address mode = modes[random() % 4];
    const R fast = bilinear_certified<R, exact_rational>(in, u, v, mode, 0, border, &counts);
    const R slow = bilinear_rational<R, exact_rational>(in, u, v, mode, 0, border);
    CAPTURE(std::to_string(u), std::to_string(v), static_cast<int>(mode));
    REQUIRE(fast == slow);
    REQUIRE(std::signbit(fast) == std::signbit(slow));
  }
}

}  // namespace

TEST_CASE("certified bilinear equals rationals bit for bit: codes, floats, ties, zeros") {
  std::mt19937 random(7);
  certified_counts counts;
  image<float> codes(7, 5, 1), halves(8, 8, 1), wild(4, 4, 1), signs(4, 4, 1);
  for (float& t : codes.texels) t = static_cast<float>(random() & 0xffff);
  for (float& t : halves.texels) t = static_cast<float>(random() & 0x7ff) * 0x1p-11f;
  for (float& t : wild.texels)
    t = std::ldexp(static_cast<float>(random() & 0xffffff), static_cast<int>(random() % 60) - 90);
  for (float& t : signs.texels) t = static_cast<float>(static_cast<int>(random() % 3) - 1);
  const exact_source sources[] = {{&codes, 65535}, {&halves, 1}, {&wild, 1}, {&signs, 32767}};
  for (const exact_source& in : sources) {
    for (const int bits : {1, 4, 8, 20, 23}) {
      compare<float>(in, random, bits, 60, counts, in.divisor == 65535 ? 1.0 / 3 : 0.25);
      compare<double>(in, random, bits, 60, counts, 0);
    }
  }
  CAPTURE(counts.fast, counts.integer, counts.rational);
  CHECK(counts.fast > 0);
  CHECK(counts.integer > 0);  // ties and zeros are there
}

TEST_CASE("certified bilinear: coordinates and texels beyond the fast ways reach rationals") {
  image<float> far(2, 1, 1);
  far.at(0, 0) = 0x1p-140f;
  far.at(1, 0) = 0x1p100f;
  certified_counts counts;
  const exact_source in{&far, 1};
  const auto both = [&](float u) {
    const float fast =
        bilinear_certified<float, exact_rational>(in, u, 0.5f, address::clamp, 0, 0, &counts);
    CHECK(fast == bilinear_rational<float, exact_rational>(in, u, 0.5f, address::clamp, 0));
  };
  both(0.5f);
  both(0x1.8p-100f);
  both(0.25f + 0x1p-24f);
  CHECK(counts.rational >= 1);
}

TEST_CASE("random uniform samples of unorm16 and binary32 hardly ever leave the fast path") {
  std::mt19937 random(3);
  image<float> codes(64, 64, 2), floats(64, 64, 2);
  for (float& t : codes.texels) t = static_cast<float>(random() & 0xffff);
  for (float& t : floats.texels) t = static_cast<float>(random() >> 8) * 0x1p-24f;
  certified_counts counts;
  for (int i = 0; i < 200000; ++i) {
    const float u = static_cast<float>(random() >> 8) * 0x1p-24f,
                v = static_cast<float>(random() >> 8) * 0x1p-24f;
    bilinear_certified<float, exact_rational>({&codes, 65535}, u, v, address::repeat, 1, 0,
                                              &counts);
    bilinear_certified<float, exact_rational>({&floats, 1}, u, v, address::repeat, 0, 0, &counts);
  }
  CHECK(counts.integer + counts.rational < 40);
}
