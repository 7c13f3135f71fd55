// The presets against Mesa's software renderers, run here and now through headless EGL.
#include <cmath>
#include <cstdlib>
#include <map>
#include <random>

#include "bitshade/formats/hexadecimal.hpp"
#include "bitshade/texture/device_sampler.hpp"
#include "bitshade/texture/presets.hpp"
#include "support/catch.hpp"
#include "support/gl_renderer.hpp"

using namespace bitshade;
using namespace bitshade::test;

namespace {

struct named_format {
  const char* name;
  texel_format format;
};

const std::vector<named_format>& formats() {
  static const std::vector<named_format> all{{"RG16", uniform_format(unorm_encoding(16), 2)},
                                             {"RG16F", uniform_format(binary16::value, 2)},
                                             {"RG32F", uniform_format(binary32::value, 2)},
                                             {"RG16 snorm", uniform_format(snorm_encoding(16), 2)},
                                             {"R8", uniform_format(unorm_encoding(8), 1)}};
  return all;
}

/// The preset of a driver, as this machine's processor makes it: llvmpipe fuses where it can.
filter_model preset_of(const std::string& driver, const texel_format& format) {
  const bool bytes = driver == "llvmpipe" && format.of[0] == unorm_encoding(8);
  filter_model m = *find_preset(bytes ? "llvmpipe-r8" : driver);
#if defined(__x86_64__)
  if (m.order == accumulation::lerp_fma && !__builtin_cpu_supports("fma"))
    m.order = accumulation::lerp_mul_add;
#endif
  return m;
}

class generator {
 public:
  std::uint64_t code(const encoding& e) {
    if (e.kind != family::binary) return random_() & low_bits(e.width);
    return encode(e, (random_() >> 8) * 0x1p-24);
  }
  coded_image image_of(const texel_format& format, int w, int h) {
    coded_image out(w, h, format.channels);
    for (std::size_t i = 0; i < out.texels.size(); ++i)
      out.texels[i] = code(format.of[i % static_cast<std::size_t>(format.channels)]);
    return out;
  }
  /// Levels of independent data: a wrong level cannot hide.
  std::vector<coded_image> chain_of(const texel_format& format, int w, int h) {
    std::vector<coded_image> out;
    for (int l = 0; l < mip_levels(w, h); ++l)
      out.push_back(image_of(format, mip_size(w, l), mip_size(h, l)));
    return out;
  }
  float signed_unit() {
    return static_cast<float>(static_cast<int>(random_() >> 8) - (1 << 23)) * 0x1p-23f;
  }
  double on_grid(int bits) {
    return (static_cast<int>(random_() % (2u << bits)) - (1 << bits)) * 0x1p-20;
  }
  std::uint32_t operator()() { return static_cast<std::uint32_t>(random_()); }

