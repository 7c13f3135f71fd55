// EVSM, ESM, CSM and four moments as runs: against their definition in every format, against a
// hundred digits in exact arithmetic, and against percentage-closer filtering.
#include <bit>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>

#include "bitshade/arithmetic/real.hpp"
#include "bitshade/shadow/csm.hpp"
#include "bitshade/shadow/esm.hpp"
#include "bitshade/shadow/msm.hpp"
#include "bitshade/texture/blur.hpp"
#include "io/error.hpp"
#include "run/engines.hpp"
#include "support/catch.hpp"
#include "unit/run/frames.hpp"

using namespace bitshade;

namespace {

using big = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<120>,
                                          boost::multiprecision::et_off>;

const std::vector<technique> filtered_techniques{technique::evsm2, technique::evsm4, technique::esm,
                                                 technique::csm, technique::msm};

cell run(const frame& scene, const configuration& how, int threads = 0) {
  return run_pipeline(scene, how, make_plan(scene, how), threads);
}

/// Every channel of one texel, in double.
std::vector<double> texel_of(const configuration& how, double x) {
  const evsm_constants k{how.exponent, how.negative_exponent, 0};
  std::vector<double> v;
  switch (how.method) {
    case technique::evsm2:
    case technique::evsm4:
      v = {positive_warp(x, k), 0};
      v[1] = v[0] * v[0];
      if (how.method == technique::evsm4) {
        v.push_back(negative_warp(x, k));
        v.push_back(v[2] * v[2]);
      }
      return v;
    case technique::esm:
      return {esm_warp(x, {how.exponent, 0})};
    case technique::csm: {
      csm_constants c;
      c.terms = how.terms;
      c.biased = false;
      v.resize(c.channels());
      csm_texel<double>(x, c, v);
      return v;
    }
    default: {
      const auto m = to_basis(moments_of(x), msm_optimised_transform);
      return {m[0], m[1], m[2], m[3]};
    }
  }
}

double light_of(const configuration& how, const std::vector<double>& m, double t) {
  const evsm_constants k{how.exponent, how.negative_exponent, 0};
  switch (how.method) {
    case technique::evsm2:
      return evsm_positive_bound(m[0], m[1], t, k, how.min_variance);
    case technique::evsm4:
      return evsm_bound(evsm_positive_bound(m[0], m[1], t, k, how.min_variance),
                        evsm_negative_bound(m[2], m[3], t, k, how.min_variance));
    case technique::esm:
      return esm_visibility(m[0], t, {how.exponent, 0});
    case technique::csm: {
      csm_constants c;
      c.terms = how.terms;
      c.biased = false;
      return csm_visibility<double>(m, t, c);
    }
    default:
      return hamburger_bound(
          biased(from_basis(std::array{m[0], m[1], m[2], m[3]}, msm_optimised_transform),
                 how.moment_bias),
          centred_depth(t));
  }
}

/// The share of each texel of the map in a plain bilinear lookup over a blurred map, exactly.
std::vector<std::pair<std::pair<int, int>, big>> weights_of(const frame& scene,
                                                            const configuration& how,
                                                            const receiver& r) {
  const int width = scene.depth.width, height = scene.depth.height;
  const kernel blur = gaussian_kernel(how.blurred() ? how.blur_taps : 1, how.blur_sigma);
  const auto at =
      locate(static_cast<double>(r.u), static_cast<double>(r.v), width, height, address::clamp);
  std::vector<std::pair<std::pair<int, int>, big>> result;
  const int radius = blur.radius();
  for (const auto& [cx, wx] : {std::pair{at.x0, 1 - at.fx}, std::pair{at.x1, at.fx}})
    for (const auto& [cy, wy] : {std::pair{at.y0, 1 - at.fy}, std::pair{at.y1, at.fy}})
      for (int j = -radius; j <= radius; ++j)
        for (int i = -radius; i <= radius; ++i) {
          const auto weight = [&](int k) {
            return big(blur.weights[static_cast<std::size_t>(k + radius)]);
          };
          result.push_back(
              {{wrap(cx + i, width, address::clamp), wrap(cy + j, height, address::clamp)},
               big(wx) * big(wy) * weight(i) * weight(j)});
        }
  return result;
}

/// The technique's light from its definition over the footprint, in 120 digits.
big exact_light(const frame& scene, const configuration& how, const receiver& r) {
  const auto footprint = weights_of(scene, how, r);
  const auto mean = [&](auto f) {
    big sum = 0;
    for (const auto& [place, weight] : footprint) {
      sum += weight * f(big(clamp_depth(scene.depth.at(place.first, place.second))));
    }
    return sum;
  };
  const big t = clamp_depth(r.t), c = how.exponent, c2 = how.negative_exponent;
  const auto bound = [&](const big& m1, const big& m2, const big& w, const big& rate) -> big {
    if (w <= m1) return 1;
    const big v =
        std::max<big>(m2 - m1 * m1, std::min<big>(1, how.min_variance * rate * rate) * w * w);
    return v / (v + (w - m1) * (w - m1));
  };
  const auto positive = [&] {
    return bound(mean([&](const big& x) -> big { return exp(c * x); }),
                 mean([&](const big& x) -> big { return exp(2 * c * x); }), exp(c * t), c);
  };
  switch (how.method) {
    case technique::evsm2:
      return positive();
    case technique::evsm4:
      return std::min<big>(
          positive(),
          bound(-mean([&](const big& x) -> big { return exp(-c2 * x); }),
                mean([&](const big& x) -> big { return exp(-2 * c2 * x); }), -exp(-c2 * t), c2));
    case technique::esm:
      return std::min<big>(1, mean([&](const big& x) -> big { return exp(c * (x - t)); }));
    case technique::csm: {
      const big pi = boost::math::constants::pi<big>();
      big f = big(1) / 2;
      for (int k = 1; k <= how.terms; ++k) {
        const big rate = (2 * k - 1) * pi;
        f += 2 / rate * mean([&](const big& x) -> big { return sin(rate * (x - t)); });
      }
      return std::min<big>(1, std::max<big>(0, 2 * f));
    }
    default: {
      const auto power = [&](int n) {
        return mean([&](const big& x) -> big { return pow(big(2 * x - 1), n); });
      };
      const four_moments<big> m{power(1), power(2), power(3), power(4)};
      const big alpha = how.moment_bias, added = alpha * big(msm_bias_even_moment),
                rest = 1 - alpha;
      return hamburger_bound(
          four_moments<big>{rest * m.b1, rest * m.b2 + added, rest * m.b3, rest * m.b4 + added},
          big(2 * t - 1));
    }
  }
}

configuration usual(technique method, const std::string& format) {
  configuration how;
  how.method = method;
  how.format = format;
  how.exponent = 5;
  how.negative_exponent = 4;
  how.terms = 3;
  return how;
}

}  // namespace

