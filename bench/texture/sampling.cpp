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

constexpr int n = 65536, texture = 1024;

/// What all rows look at, and where the answers go.
struct lookups {
  image<float> in = moments(texture, texture, 2);
  coordinates at = picture(n, texture);
  std::vector<float> out = std::vector<float>(2 * n);

  std::vector<float> by_template(const filter_model& model, const image<float>& level) const {
    std::vector<float> values(2 * n);
    bulk::sample(model, level, {}, at.u, at.v, values, instruction_set::scalar);
    return values;
  }
  std::vector<float> by_rationals(std::size_t count) const {
    std::vector<float> values(2 * count);
    for (std::size_t i = 0; i < 2 * count; ++i)
      values[i] = bilinear_rational<float, exact_rational>({&in}, at.u[i / 2], at.v[i / 2],
                                                           address::clamp, static_cast<int>(i % 2));
    return values;
  }
  std::string compare(const std::vector<float>& right) const {
    return difference(out.data(), right.data(), right.size());
  }
};

using raw_loop = void (*)(const float*, int, int, const float*, const float*, float*, std::size_t);

/// The rows of one instruction set.
class sampling_rows {
 public:
  sampling_rows(table& to, std::string group, std::shared_ptr<lookups> shared, instruction_set set,
                std::string name)
      : to_(to), group_(std::move(group)), all_(std::move(shared)), set_(set), name_(std::move(name)) {}

  void add(raw_loop loop, raw_loop gathers) {
    const filter_model plain = *find_preset("exact");
    const auto expect_plain = [a = all_, plain] { return a->by_template(plain, a->in); };
    const auto raw = [this, expect_plain](const std::string& name, raw_loop f) {
      const auto work = [a = all_, f] {
        f(a->in.texels.data(), texture, texture, a->at.u.data(), a->at.v.data(), a->out.data(), n);
      };
      row(name, work, expect_plain, "", 0);
    };
    raw("raw loop", loop);
    raw("raw loop, gathers", gathers);
    const auto sampled = [this](const std::string& name, const filter_model& model,
                                const std::string& base, double limit) {
      const auto work = [a = all_, model, set = set_] {
        bulk::sample(model, a->in, {}, a->at.u, a->at.v, a->out, set);
      };
      row(name, work, [a = all_, model] { return a->by_template(model, a->in); }, base, limit);
    };
    sampled("binary32", plain, "raw loop", 1.2);
    for (const char* name : {"d3d11", "vulkan-strict", "cuda"})
      sampled(name, *find_preset(name), "binary32", 2);
    for (const storage& s : storages) {
      const auto codes = std::make_shared<image<std::uint16_t>>(coded(s.code, all_->in));
      const auto work = [a = all_, codes, s, plain, set = set_] {
        bulk::sample(plain, s.code, *codes, {}, a->at.u, a->at.v, a->out, set);
      };
      row(s.name + " texels", work,
          [a = all_, codes, s, plain] { return a->by_template(plain, decoded(s.code, *codes)); },
          "binary32", 1.3);
    }
    const auto certified = [a = all_, set = set_] {
      bulk::sample_certified<exact_rational>({&a->in}, address::clamp, a->at.u, a->at.v, a->out, set);
    };
    const auto exactly = [a = all_] { return a->by_rationals(512); };
    row("exact, certified", certified, exactly, "binary32", 8);
    to_.add({group_, "exact, certified, to rationals" + name_, n, certified, {}, rationals, 1 / 500.0, {}});
  }

  static constexpr const char* rationals = "exact, Boost rationals";

 private:
  void row(const std::string& name, const std::function<void()>& work,
           const std::function<std::vector<float>()>& right, const std::string& base, double limit) {
    const auto check = [a = all_, work, right] {
      work();
      return a->compare(right());
    };
    to_.add({group_, name + name_, n, work, check, base.empty() ? base : base + name_, limit, {}});
  }

  table& to_;
  const std::string group_;
  const std::shared_ptr<lookups> all_;
  const instruction_set set_;
  const std::string name_;
};

}  // namespace

void add_sampling(table& table) {
  const std::string group = "bilinear, 1024^2 x 2, one sample";
  const auto all = std::make_shared<lookups>();
  if (bulk::has(instruction_set::avx512))
    sampling_rows(table, group, all, instruction_set::avx512, ", AVX-512")
        .add(raw_avx512::bilinear_rg, raw_avx512::bilinear_rg_gathers);
  if (bulk::has(instruction_set::avx2))
    sampling_rows(table, group, all, instruction_set::avx2, ", AVX2")
        .add(raw_avx2::bilinear_rg, raw_avx2::bilinear_rg_gathers);
  const auto by_template = [all] { all->out = all->by_template(*find_preset("exact"), all->in); };
  table.add({group, "the template", n, by_template, {}, "binary32, AVX2", 0, {}});
  constexpr std::size_t few = 32;
  table.add({group, sampling_rows::rationals, few,
             [all] {
               const auto values = all->by_rationals(few);
               std::ranges::copy(values, all->out.begin());
             },
             {}, "binary32, AVX2", 0, {}});
}

}  // namespace bench
