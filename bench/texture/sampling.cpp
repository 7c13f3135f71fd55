// Bilinear lookups against a loop written by hand for one format, and against rationals.
#include "raw/sampling.hpp"
#include "bitshade/interop/rational.hpp"
#include "bitshade/texture/bulk_sampling.hpp"
#include "bitshade/texture/presets.hpp"
#include "texture/images.hpp"

namespace bench {
namespace {

/// Rows of a picture that look at a texture turned by some degrees, a texel a pixel.
struct coordinates {
  std::vector<float> u, v;
};
coordinates picture(int n, int texture) {
  coordinates at;
  for (int i = 0; i < n; ++i) {
    const double x = i % 256 - 128, y = i / 256 - n / 512.0;
    at.u.push_back(static_cast<float>(0.5 + (0.96 * x - 0.28 * y) / texture));
    at.v.push_back(static_cast<float>(0.5 + (0.28 * x + 0.96 * y) / texture));
  }
  return at;
}

}  // namespace

void add_sampling(table& table) {
  const std::string group = "bilinear, 1024^2 x 2, one sample";
  constexpr int n = 65536, texture = 1024;
  const auto in = std::make_shared<image<float>>(moments(texture, texture, 2));
  const auto at = std::make_shared<coordinates>(picture(n, texture));
  const auto out = std::make_shared<std::vector<float>>(2 * n);
  const auto expected = [=](const filter_model& model, const image<float>& level) {
    std::vector<float> values(2 * n);
    bulk::sample(model, level, {}, at->u, at->v, values, instruction_set::scalar);
    return values;
  };
  const auto compare = [=](const std::vector<float>& right) {
    return difference(out->data(), right.data(), right.size());
  };
  const filter_model plain = *find_preset("exact");
  std::string base = "bitshade, binary32";
  if (bulk::has(instruction_set::avx512)) {
    const auto raw = [&](const char* name, auto f) {
      const auto work = [=] {
        f(in->texels.data(), texture, texture, at->u.data(), at->v.data(), out->data(), n);
      };
      table.add({group,
                 name,
                 n,
                 work,
                 [=] {
                   work();
                   return compare(expected(plain, *in));
                 },
                 "raw AVX-512 loop",
                 0,
                 {}});
    };
    raw("raw AVX-512 loop", raw_avx512::bilinear_rg);
    raw("raw AVX-512 loop, gathers", raw_avx512::bilinear_rg_gathers);
  }
  const auto add = [&](const std::string& name, const filter_model& model, const std::string& to,
                       double limit, instruction_set set = instruction_set::best) {
    const auto work = [=] { bulk::sample(model, *in, {}, at->u, at->v, *out, set); };
    table.add({group,
               name,
               n,
               work,
               [=] {
                 work();
                 return compare(expected(model, *in));
               },
               to,
               limit,
               {}});
  };
  add(base, plain, "raw AVX-512 loop", 1.2);
  if (bulk::has(instruction_set::avx2))
    add("bitshade, binary32, AVX2", plain, base, 0, instruction_set::avx2);
  add("the template", plain, base, 0, instruction_set::scalar);
  for (const char* name : {"d3d11", "vulkan-strict", "cuda"})
    add(name, *find_preset(name), base, 2);
  for (const storage& s : storages) {
    const auto codes = std::make_shared<image<std::uint16_t>>(coded(s.code, *in));
    const auto work = [=] { bulk::sample(plain, s.code, *codes, {}, at->u, at->v, *out); };
    table.add({group,
               s.name + " texels",
               n,
               work,
               [=] {
                 work();
                 return compare(expected(plain, decoded(s.code, *codes)));
               },
               base,
               1.3,
               {}});
  }
  const auto exactly = [=](std::size_t count) {
    std::vector<float> values(2 * count);
    for (std::size_t i = 0; i < 2 * count; ++i)
      values[i] = bilinear_rational<float, exact_rational>({in.get()}, at->u[i / 2], at->v[i / 2],
                                                           address::clamp, static_cast<int>(i % 2));
    return values;
  };
  constexpr std::size_t few = 32;
  table.add({group,
             "exact, Boost rationals",
             few,
             [=] {
               *out = exactly(few);
               out->resize(2 * n);
             },
             {},
             base,
             0,
             {}});
  const auto certified = [=] {
    bulk::sample_certified<exact_rational>({in.get()}, address::clamp, at->u, at->v, *out);
  };
  const auto check = [=] {
    certified();
    const auto right = exactly(512);
    return difference(out->data(), right.data(), right.size());
  };
  table.add({group, "exact, certified", n, certified, check, base, 8, {}});
  table.add({group,
             "exact, certified, to Boost rationals",
             n,
             certified,
             check,
             "exact, Boost rationals",
             1 / 500.0,
             {}});
}

}  // namespace bench
