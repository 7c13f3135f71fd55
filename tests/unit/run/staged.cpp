// Stages in the format or exact: all of them are the plain run, none is the exact one.
#include <bit>

#include "io/error.hpp"
#include "run/blame.hpp"
#include "run/stages.hpp"
#include "support/catch.hpp"
#include "unit/run/frames.hpp"

using namespace bitshade;

namespace {

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::bit_cast<std::uint64_t>(a[i]) != std::bit_cast<std::uint64_t>(b[i])) return false;
  }
  return true;
}

cell plain(const frame& scene, const configuration& how) {
  return run_pipeline(scene, how, make_plan(scene, how));
}

std::vector<configuration> configurations() {
  std::vector<configuration> all;
  configuration c;
  c.blur_taps = 5;
  all.push_back(c);
  c.method = technique::lvsm;
  c.layers = 3;
  c.overlap = 0.0625;
  all.push_back(c);
  c.transition = true;
  c.bleeding_reduction = 0.2;
  all.push_back(c);
  c.transition = false;
  c.filter = texel_filter::trilinear;
  all.push_back(c);
  c.max_anisotropy = 4;
  c.second = second_moment::square_of_stored;
  all.push_back(c);
  c = {};
  c.second = second_moment::centred;
  c.filter = texel_filter::nearest;
  all.push_back(c);
  c = {};
  c.method = technique::evsm4;
  c.min_variance = 1e-4;
  all.push_back(c);
  c.method = technique::evsm2;
  c.filter = texel_filter::trilinear;
  all.push_back(c);
  // Filters before shading, lookups and slopes.
  for (const technique method : {technique::vsm, technique::lvsm, technique::evsm4}) {
    c = {};
    c.method = method;
    c.layers = method == technique::lvsm ? 2 : 1;
    c.blur_taps = 5;
    c.slope_term = true;
    c.filtered.way = blur_way::one_pass;
    all.push_back(c);
    c.filtered.way = blur_way::linear;
    c.filtered.msaa = 4;
    all.push_back(c);
    c.filtered = {2, blur_shape::box, blur_way::separable, 8, 3};
    c.transition = true;
    c.bleeding_reduction = 0.25;
    all.push_back(c);
  }
  c = {};
  c.method = technique::lvsm;
  c.layers = 2;
  c.warping = layer_warp::unclamped;
  all.push_back(c);
  // Rectangles of sums.
  c = {};
  c.method = technique::savsm;
  all.push_back(c);
  c.smallest_box = 1;
  c.slope_term = true;
  all.push_back(c);
  c.smallest_box = 3;
  c.filtered.msaa = 4;
  c.bleeding_reduction = 0.25;
  c.second = second_moment::square_of_stored;
  all.push_back(c);
  c.second = second_moment::centred;
  all.push_back(c);
  for (const technique method : {technique::esm, technique::csm, technique::msm}) {
    c = {};
    c.method = method;
    all.push_back(c);
    c.blur_taps = 5;
    c.filter = texel_filter::trilinear;
    c.bleeding_reduction = 0.25;
    c.terms = 2;
    c.optimised_basis = false;
    all.push_back(c);
    c.filter = texel_filter::bilinear;
    c.filtered = {2, blur_shape::box, blur_way::one_pass, 8, 3};
    c.bound = moment_bound::hausdorff;
    all.push_back(c);
  }
  return all;
}

}  // namespace

TEST_CASE("with every stage in the format a staged run is the plain run, bit for bit") {
  const auto scene =
      test::with_samples(test::with_samples(test::small_frame(16, 16, 60, 21), 2, 26), 4, 27);
  for (auto how : configurations()) {
    std::vector<const char*> formats{"unorm16", "half", "binary32", "e5m7"};
    if (how.method == technique::savsm)  // codes of every type, and sums in binary64
      formats.insert(formats.end(), {"unorm8", "unorm32", "snorm16", "ufixed2.14", "ufixed2.38", "binary64"});
    for (const auto* format : formats) {
      how.format = format;
      CAPTURE(how.key());
      CHECK(same_bits(run_staged(scene, how, {}).visibility, plain(scene, how).visibility));
    }
  }
}

TEST_CASE("with no stage in the format a staged run is the exact run, bit for bit") {
  const auto scene =
      test::with_samples(test::with_samples(test::small_frame(16, 16, 60, 22), 2, 28), 4, 29);
  for (auto how : configurations()) {
    auto exact = how;
    exact.format = "exact";
    for (const auto* format : {"half", "unorm16"}) {
      how.format = format;
      CAPTURE(how.key());
      CHECK(same_bits(run_staged(scene, how, {stage_set::none(), 0, {}}).visibility,
                      plain(scene, exact).visibility));
    }
  }
}

