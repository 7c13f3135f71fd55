// The fast exact path against rationals, bit for bit.
#include "support/catch.hpp"

#include <algorithm>
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

TEST_CASE("certified bilinear: a place many periods away is the same place") {
  std::mt19937 random(5);
  image<float> codes(7, 5, 1);
  for (float& t : codes.texels) t = static_cast<float>(random() & 0xffff);
  const exact_source in{&codes, 65535};
  const auto both = [&](float u, float v, address mode) {
    const double fast = bilinear_certified<double, exact_rational>(in, u, v, mode, 0);
    CHECK(fast == (bilinear_rational<double, exact_rational>(in, u, v, mode, 0)));
    return fast;
  };
  for (const address mode : {address::repeat, address::mirror}) {
    CAPTURE(static_cast<int>(mode));
    for (const float far : {-0x1p127f, -0x1.8p31f, 0x1.2p30f, 0x1.fffffep127f})  // even numbers
      CHECK(both(far, 0.3f, mode) == both(0, 0.3f, mode));
    CHECK(both(0.3f, 12346.375f, mode) == both(0.3f, 0.375f, mode));
    CHECK(both(-12346.375f, 0.3f, mode) == both(-0.375f, 0.3f, mode));
    CHECK(both(12345.375f, 0.3f, mode) ==
          both(mode == address::repeat ? 0.375f : 0.625f, 0.3f, mode));
  }
  CHECK(both(0x1p100f, -0x1p100f, address::clamp) ==
        decode(unorm_encoding(16), static_cast<std::uint64_t>(codes.at(6, 0))));
  CHECK(both(0x1p100f, 0.3f, address::border) == 0);
}

TEST_CASE("certified bilinear: a border of 53 bits, times the divisor, is not rounded on the way") {
  std::mt19937 random(11);
  certified_counts counts;
  image<float> codes(3, 3, 1);
  for (float& t : codes.texels) t = static_cast<float>(random() & 0x7f);
  for (const double border : {1.0 / 3, -2.0 / 7, 1e-40, 1e39, -1e250, 0x1.fffffefp127})
    for (const double divisor : {1.0, 127.0, 16777215.0}) {
      compare<double>({&codes, divisor}, random, 8, 60, counts, border);
      compare<float>({&codes, divisor}, random, 8, 60, counts, border);
    }
}

TEST_CASE("the errors of both fast ways stay within the bounds that decide") {
  std::mt19937_64 random(13);
  double worst_plain = 0, worst_pairs = 0;
  for (int i = 0; i < 40000; ++i) {
    double texel[4];
    for (double& t : texel) {
      const auto significant = static_cast<double>(random() >> 40);
      t = i % 3 == 0 ? significant : std::ldexp(significant, -static_cast<int>(random() % 30));
      if (i % 2 == 0 && (random() & 1) != 0) t = -t;
    }
    const auto weight = [&] { return static_cast<double>(random() >> 32) * 0x1p-32; };
    const double fx = weight(), fy = weight(), divisor = i % 5 == 0 ? 1 : 16777215;
    const auto q = [](double x) { return exact_rational(x); };
    const exact_rational truth =
        lerp(lerp(q(texel[0]), q(texel[1]), q(fx)), lerp(q(texel[2]), q(texel[3]), q(fx)), q(fy)) /
        q(divisor);
    double most = 0;
    for (const double t : texel) most = std::max(most, std::fabs(t));
    const auto error = [&](const exact_rational& got) {
      return std::fabs(static_cast<double>(got - truth)) * divisor / most;
    };
    const auto plain =
        certified_detail::bilinear_bounded(texel[0], texel[1], texel[2], texel[3], fx, fy, divisor);
    const auto pairs =
        certified_detail::bilinear_pairs(texel[0], texel[1], texel[2], texel[3], fx, fy, divisor);
    worst_plain = std::max(worst_plain, error(q(plain.value)) * 0x1p53);
    worst_pairs = std::max(worst_pairs, error(q(pairs.high) + q(pairs.low)) * 0x1p106);
  }
  CAPTURE(worst_plain, worst_pairs);
  CHECK(worst_plain <= bilinear_bounded_error);
  CHECK(worst_pairs <= bilinear_pairs_error);
  CHECK(worst_plain > 1);  // the search comes near
  CHECK(worst_pairs > 1);
}
