// Images against what memory and a hand-written loop allow: sampling, blur, mip chains, tables.
//
// Limits of bandwidth: a pass at 60 % of a copy's speed takes 1 / 0.6 of its time for the same bytes.
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <string>
#include <thread>

#include "bitshade/formats/name.hpp"
#include "bitshade/formats/random.hpp"
#include "bitshade/interop/rational.hpp"
#include "bitshade/texture/blur.hpp"
#include "bitshade/texture/bulk_sampling.hpp"
#include "bitshade/texture/presets.hpp"
#include "bitshade/texture/sat.hpp"
#include "raw/sampling.hpp"
#include "support/table.hpp"

namespace {

using namespace bitshade;
using bulk::instruction_set;

constexpr double native_limit = 1 / 0.6, stored_limit = 1 / 0.4, scaling_limit = 1 / 0.9;
constexpr int size = 2048;

template <class T>
using shared_image = std::shared_ptr<image<T>>;
template <class T>
shared_image<T> make_image(int w, int h, int channels) {
  return std::make_shared<image<T>>(w, h, channels);
}

/// Depths of a slope with noise, and their squares.
image<float> moments(int w, int h, int channels) {
  image<float> result(w, h, channels);
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const auto at = static_cast<std::uint64_t>(y * w + x);
      const double noise = static_cast<double>(random_bits(1, at) >> 40) * 0x1p-24;
      const auto depth = static_cast<float>(0.2 + 0.3 * x / w + 0.2 * y / h + 0.2 * noise);
      result.at(x, y, 0) = depth;
      if (channels > 1) result.at(x, y, 1) = depth * depth;
    }
  return result;
}

template <class T>
std::string difference(const T* got, const T* expected, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    if (std::memcmp(got + i, expected + i, sizeof(T)) == 0) continue;
    char text[120];
    std::snprintf(text, sizeof text, "value %zu is %a instead of %a", i,
                  static_cast<double>(got[i]), static_cast<double>(expected[i]));
    return text;
  }
  return {};
}
template <class T>
std::string difference(const image<T>& got, const image<T>& expected) {
  return difference(got.texels.data(), expected.texels.data(), expected.texels.size());
}

/// Halves of [0, n) on one or two threads.
void on_threads(int threads, int n, const std::function<void(int, int)>& work) {
  if (threads == 1) return work(0, n);
  const std::jthread other([&] { work(0, n / 2); });
  work(n / 2, n);
}

struct storage {
  std::string name;
  bulk::texel_code code;
};
const storage storages[] = {{"half", {binary16::value, {}}}, {"unorm16", {unorm16::value, {}}}};

image<std::uint16_t> coded(const bulk::texel_code& code, const image<float>& in) {
  image<std::uint16_t> out(in.width, in.height, in.channels);
  bulk::encode(code.format, code.rule, in.texels, std::span(out.texels));
  return out;
}
image<float> decoded(const bulk::texel_code& code, const image<std::uint16_t>& in) {
  image<float> out(in.width, in.height, in.channels);
  bulk::decode(code.format, code.rule, in.texels, std::span(out.texels));
  return out;
}

/// `work(threads)` on one core against `base`, and its gain by a second core against a copy's.
void add_pass(bench::table& table, const std::string& group, const std::string& name,
              double elements, const std::function<void(int)>& work,
              const std::function<std::string()>& check, const std::string& base, double limit) {
  const auto n = static_cast<std::size_t>(elements);
  table.add({group, name, n, [=] { work(1); }, check, base, limit, {}});
  // A second core's share of the time against the share that a copy takes.
  const std::string both = ", two cores";
  table.add({group, name + both, n, [=] { work(2); }, check, name, base.empty() ? 0 : scaling_limit,
             base.empty() ? base : base + both});
}

template <class T>
void add_copy(bench::table& table, const std::string& group, const std::string& name, int channels) {
  auto from = make_image<T>(size, size, channels), to = make_image<T>(size, size, channels);
  const auto work = [=](int threads) {
    on_threads(threads, size, [&](int first, int last) {
      const auto n = static_cast<std::size_t>(last - first) * from->row_size() * sizeof(T);
      std::memcpy(to->row(first).data(), from->row(first).data(), n);
    });
  };
  add_pass(table, group, name, static_cast<double>(from->texels.size()), work, {}, "", 0);
}

image<float> blurred(const image<float>& in, const kernel& w, const std::function<void(std::span<float>)>& store) {
  image<float> across(in.width, in.height, in.channels), out = across;
  for (int y = 0; y < in.height; ++y) {
    blur_row_x<float>(in, w, address::clamp, y, across.row(y));
    store(across.row(y));
  }
  for (int y = 0; y < in.height; ++y) blur_row_y<float>(across, w, address::clamp, y, out.row(y));
  return out;
}

