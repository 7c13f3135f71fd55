// The presets against recorded samples: our own recordings, and any folder in the same layout that
// BITSHADE_VECTORS names.
#include <cmath>
#include <cstdlib>
#include <random>

#include "bitshade/formats/hexadecimal.hpp"
#include "bitshade/texture/device_sampler.hpp"
#include "bitshade/texture/presets.hpp"
#include "io/atomic_file.hpp"
#include "support/catch.hpp"
#include "support/gl_renderer.hpp"
#include "support/vector_files.hpp"

using namespace bitshade;
using namespace bitshade::test;

namespace {

const std::filesystem::path own_vectors =
    std::filesystem::path(BITSHADE_SOURCE_DIR) / "tests/conformance/texture/vectors";

/// The llvmpipe of the recordings ran on a processor with FMA: its preset as it stands.
void check_folder(const std::filesystem::path& folder, std::size_t at_least) {
  std::size_t compared = 0;
  for (const vector_file& f : read_vectors(folder)) {
    const bool bytes = f.texture.format.of[0] == unorm_encoding(8);
    for (std::size_t r = 0; r < f.renderers.size(); ++r) {
      const std::string name =
          f.renderers[r] == "llvmpipe" && bytes ? "llvmpipe-r8" : f.renderers[r];
      const auto preset = find_preset(name);
      CAPTURE(folder.string(), f.file, name);
      REQUIRE(preset);
      const device_sampler model(*preset, f.texture.format, f.texture.levels, f.state);
      const auto channels = static_cast<std::size_t>(f.texture.format.channels);
      for (std::size_t row = 0; row < f.where.lookups.size(); ++row)
        for (std::size_t c = 0; c < channels; ++c) {
          const auto& at = f.where.lookups[row];
          const float mine = f.where.gradient
                                 ? model.gradient(at.u, at.v, at.g, static_cast<int>(c))
                                 : model.lod(at.u, at.v, at.lod, static_cast<int>(c));
          const float theirs = f.results[r][row * channels + c];
          ++compared;
          if (mine == theirs) continue;
          CAPTURE(row, c, hexadecimal(static_cast<double>(mine)),
                  hexadecimal(static_cast<double>(theirs)));
          REQUIRE(mine == theirs);
        }
    }
  }
  CHECK(compared >= at_least);
}

}  // namespace

TEST_CASE("presets reproduce our recordings of llvmpipe and softpipe bit for bit") {
  check_folder(own_vectors, 5000);
}

// SwiftShader is not to be had as a package: a part of its recordings stands here.
TEST_CASE("the preset swiftshader reproduces a part of its recordings bit for bit") {
  check_folder(own_vectors.parent_path() / "swiftshader", 600);
}

TEST_CASE("presets reproduce the recordings that BITSHADE_VECTORS names bit for bit") {
  const char* folder = std::getenv("BITSHADE_VECTORS");
  if (folder == nullptr || *folder == 0) {
    SUCCEED("BITSHADE_VECTORS is not set");
    return;
  }
  check_folder(folder, 1);
}

// Writes the folder that the first test reads: test_conformance "[.record]".
TEST_CASE("record samples of llvmpipe and softpipe", "[.record]") {
  std::mt19937 random(41);
  const auto unit = [&] { return static_cast<float>(random() >> 8) * 0x1p-24f; };
  struct plan {
    const char *file, *texture, *kind;
    texel_format format;
    int width, height;
    address wrap;
    bool mips;
    int anisotropy;
  };
  const texel_format rg16 = uniform_format(unorm_encoding(16), 2);
  const plan plans[] = {
      {"bilinear_clamp_rg16.csv", "rg16_12x9", "textureLod", rg16, 12, 9, address::clamp, false, 1},
      {"trilinear_repeat_rg16f.csv", "rg16f_16", "textureLod", uniform_format(binary16::value, 2),
       16, 16, address::repeat, true, 1},
      {"trilinear_clamp_r8.csv", "r8_16", "textureLod", uniform_format(unorm_encoding(8), 1), 16,
       16, address::clamp, true, 1},
      {"bilinear_repeat_rg32f.csv", "rg32f_11x7", "textureLod", uniform_format(binary32::value, 2),
       11, 7, address::repeat, false, 1},
      {"gradient_repeat_rg16_snorm.csv", "rg16s_16", "textureGrad",
       uniform_format(snorm_encoding(16), 2), 16, 16, address::repeat, true, 1},
      {"aniso_repeat_rg16.csv", "rg16_32", "aniso", rg16, 32, 32, address::repeat, true, 4}};
  std::vector<vector_file> files;
  for (const plan& p : plans) {
    vector_file f;
    f.file = p.file;
    f.kind = p.kind;
    f.texture = {p.texture, p.format, {}};
    for (int l = 0; l < (p.mips ? mip_levels(p.width, p.height) : 1); ++l) {
      coded_image level(mip_size(p.width, l), mip_size(p.height, l), p.format.channels);
      for (auto& t : level.texels)
        t = p.format.of[0].kind == family::binary ? encode(p.format.of[0], unit())
                                                  : random() & low_bits(p.format.of[0].width);
      f.texture.levels.push_back(std::move(level));
    }
    f.state.u = f.state.v = p.wrap;
    f.state.mips = p.mips ? mip_selection::linear : mip_selection::none;
    f.state.max_anisotropy = p.anisotropy;
    f.where.gradient = p.kind != std::string("textureLod");
    render_job job{f.texture.format,
                   f.texture.levels,
                   f.state,
                   p.anisotropy > 1   ? lookup_kind::quad
                   : f.where.gradient ? lookup_kind::gradient
                                      : lookup_kind::lod,
                   {},
                   {},
                   {},
                   {}};
    for (int i = 0; i < 250; ++i) {
      coordinates::lookup at;
      const auto step = [&] {
        return (static_cast<int>(random() % 65536) - 32768) * 0x1p-20 *
               (1 + static_cast<int>(random() % 3));
      };
      at.u =
          p.anisotropy > 1 ? static_cast<float>(random() >> 12) * 0x1p-20f : 1.4f * unit() - 0.2f;
      at.v =
          p.anisotropy > 1 ? static_cast<float>(random() >> 12) * 0x1p-20f : 1.4f * unit() - 0.2f;
      if (f.where.gradient)
        at.g = {step(), step(), step(), step()};
      else
        at.lod = p.mips ? 4 * unit() - 0.5f : 0;
      f.where.lookups.push_back(at);
      job.u.push_back(at.u);
      job.v.push_back(at.v);
      job.lod.push_back(at.lod);
      job.derivatives.push_back(at.g);
    }
    for (const char* driver : {"llvmpipe", "softpipe"}) {
      const std::vector<float> all = render(driver, {job}).front();
      f.renderers.emplace_back(driver);
      f.results.emplace_back();
      for (std::size_t i = 0; i < job.u.size(); ++i)
        for (int c = 0; c < p.format.channels; ++c)
          f.results.back().push_back(all[4 * i + static_cast<std::size_t>(c)]);
    }
    files.push_back(std::move(f));
  }
  make_output_folder(own_vectors);
  for (const auto& [name, text] : print_vectors(files)) write_file(own_vectors / name, text);
  CHECK(files.size() == 6);
}