 private:
  std::mt19937 random_{20260101};
};

render_job lookups(generator& random, const texel_format& format, int w, int h, address mode,
                   lookup_kind kind, bool mips, int anisotropy, int count) {
  render_job job;
  job.format = format;
  job.levels = random.chain_of(format, w, h);
  if (!mips) job.levels.resize(1);
  job.state.u = job.state.v = mode;
  job.state.border = {0.25, 0.5, 0.75, 1};
  job.state.mips = mips ? mip_selection::linear : mip_selection::none;
  job.state.max_anisotropy = anisotropy;
  job.kind = kind;
  for (int i = 0; i < count; ++i) {
    if (kind == lookup_kind::quad) {  // on a grid, so that differences in the quad are exact
      job.u.push_back(static_cast<float>(random() >> 12) * 0x1p-20f);
      job.v.push_back(static_cast<float>(random() >> 12) * 0x1p-20f);
      const int bits = 10 + static_cast<int>(random() % 7);
      job.derivatives.push_back(
          {random.on_grid(bits), random.on_grid(bits), random.on_grid(bits), random.on_grid(bits)});
    } else {
      job.u.push_back(random.signed_unit() * 1.3f + 0.5f);
      job.v.push_back(random.signed_unit() * 1.3f + 0.5f);
      job.lod.push_back(mips ? 3 * random.signed_unit() + 2 : 0);
      const double scale = std::ldexp(1.0, static_cast<int>(random() % 5) - 5);
      job.derivatives.push_back({random.signed_unit() * scale, random.signed_unit() * scale,
                                 random.signed_unit() * scale, random.signed_unit() * scale});
    }
  }
  return job;
}

/// Largest difference between a preset and what was rendered; each lookup above `bound` fails.
double compare(const std::string& driver, const render_job& job, const std::vector<float>& got,
               double bound) {
  const device_sampler model(preset_of(driver, job.format), job.format, job.levels, job.state);
  double worst = 0;
  for (std::size_t i = 0; i < job.u.size(); ++i)
    for (int c = 0; c < job.format.channels; ++c) {
      const float mine = job.kind == lookup_kind::lod
                             ? model.lod(job.u[i], job.v[i], job.lod[i], c)
                             : model.gradient(job.u[i], job.v[i], job.derivatives[i], c);
      const float theirs = got[4 * i + static_cast<std::size_t>(c)];
      const double apart = std::fabs(static_cast<double>(mine) - static_cast<double>(theirs));
      worst = std::max(worst, apart);
      if (!(apart <= bound)) {
        INFO("u " << hexadecimal(job.u[i]) << " v " << hexadecimal(job.v[i]) << " channel " << c
                  << " got " << hexadecimal(static_cast<double>(theirs)) << " preset "
                  << hexadecimal(static_cast<double>(mine)));
        REQUIRE(apart <= bound);
      }
    }
  return worst;
}

}  // namespace

TEST_CASE("presets equal Mesa bit for bit: bilinear, trilinear, lod, gradients, wraps, sizes") {
  for (const std::string driver : {"llvmpipe", "softpipe"}) {
    generator random;
    std::vector<render_job> jobs;
    for (const auto& [name, format] : formats())
      for (const auto& [w, h] : {std::pair{16, 32}, std::pair{13, 7}})
        for (const address mode : {address::clamp, address::repeat}) {
          jobs.push_back(lookups(random, format, w, h, mode, lookup_kind::lod, false, 1, 300));
          jobs.push_back(lookups(random, format, w, h, mode, lookup_kind::lod, true, 1, 300));
          jobs.push_back(lookups(random, format, w, h, mode, lookup_kind::gradient, true, 1, 300));
        }
    const auto results = render(driver, jobs);
    for (std::size_t i = 0; i < jobs.size(); ++i) {
      CAPTURE(driver, formats()[i / 12].name, i % 12);
      CHECK(compare(driver, jobs[i], results[i], 0) == 0);
    }
  }
}

TEST_CASE("presets equal Mesa bit for bit: anisotropy from a quad's own derivatives") {
  for (const std::string driver : {"llvmpipe", "softpipe"}) {
    generator random;
    std::vector<render_job> jobs;
    for (const std::size_t f : {0, 1})
      for (const address mode : {address::clamp, address::repeat})
        jobs.push_back(
            lookups(random, formats()[f].format, 64, 64, mode, lookup_kind::quad, true, 4, 200));
    const auto results = render(driver, jobs);
    for (std::size_t i = 0; i < jobs.size(); ++i) {
      CAPTURE(driver, i);
      CHECK(compare(driver, jobs[i], results[i], 0) == 0);
    }
  }
}

// softpipe mirrors the scaled coordinate, these presets the normalised one: they differ by
// roundings of u*w alone, at most 4 ulp of a 13-texel coordinate, times the texels' range.
constexpr double mirror_bound = 0x1p-20;

TEST_CASE("mirror and border: llvmpipe bit for bit, softpipe within its bound") {
  for (const std::string driver : {"llvmpipe", "softpipe"}) {
    generator random;
    std::vector<render_job> jobs;
    for (const address mode : {address::mirror, address::border})
      for (const std::size_t f : {0, 4})
        jobs.push_back(
            lookups(random, formats()[f].format, 13, 16, mode, lookup_kind::lod, true, 1, 300));
    const auto results = render(driver, jobs);
    for (std::size_t i = 0; i < jobs.size(); ++i) {
      const bool mirror = jobs[i].state.u == address::mirror;
      CAPTURE(driver, i);
      CHECK(compare(driver, jobs[i], results[i],
                    driver == "softpipe" && mirror ? mirror_bound : 0) <= mirror_bound);
    }
  }
}