/// Both passes at once: an element is a value of one pass.
void add_blurs(bench::table& table, int channels) {
  const std::string group = "9 x 9 blur, a pass of 2048^2 x " + std::to_string(channels);
  add_copy<float>(table, group, "copy", channels);
  add_copy<std::uint16_t>(table, group, "copy of 16 bits", channels);
  const kernel w = gaussian_kernel(9, 2.0);
  const auto in = std::make_shared<image<float>>(moments(size, size, channels));
  const auto out = make_image<float>(size, size, channels);
  const double elements = 2.0 * static_cast<double>(in->texels.size());
  for (const auto set : {instruction_set::avx512, instruction_set::avx2}) {
    if (!bulk::has(set)) continue;
    const std::string name = set == instruction_set::avx512 ? ", AVX-512" : ", AVX2";
    const auto work = [=](int threads) {
      on_threads(threads, size, [&](int first, int last) {
        bulk::blur(*in, w, address::clamp, {first, last}, *out, set);
      });
    };
    add_pass(table, group, "binary32" + name, elements, work, [=] {
      work(2);
      return difference(*out, blurred(*in, w, [](std::span<float>) {}));
    }, "copy", native_limit);
    for (const storage& s : storages) {
      const auto codes = std::make_shared<image<std::uint16_t>>(coded(s.code, *in));
      const auto result = make_image<std::uint16_t>(size, size, channels);
      const auto pass = [=](int threads) {
        on_threads(threads, size, [&](int first, int last) {
          bulk::blur(s.code, *codes, w, address::clamp, {first, last}, *result, set);
        });
      };
      add_pass(table, group, s.name + name, elements, pass, [=] {
        pass(2);
        const auto store = [&](std::span<float> row) { bulk::round(s.code.format, s.code.rule, row, row); };
        return difference(*result, coded(s.code, blurred(decoded(s.code, *codes), w, store)));
      }, "copy of 16 bits", stored_limit);
    }
  }
}

template <class T>
using chain = std::shared_ptr<std::vector<image<T>>>;
template <class T>
chain<T> chain_of(const image<T>& base) {
  auto levels = std::make_shared<std::vector<image<T>>>(1, base);
  while (levels->back().width > 1) {
    const auto& last = levels->back();
    levels->push_back(image<T>(last.width / 2, last.height / 2, last.channels));
  }
  return levels;
}
/// Down to 64^2 by rows on all threads, the rest on one.
template <class T, class Level>
void fill(std::vector<image<T>>& levels, int threads, Level level) {
  for (std::size_t l = 1; l < levels.size(); ++l) {
    on_threads(levels[l].height >= 64 ? threads : 1, levels[l].height,
               [&](int first, int last) { level(levels[l - 1], bulk::row_range{first, last}, levels[l]); });
  }
}

/// An element is a value copied: what is read and what is written count half each.
void add_mips(bench::table& table, int channels) {
  const std::string group = "mip chain of 2048^2 x " + std::to_string(channels);
  add_copy<float>(table, group, "copy", channels);
  add_copy<std::uint16_t>(table, group, "copy of 16 bits", channels);
  const image<float> base = moments(size, size, channels);
  const auto levels = chain_of(base);
  double moved = 0;
  for (std::size_t l = 1; l < levels->size(); ++l)
    moved += 0.5 * static_cast<double>((*levels)[l - 1].texels.size() + (*levels)[l].texels.size());
  const auto work = [=](int threads) {
    fill(*levels, threads, [](const auto& in, bulk::row_range rows, auto& out) { bulk::downsample(in, mip_filter::box, rows, out); });
  };
  add_pass(table, group, "binary32", moved, work, [=] {
    work(2);
    const auto expected = mip_chain<float>(base, mip_filter::box, [](std::span<float>) {});
    for (std::size_t l = 1; l < expected.size(); ++l)
      if (const auto wrong = difference((*levels)[l], expected[l]); !wrong.empty()) return wrong;
    return std::string();
  }, "copy", native_limit);
  for (const storage& s : storages) {
    const auto codes = chain_of(coded(s.code, base));
    const auto pass = [=](int threads) {
      fill(*codes, threads, [&](const auto& in, bulk::row_range rows, auto& out) { bulk::downsample(s.code, in, mip_filter::box, rows, out); });
    };
    add_pass(table, group, s.name, moved, pass, [=] {
      pass(2);
      const auto expected = mip_chain<float>(decoded(s.code, codes->front()), mip_filter::box,
          [&](std::span<float> row) { bulk::round(s.code.format, s.code.rule, row, row); });
      for (std::size_t l = 1; l < expected.size(); ++l)
        if (const auto wrong = difference((*codes)[l], coded(s.code, expected[l])); !wrong.empty()) return wrong;
      return std::string();
    }, "copy of 16 bits", stored_limit);
  }
}