TEST_CASE("a stage alone in the format errs by what it does, and no more than it does") {
  const auto scene = test::small_frame(32, 16, 300, 23);
  configuration how;
  how.format = "unorm8";
  const blame b = blame_of(scene, how, {});
  REQUIRE(b.stages.size() == 5);
  CHECK(b.whole.largest > 0);
  const auto of = [&](stage s) {
    for (const auto& one : b.stages) {
      if (one.which == s) return one;
    }
    FAIL("no stage " << name_of(s));
    return b.stages.front();
  };
  // Eight bits in the store, 24 in the arithmetic: whoever blames the shading is wrong.
  CHECK(of(stage::store).alone.rmse > 100 * of(stage::shading).alone.rmse);
  CHECK(of(stage::blur).alone.rmse > 100 * of(stage::filter).alone.rmse);
  CHECK(of(stage::shading).without.rmse == Approx(b.whole.rmse).epsilon(0.01));
  CHECK(of(stage::weights).alone.largest == 0);  // 32 and 16 texels: no rounding at all

  stage_choices coarse;
  coarse.weight_bits = 4;
  coarse.shading = binary16::value;
  const blame c = blame_of(scene, how, coarse);
  for (const auto& one : c.stages) {
    if (one.which == stage::weights) CHECK(one.alone.largest > 0);
    if (one.which == stage::shading) CHECK(one.alone.rmse > 100 * of(stage::shading).alone.rmse);
  }
}

TEST_CASE("Lloyd's reduction is a stage where splits are relaxed") {
  const auto scene = test::small_frame(32, 16, 100, 24);
  configuration how;
  how.method = technique::lvsm;
  how.layers = 3;
  how.splits = split_rule::lloyd;
  const auto stages = stages_of(how);
  REQUIRE(stages.front() == stage::splits);
  CHECK(same_bits(run_staged(scene, how, {}).visibility, plain(scene, how).visibility));
}

TEST_CASE("samples are resolved in a stage of their own, and a box of eight bits is guilty there") {
  const auto scene = test::with_samples(test::small_frame(16, 16, 100, 25), 8, 30);
  configuration how;
  how.format = "unorm8";
  how.filtered.msaa = 8;
  how.blur_taps = 0;
  const blame b = blame_of(scene, how, {});
  REQUIRE(b.stages.size() == 5);
  CHECK(b.stages[1].which == stage::resolve);
  CHECK(b.stages[1].alone.rmse > 100 * b.stages[4].alone.rmse);
}

TEST_CASE("running sums are a stage where their store loses something, and the guilty one in half") {
  const auto scene = test::small_frame(64, 48, 200, 26);
  configuration how;
  how.method = technique::savsm;
  how.format = "half";
  const blame b = blame_of(scene, how, {});
  REQUIRE(b.stages.size() == 4);
  CHECK(b.stages[1].which == stage::sums);
  CHECK(b.guiltiest().which == stage::sums);
  CHECK(b.stages[1].alone.rmse > 10 * b.stages[0].alone.rmse);
  // Of exact corners a difference in binary32 costs what its own two roundings cost.
  CHECK(b.stages[2].which == stage::filter);
  CHECK(b.stages[2].alone.rmse < 1e-3 * b.stages[1].alone.rmse);
  CHECK(b.stages[2].alone.rmse > 0);
  CHECK(b.stages[1].without.rmse < b.whole.rmse / 10);

  // Sums of codes lose nothing: what is left is the store's, and the arithmetic's.
  how.format = "unorm8";
  const blame codes = blame_of(scene, how, {});
  REQUIRE(codes.stages.size() == 3);
  CHECK(codes.stages[0].which == stage::store);
  CHECK(codes.stages[1].which == stage::filter);
  CHECK(codes.stages[0].alone.rmse > 100 * codes.stages[1].alone.rmse);
  CHECK(codes.stages[0].alone.rmse == Approx(codes.whole.rmse).epsilon(0.01));
}

TEST_CASE("sums that overflow their format are refused, whatever stages are exact") {
  const auto scene = test::small_frame(300, 219, 4, 27);
  configuration how;
  how.method = technique::savsm;
  how.format = "half";
  CHECK_THROWS_AS(run_staged(scene, how, {}), usage_error);
  CHECK_THROWS_AS(run_staged(scene, how, {stage_set::only(stage::store), 0, {}}), usage_error);
}

TEST_CASE("stages that cannot be taken apart are refused with a cure") {
  const auto scene = test::small_frame(8, 8, 4, 25);
  configuration how;
  for (const technique method : {technique::pcf, technique::hard, technique::deep}) {
    how.method = method;
    CHECK_THROWS_AS(run_staged(scene, how, {}), usage_error);
  }
  how = {};
  how.format = "exact";
  CHECK_THROWS_AS(run_staged(scene, how, {}), usage_error);
}
