// Every technique in every format with every option that it takes, on a tiny map: light in [0,1],
// and no farther from exact arithmetic than the format's roundings can bring it.
#include <cmath>
#include <functional>
#include <random>

#include "bitshade/formats/decode.hpp"
#include "bitshade/formats/name.hpp"
#include "bitshade/study/bounds.hpp"
#include "bitshade/study/bounds_visibility.hpp"
#include "bitshade/study/precision_stages.hpp"
#include "run/pipeline.hpp"
#include "support/catch.hpp"

using namespace bitshade;

namespace {

constexpr const char* formats[] = {"unorm8",   "unorm16", "unorm24",  "snorm16",  "half",
                                   "bfloat16", "e5m7",    "binary32", "binary64", "fixed16.16"};

/// Room for binary32's own arithmetic, 64 roundings of numbers up to 1: far more than any moment's
/// way or light has.
constexpr double arithmetic = 64 * 0x1p-24;

/// 16 x 16 texels at multiples of 1/16, with two more maps as samples; receivers half way between
/// two such depths, so that no rounding here turns a comparison, and at both ends.
frame tiny() {
  std::mt19937 random(7);
  const auto map = [&] {
    image<float> depth(16, 16);
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 16; ++x) {
        const bool plate = (x / 4 + y / 5) % 2 == 0;
        const float slant = static_cast<float>(x + y) / 64;
        depth.at(x, y) = std::round(16 * (plate ? 0.25F : 0.5F + slant)) / 16;
        if (random() % 10 == 0) depth.at(x, y) = static_cast<float>(random() % 17) / 16;
      }
    }
    return depth;
  };
  frame scene;
  scene.name = "tiny";
  scene.depth = map();
  scene.surface = image<std::uint32_t>(16, 16, 1, 1);
  for (const sample_position at : sample_pattern(2)) {
    scene.samples[2].push_back({map(), scene.surface, at});
  }
  scene.view_width = 36;
  scene.view_height = 1;
  for (int i = 0; i < 36; ++i) {
    receiver r;
    r.u = static_cast<float>(random() >> 8) * 0x1p-24F;
    r.v = static_cast<float>(random() >> 8) * 0x1p-24F;
    r.t = i < 32 ? (static_cast<float>(i % 16) + 0.5F) / 16 : static_cast<float>(i % 2);
    r.du_dx = r.dv_dy = 0.1F;
    r.du_dy = 0.2F;
    r.surface = 2;
    scene.receivers.push_back(r);
  }
  return scene;
}

struct variant {
  const char* name;
  std::function<void(configuration&)> change;
};

std::vector<variant> variants_of(technique t) {
  using c = configuration;
  std::vector<variant> all{{"as it is", [](c&) {}}};
  const auto add = [&](bool takes, const char* name, auto change) {
    if (takes) all.push_back({name, change});
  };
  add(blurs_its_map(t), "trilinear, 4 probes",
      [](c& h) { h.filter = texel_filter::trilinear, h.max_anisotropy = 4; });
  add(blurs_its_map(t), "one-pass blur", [](c& h) { h.filtered.way = blur_way::one_pass; });
  add(blurs_its_map(t), "linear blur", [](c& h) { h.filtered.way = blur_way::linear; });
  add(has_kernel(t), "nearest, box blur",
      [](c& h) { h.filter = texel_filter::nearest, h.filtered.shape = blur_shape::box; });
  add(takes_samples(t), "two samples", [](c& h) { h.filtered.msaa = 2; });
  add(averages_lookups(t), "nine lookups", [](c& h) { h.filtered.lookups = 3; });
  add(!compares_depths(t), "less bleeding", [](c& h) { h.bleeding_reduction = 0.3; });
  add(!compares_depths(t), "less bleeding by a power",
      [](c& h) { h.bleeding_power = 1.3, h.bleeding_lift = 0.65; });
  add(compares_depths(t), "a depth bias", [](c& h) { h.depth_bias = 1e-3; });
  add(uses_floor(t), "slope term", [](c& h) { h.slope_term = true; });
  add(stores_variance(t), "square of stored",
      [](c& h) { h.second = second_moment::square_of_stored; });
  add(stores_variance(t), "centred", [](c& h) { h.second = second_moment::centred; });
  add(t == technique::savsm, "small boxes", [](c& h) { h.smallest_box = 2; });
  add(t == technique::msm, "dense, hausdorff",
      [](c& h) { h.optimised_basis = false, h.bound = moment_bound::hausdorff; });
  if (t != technique::lvsm) return all;
  for (const int layers : {1, 3, 4}) {
    all.push_back({"layers", [layers](c& h) { h.layers = layers; }});
  }
  add(true, "transition", [](c& h) { h.transition = true; });
  add(true, "packed", [](c& h) { h.one_pass = true, h.layers = 3; });
  add(true, "direct index", [](c& h) { h.direct_index = true; });
  add(true, "all nearer layers", [](c& h) { h.lookup = layer_lookup::nearer, h.layers = 4; });
  add(true, "all layers", [](c& h) { h.lookup = layer_lookup::every, h.layers = 4; });
  add(true, "manual, no overlap", [](c& h) {
    h.splits = split_rule::manual, h.manual_splits = {0.6}, h.overlap = 0;
  });
  for (const split_rule rule :
       {split_rule::lloyd, split_rule::lloyd_view, split_rule::optimal, split_rule::receivers}) {
    all.push_back({"split rule", [rule](c& h) { h.splits = rule, h.layers = 3; }});
  }
  return all;
}