/// Sums in 32 bits. An element is a binary32 value copied; 16-bit texels in and 32-bit sums out are
/// three quarters of one.
void add_tables(bench::table& table, int channels) {
  const std::string group = "summed-area table, 2048^2 x " + std::to_string(channels);
  add_copy<float>(table, group, "copy", channels);
  const auto in = std::make_shared<image<float>>(moments(size, size, channels));
  const auto out = make_image<float>(size, size, channels);
  const auto whole = static_cast<double>(in->texels.size());
  const auto running = [](auto values) {
    return make_sat(std::move(values), sat_order::running, sat_offset::none, [](auto) {}).sums;
  };
  const auto how = [](int threads) { return bulk::execution{.threads = static_cast<unsigned>(threads)}; };
  const auto work = [=](int threads) { bulk::sum_area(*in, *out, how(threads)); };
  add_pass(table, group, "binary32", whole, work,
           [=] { work(2); return difference(*out, running(*in)); }, "copy", native_limit);
  const auto half = std::make_shared<image<std::uint16_t>>(coded(storages[0].code, *in));
  const auto halves = [=](int threads) { bulk::sum_area(storages[0].code, *half, *out, how(threads)); };
  add_pass(table, group, "half, binary32 sums", 0.75 * whole, halves,
           [=] { halves(2); return difference(*out, running(decoded(storages[0].code, *half))); }, "copy", stored_limit);
  const auto codes = std::make_shared<image<std::uint16_t>>(coded(storages[1].code, *in));
  const auto sums = make_image<std::uint32_t>(size, size, channels);
  const auto modular = [=](int threads) { bulk::sum_area(*codes, *sums, how(threads)); };
  add_pass(table, group, "unorm16, uint32 sums", 0.75 * whole, modular, [=] {
    modular(2);
    image<std::uint32_t> wide(size, size, channels);
    std::copy(codes->texels.begin(), codes->texels.end(), wide.texels.begin());
    return difference(*sums, running(std::move(wide)));
  }, "copy", stored_limit);
}

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

void add_sampling(bench::table& table) {
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
  const auto compare = [=](const std::vector<float>& right) { return difference(out->data(), right.data(), right.size()); };
  const filter_model plain = *find_preset("exact");
  std::string base = "bitshade, binary32";
  if (bulk::has(instruction_set::avx512)) {
    const auto raw = [&](const char* name, auto f) {
      const auto work = [=] { f(in->texels.data(), texture, texture, at->u.data(), at->v.data(), out->data(), n); };
      table.add({group, name, n, work, [=] { work(); return compare(expected(plain, *in)); }, "raw AVX-512 loop", 0, {}});
    };
    raw("raw AVX-512 loop", raw_avx512::bilinear_rg);
    raw("raw AVX-512 loop, gathers", raw_avx512::bilinear_rg_gathers);
  }
  const auto add = [&](const std::string& name, const filter_model& model, const std::string& to, double limit, instruction_set set = instruction_set::best) {
    const auto work = [=] { bulk::sample(model, *in, {}, at->u, at->v, *out, set); };
    table.add({group, name, n, work, [=] { work(); return compare(expected(model, *in)); }, to, limit, {}});
  };
  add(base, plain, "raw AVX-512 loop", 1.2);
  if (bulk::has(instruction_set::avx2)) add("bitshade, binary32, AVX2", plain, base, 0, instruction_set::avx2);
  add("the template", plain, base, 0, instruction_set::scalar);
  for (const char* name : {"d3d11", "vulkan-strict", "cuda"}) add(name, *find_preset(name), base, 2);
  for (const storage& s : storages) {
    const auto codes = std::make_shared<image<std::uint16_t>>(coded(s.code, *in));
    const auto work = [=] { bulk::sample(plain, s.code, *codes, {}, at->u, at->v, *out); };
    table.add({group, s.name + " texels", n, work, [=] { work(); return compare(expected(plain, decoded(s.code, *codes))); }, base, 1.3, {}});
  }
  const auto exactly = [=](std::size_t count) {
    std::vector<float> values(2 * count);
    for (std::size_t i = 0; i < 2 * count; ++i)
      values[i] = bilinear_rational<float, exact_rational>({in.get()}, at->u[i / 2], at->v[i / 2], address::clamp, static_cast<int>(i % 2));
    return values;
  };
  constexpr std::size_t few = 32;
  table.add({group, "exact, Boost rationals", few, [=] { *out = exactly(few); out->resize(2 * n); }, {}, base, 0, {}});
  const auto certified = [=] { bulk::sample_certified<exact_rational>({in.get()}, address::clamp, at->u, at->v, *out); };
  const auto check = [=] { certified(); const auto right = exactly(512); return difference(out->data(), right.data(), right.size()); };
  table.add({group, "exact, certified", n, certified, check, base, 8, {}});
  table.add({group, "exact, certified, to Boost rationals", n, certified, check, "exact, Boost rationals", 1 / 500.0, {}});
}

}  // namespace

int main(int argc, char** argv) {
  bench::table table;
  add_sampling(table);
  for (const int channels : {1, 2}) {
    add_blurs(table, channels);
    add_mips(table, channels);
    add_tables(table, channels);
  }
  return table.run(argc, argv);
}