TEST_CASE("stores equal Mesa's bit for bit") {
  std::vector<format_image> images;
  generator random;
  std::vector<named_format> all = formats();
  all.push_back({"R11G11B10", r11g11b10_format()});
  for (const auto& [name, format] : all) {
    image<float> values(64, 64, format.channels);
    const bool is_signed = format.of[0].has_sign && !is_norm(format.of[0]);
    for (float& x : values.texels) {
      const float r = random.signed_unit();
      // Fixed-point targets are clamped to [0, 1] by OpenGL before the store, snorm's too.
      const int kind = static_cast<int>(random() % 6);
      x = kind < 3    ? r
          : kind == 3 ? std::ldexp(r, static_cast<int>(random() % 60) - 30)
                      : std::ldexp(r, -15 - static_cast<int>(random() % 9));
      if (!is_signed) x = std::fabs(x);
    }
    images.push_back({format, values});
  }
  for (const std::string driver : {"llvmpipe", "softpipe"}) {
    const std::vector<coded_image> got = render_stores(driver, images);
    for (std::size_t i = 0; i < images.size(); ++i) {
      const coded_image mine =
          store(preset_of(driver, images[i].format), images[i].format, images[i].values);
      CAPTURE(driver, all[i].name);
      std::size_t differ = 0;
      for (std::size_t k = 0; k < mine.texels.size(); ++k) {
        if (mine.texels[k] == got[i].texels[k]) continue;
        if (++differ > 3) continue;
        UNSCOPED_INFO("x " << hexadecimal(static_cast<double>(images[i].values.texels[k]))
                           << " got " << got[i].texels[k] << " preset " << mine.texels[k]);
      }
      CHECK(differ == 0);
    }
  }
}

// For sizes that are no powers of two Mesa interpolates the destination's centre across the
// triangle, in binary32 with roundings of the rasteriser's own. With u and v off by 2^-23 (two ulp
// at 1) a bilinear value moves by (w + h) 2^-23 of the texels' range: below one code of 16 bits.
constexpr std::uint64_t odd_mip_codes = 1;
constexpr double odd_mip_range(int w, int h) { return (w + h) * 0x1p-23; }

TEST_CASE("mip levels equal Mesa's: bit for bit for powers of two, within a code otherwise") {
  generator random;
  std::vector<format_codes> images;
  std::vector<named_format> all = formats();
  all.push_back({"R11G11B10", r11g11b10_format()});
  for (const auto& [name, format] : all)
    for (const auto& [w, h] : {std::pair{32, 16}, std::pair{13, 7}, std::pair{37, 51}})
      images.push_back({format, random.image_of(format, w, h)});
  for (const std::string driver : {"llvmpipe", "softpipe"}) {
    const auto got = render_mips(driver, images);
    for (std::size_t i = 0; i < images.size(); ++i) {
      const texel_format& format = images[i].format;
      const bool even = images[i].base.width == 32;
      for (std::size_t l = 1; l < got[i].size(); ++l) {
        const coded_image mine =
            device_mip_chain(preset_of(driver, format), format, got[i][l - 1])[1];
        CAPTURE(driver, all[i / 3].name, images[i].base.width, l);
        std::uint64_t codes = 0;
        double range = 0;
        for (std::size_t k = 0; k < mine.texels.size(); ++k) {
          const std::uint64_t a = mine.texels[k], b = got[i][l].texels[k];
          codes = std::max(codes, a > b ? a - b : b - a);
          const encoding& e = format.of[k % static_cast<std::size_t>(format.channels)];
          range = std::max(range, std::fabs(decode(e, a) - decode(e, b)));
        }
        if (even)
          CHECK(codes == 0);
        else if (format.of[0] == binary32::value)
          CHECK(range <= odd_mip_range(got[i][l - 1].width, got[i][l - 1].height));
        else
          CHECK(codes <= odd_mip_codes);
      }
    }
  }
}