configuration usual(technique t) {
  configuration how;
  how.method = t;
  how.layers = t == technique::lvsm ? 2 : 1;
  how.overlap = 0.0625;
  how.blur_taps = 3;
  how.min_variance = 1e-3;
  how.exponent = how.negative_exponent = 4;
  how.terms = 3;
  how.smallest_box = 3;
  return how;
}

/// How often a value is rounded to the format: store, resolve, two passes, four mips.
int roundings(const configuration& how) {
  if (how.method == technique::savsm) return how.filtered.msaa > 1 ? 2 : 1;
  return 3 + (how.filtered.msaa > 1 ? 1 : 0) + (how.filter == texel_filter::trilinear ? 4 : 0);
}

/// The largest change of a light by the format; infinity where theory gives none: four moments
/// ([LauritzenMcCool08] section 2 calls them unstable), exponentials in fixed steps, float sums.
double largest_error(const configuration& how) {
  const encoding e = *parse_encoding(how.format);
  const bool binary = e.kind == family::binary;
  const double u = binary ? std::ldexp(1.0, -e.fraction_bits - 1) : 0;
  const int k = roundings(how);
  // On [1/2, 1] a binary format's half step is u/2, and nowhere below is it more.
  const double off = k * (binary ? u / 2 : decode(e, 1) / 2) + arithmetic;
  const double none = std::numeric_limits<double>::infinity();
  const auto relative = [&] { return std::pow(1 + u, k) - 1 + arithmetic; };
  double error = none;
  switch (how.method) {
    case technique::hard:
      return 0;
    case technique::pcf:
      return arithmetic;
    case technique::deep:
      return arithmetic + (binary ? u / 2 : decode(e, 1) / 2);
    case technique::savsm:
      if (binary) break;
      [[fallthrough]];
    case technique::vsm:
    case technique::lvsm:
      // A layer's floor is min_variance over its squared width, never less than this.
      error = visibility_error(variance_error(off, 1.0).width(), off, how.min_variance) + arithmetic;
      break;
    case technique::evsm2:
    case technique::evsm4:
      if (!binary) break;
      error = evsm_error_at(u + arithmetic / k, k, how.exponent, std::sqrt(how.min_variance)) +
              arithmetic;
      break;
    case technique::esm:
      if (binary) error = relative();
      break;
    case technique::csm: {
      // Two shares of at most sqrt 2 together, doubled if biased, times gain 2 and 2/((2k - 1) pi).
      const bool biased = !(e.has_sign && e.kind != family::unorm && e.kind != family::ufixed);
      error = arithmetic;
      for (int n = 1; n <= how.terms; ++n) {
        error += 2 * 2 / ((2 * n - 1) * 3.14159) * std::sqrt(2.0) * (biased ? 2 : 1) * off;
      }
      break;
    }
    default:
      break;
  }
  if (how.bleeding_reduction > 0) error /= 1 - how.bleeding_reduction;
  return error * how.bleeding_power;  // of p^a, a >= 1, the slope is at most a
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("T1-T14: every technique, every format, every option that it takes",
                       "[techniques]", ((technique T), T), technique::hard, technique::pcf,
                       technique::vsm, technique::savsm, technique::lvsm, technique::evsm2,
                       technique::evsm4, technique::esm, technique::csm, technique::msm,
                       technique::deep) {
  const frame scene = tiny();
  const auto run = [&](const configuration& how) {
    return run_pipeline(scene, how, make_plan(scene, how), 1);
  };
  for (const variant& v : variants_of(T)) {
    configuration how = usual(T);
    v.change(how);
    how.format = "exact";
    const auto exact = run(how);
    for (const double p : exact.visibility) REQUIRE((p >= 0 && p <= 1));
    for (const char* const format : formats) {
      how.format = format;
      const auto got = run(how);
      // Splits that are searched by a format's own errors are another configuration.
      const double most = got.splits == exact.splits ? largest_error(how) : 1;
      for (std::size_t i = 0; i < got.visibility.size(); ++i) {
        const double p = got.visibility[i], error = std::fabs(p - exact.visibility[i]);
        CAPTURE(v.name, how.key(), i, p, exact.visibility[i], most);
        REQUIRE((p >= 0 && p <= 1));
        REQUIRE(error <= most);
        if (how.format == "binary64" && T != technique::msm) REQUIRE(error <= 1e-6);
      }
    }
  }
}
