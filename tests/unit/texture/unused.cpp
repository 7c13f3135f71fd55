// What a stage does not need, it does not do: operations counted, texels counted. And every stage
// in every kind of number.
#include <cmath>

#include "bitshade/arithmetic/counted.hpp"
#include "bitshade/arithmetic/interval.hpp"
#include "bitshade/arithmetic/real.hpp"
#include "bitshade/interop/rational.hpp"
#include "bitshade/texture/blur_variants.hpp"
#include "bitshade/texture/resolve.hpp"
#include "bitshade/texture/sampler.hpp"
#include "bitshade/texture/sat.hpp"
#include "bitshade/texture/trilinear.hpp"
#include "support/catch.hpp"

using namespace bitshade;

namespace {

using number = counted<double>;

image<number> counting(int w, int h, operation_counts& where) {
  image<number> out(w, h);
  for (std::size_t i = 0; i < out.texels.size(); ++i)
    out.texels[i] = number(static_cast<double>(i % 7) / 8, &where);
  return out;
}

std::vector<image<number>> counting_chain(int size, operation_counts& where) {
  std::vector<image<number>> chain;
  for (; size > 0; size /= 2) chain.push_back(counting(size, size, where));
  return chain;
}

}  // namespace

TEST_CASE("a nearest lookup computes nothing with texels") {
  operation_counts count;
  const auto in = counting(8, 8, count);
  sampler_state state;
  state.linear = false;
  const number got = sample_level<number>({}, in, number(0.3), number(0.6), state, 0);
  CHECK(got.value() == in.at(2, 4).value());
  CHECK(count.operations == 0);
}

TEST_CASE("a fraction of 0 reads one level, one probe is one lookup, no mips are no mips") {
  operation_counts count;
  const auto chain = counting_chain(8, count);
  const std::span<const image<number>> levels(chain);
  const auto cost = [&](const sampler_state& state, double lambda) {
    count = {};
    sample_lod<number>({}, levels, number(0.3), number(0.6), number(lambda), state, 0);
    return count.operations;
  };
  sampler_state bilinear, trilinear;
  trilinear.mips = mip_selection::linear;
  const auto one = cost(bilinear, 0);
  CHECK(one == 9);  // three lerps of a difference, a product and a sum
  CHECK(cost(bilinear, 2.5) == one);
  CHECK(cost(trilinear, 0) == one);
  CHECK(cost(trilinear, 9) == one);  // the last level alone
  CHECK(cost(trilinear, 1.5) == 2 * one + 3);
  const auto anisotropic = [&](int limit, const gradients& g) {
    count = {};
    sampler_state state = trilinear;
    state.max_anisotropy = limit;
    sample_gradients<number>({}, levels, number(0.3), number(0.6), g, state, 0);
    return count.operations;
  };
  const gradients stretched{0.5, 0, 0, 0.125};
  CHECK(anisotropic(1, {0.125, 0, 0, 0.125}) == one);
  CHECK(anisotropic(4, {0.125, 0, 0, 0.125}) <= one + 2);  // one probe: its weight and its sum
  CHECK(anisotropic(4, stretched) == 4 * (one + 2));
}

TEST_CASE("a blur of one tap, a resolve of one sample and a chain of one texel round nothing") {
  operation_counts count;
  const auto in = counting(5, 1, count);
  std::vector<number> out(5);
  blur_row_x<number>(in, gaussian_kernel(1, 2), address::clamp, 0, out);
  for (std::size_t i = 0; i < 5; ++i) CHECK(out[i].value() == in.texels[i].value());
  const std::vector<image<number>> single{in};
  resolve_row<number>(single, 0, out);
  for (std::size_t i = 0; i < 5; ++i) CHECK(out[i].value() == in.texels[i].value());
  CHECK(count.roundings == 0);
  count = {};
  CHECK(mip_chain(counting(1, 1, count), mip_filter::area, [](std::span<number>) {}).size() == 1);
  CHECK(count.operations == 0);
  // A blur's middle, between borders, is taps products and sums and no more.
  count = {};
  const auto row = counting(64, 1, count);
  std::vector<number> wide(64);
  blur_row_x<number>(row, gaussian_kernel(9, 2), address::clamp, 0, wide);
  CHECK(count.operations == 64 * (9 + 8));
}