TEST_CASE("binary64 runs are the techniques' templates over the same filters, bit for bit") {
  const auto scene = test::small_frame(21, 17, 150, 11);
  for (const technique method : filtered_techniques) {
    const configuration how = usual(method, "binary64");
    const auto got = run(scene, how);
    const std::size_t channels = texel_of(how, 0).size();
    image<double> map(21, 17, static_cast<int>(channels)), across = map;
    for (std::size_t i = 0; i < scene.depth.texels.size(); ++i) {
      const auto texel = texel_of(how, clamp_depth(static_cast<double>(scene.depth.texels[i])));
      std::copy(texel.begin(), texel.end(),
                map.texels.begin() + static_cast<std::ptrdiff_t>(i * channels));
    }
    const kernel blur = gaussian_kernel(how.blur_taps, how.blur_sigma);
    for (int y = 0; y < 17; ++y) blur_row_x<double>(map, blur, address::clamp, y, across.row(y));
    for (int y = 0; y < 17; ++y) blur_row_y<double>(across, blur, address::clamp, y, map.row(y));
    for (std::size_t i = 0; i < scene.receivers.size(); ++i) {
      const receiver& r = scene.receivers[i];
      if (r.surface == 0) {
        REQUIRE(std::isnan(got.visibility[i]));
        continue;
      }
      const auto at = locate<double>(r.u, r.v, 21, 17, address::clamp);
      std::vector<double> filtered;
      for (std::size_t c = 0; c < channels; ++c)
        filtered.push_back(bilinear(map, at, static_cast<int>(c)));
      CAPTURE(std::string(name_of(method)), i);
      REQUIRE(got.visibility[i] == light_of(how, filtered, clamp_depth(static_cast<double>(r.t))));
    }
  }
}