TEST_CASE("offsets, blends and borders that are off leave tables and footprints as they are") {
  const image<double> in(6, 4, 1, 0.75);
  const auto sat = make_sat(in, sat_order::running, sat_offset::none, [](std::span<double>) {});
  CHECK(sat.offset[0] == 0);
  CHECK(sat.sums.texels.back() == 18);
  const auto footprint = chain_footprint<double>(8, 8, 4, 0.3, 0.6, {0, {{0, 0}}}, address::clamp);
  CHECK(footprint.size() == 4);
  for (const auto& texel : footprint) CHECK(texel.level == 0);
}

TEMPLATE_TEST_CASE("every stage runs in every kind of number, and keeps what is constant", "",
                   float, double, real<binary16>, real<bfloat16>, real<binary32>, (binary<5, 7>),
                   exact_rational) {
  using T =
      std::conditional_t<std::is_same_v<TestType, binary<5, 7>>, real<binary<5, 7>>, TestType>;
  const T value(0.375), zero(0);
  const image<T> flat(8, 8, 1, value);
  const auto close = [&](const T& x, double slack) {
    return std::fabs(static_cast<double>(x) - 0.375) <= slack;
  };
  const bool exact = std::is_same_v<T, exact_rational>;
  const double step = exact ? 0 : 0x1p-8;  // an ulp of the coarsest here, at 3/8: 2^-9

  const auto chain = mip_chain(flat, mip_filter::box, [](std::span<T>) {});
  for (const auto& level : chain)
    for (const T& x : level.texels) CHECK(x == value);  // sums and quarters of 3/8 are exact
  CHECK(bilinear(flat, locate(T(0.3), T(0.6), 8, 8, address::clamp), 0) == value);
  CHECK(trilinear<T>(chain, T(0.3), T(0.6), {0, 1, 0.25}, address::repeat, 0) == value);
  for (const auto order :
       {accumulation::lerp_fma, accumulation::lerp_mul_add, accumulation::four_products}) {
    filter_model m;
    m.order = order;
    CHECK(close(sample_level<T>(m, flat, T(0.3), T(0.6), {}, 0),
                order == accumulation::four_products ? 2 * step : 0));
  }
  std::vector<T> out(8);
  blur_row_x<T>(flat, gaussian_kernel(5, 1), address::mirror, 3, out);
  CHECK(close(out[3], 4 * step));
  blur_row_square<T>(flat, gaussian_kernel(3, 1), address::mirror, 3, out);
  CHECK(close(out[3], 6 * step));
  blur_row_linear<T>(flat, linear_taps(gaussian_kernel(5, 1), 8), address::clamp, 3, out);
  CHECK(close(out[3], 4 * step));
  blur_column_linear<T>(flat, linear_taps(gaussian_kernel(5, 1), 8), address::clamp, 3, out);
  CHECK(close(out[3], 4 * step));
  for (const std::size_t n : {1u, 2u, 4u, 8u}) {
    const std::vector<image<T>> samples(n, flat);
    resolve_row<T>(samples, 2, out);
    for (const T& x : out) CHECK(x == value);
  }
  for (const auto order :
       {sat_order::running, sat_order::doubling, sat_order::pairwise, sat_order::kahan}) {
    const auto sat = make_sat(flat, order, sat_offset::none, [](std::span<T>) {});
    // Up to 24 in all; 3 (i + 1)(j + 1) needs 8 bits: exact in all of these.
    CHECK(box_mean(sat, 2, 2, 5, 5, 0) == value);
    CHECK(close(rectangle_mean(sat, T(1.5), T(1), T(4.5), T(5), 0), step));
  }
  CHECK(zero == T(0));
}