TEST_CASE("exact runs are the correctly rounded value of a hundred digits") {
  const auto scene = test::small_frame(15, 12, 60, 12);
  for (const technique method : filtered_techniques)
    for (const double floor : {0.0, 1e-5}) {
      configuration how = usual(method, "exact");
      how.min_variance = floor;
      how.blur_taps = 5;
      const auto got = run(scene, how);
      CHECK(got.notes.empty());
      for (std::size_t i = 0; i < scene.receivers.size(); ++i) {
        if (scene.receivers[i].surface == 0) continue;
        const big truth = exact_light(scene, how, scene.receivers[i]);
        CAPTURE(std::string(name_of(method)), i, floor, truth.str(30));
        REQUIRE(got.visibility[i] == static_cast<double>(truth));
      }
    }
}

TEST_CASE("a flat map in exact arithmetic: light is 1 in front of it and a step behind") {
  frame scene = test::small_frame(9, 9, 40, 3);
  for (float& x : scene.depth.texels) x = 0.3F;
  for (receiver& r : scene.receivers) r.surface = 1;
  for (const technique method : {technique::evsm2, technique::evsm4, technique::msm}) {
    configuration how = usual(method, "exact");
    how.min_variance = 0;
    how.moment_bias = 0;
    const auto got = run(scene, how);
    CHECK(got.notes.empty());
    for (std::size_t i = 0; i < scene.receivers.size(); ++i) {
      CAPTURE(std::string(name_of(method)), i, scene.receivers[i].t);
      REQUIRE(got.visibility[i] == (scene.receivers[i].t <= 0.3F ? 1 : 0));
    }
  }
}

TEST_CASE("every filter, every format: visibilities in [0,1], the same on any number of threads") {
  const auto scene = test::small_frame(33, 20, 120, 5);
  for (const technique method : filtered_techniques)
    for (const auto& format : {"unorm8", "unorm16", "half", "bfloat16", "binary32", "binary64",
                               "snorm16", "fixed16.16", "fp8_e4m3", "exact"})
      for (const int anisotropy : {1, 4}) {
        configuration how = usual(method, format);
        if (std::string(format) == "fp8_e4m3") how.exponent = how.negative_exponent = 2;
        how.filter = anisotropy > 1 ? texel_filter::trilinear : texel_filter::bilinear;
        how.max_anisotropy = anisotropy;
        const auto one = run(scene, how, 1), two = run(scene, how, 2);
        const auto everything = run_pipeline(scene, how, make_plan(scene, how).everything(), 2);
        CAPTURE(std::string(name_of(method)), format, anisotropy);
        for (std::size_t i = 0; i < scene.receivers.size(); ++i) {
          if (scene.receivers[i].surface == 0) continue;
          REQUIRE((one.visibility[i] >= 0 && one.visibility[i] <= 1));
          REQUIRE(one.visibility[i] == two.visibility[i]);
          REQUIRE(one.visibility[i] == everything.visibility[i]);  // the plan is right
        }
      }
}

TEST_CASE("EVSM and four moments never give less light than percentage-closer filtering, exactly") {
  const auto scene = test::small_frame(19, 16, 150, 21);
  for (const technique method : {technique::evsm2, technique::evsm4, technique::esm}) {
    configuration how = usual(method, "exact");
    how.min_variance = 0;
    const auto got = run(scene, how);
    const auto truth = truth_pcf(scene, how);
    for (std::size_t i = 0; i < truth.size(); ++i) {
      if (scene.receivers[i].surface == 0) continue;
      CAPTURE(std::string(name_of(method)), i);
      // Both sides are rounded once.
      REQUIRE(got.visibility[i] >= truth[i] - 0x1p-53);
    }
  }
}

TEST_CASE("exponents beyond a format's cap are the user's error, with the cap in it") {
  const auto scene = test::small_frame(8, 8, 4, 1);
  configuration how = usual(technique::evsm4, "half");
  how.exponent = 5.55;
  CHECK_THROWS_AS(run(scene, how), usage_error);
  how.exponent = 5.54;
  CHECK_NOTHROW(run(scene, how));
  how.negative_exponent = 6;
  CHECK_THROWS_AS(run(scene, how), usage_error);
  how = usual(technique::esm, "half");
  how.exponent = 11;
  CHECK_NOTHROW(run(scene, how));
  how.exponent = 12;
  CHECK_THROWS_AS(run(scene, how), usage_error);
  how = usual(technique::evsm2, "exact");
  how.exponent = 301;
  CHECK_THROWS_AS(run(scene, how), usage_error);
}
