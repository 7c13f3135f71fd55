// Every preset on any bits: no read outside, results in range, exact against fast exact on any
// texels.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "bitshade/interop/rational.hpp"
#include "bitshade/texture/device_sampler.hpp"
#include "bitshade/texture/exact_sampler.hpp"

namespace {

/// Takes numbers from the front of the input, zeros when it is used up.
struct reader {
  const std::uint8_t* data;
  std::size_t size;
  template <class T>
  T take() {
    T value{};
    const std::size_t n = std::min(size, sizeof value);
    std::memcpy(&value, data, n);
    data += n;
    size -= n;
    return value;
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bitshade;
  reader in{data, size};
  const filter_model& model = presets[in.take<std::uint8_t>() % presets.size()];
  constexpr encoding formats[] = {unorm_encoding(16), snorm_encoding(16), binary16::value,
                                  bfloat16::value,    unorm_encoding(8),  unorm_encoding(24)};
  const std::uint8_t choice = in.take<std::uint8_t>();
  const encoding e = model.order == accumulation::lerp_codes ? unorm_encoding(8)
                                                             : formats[choice % std::size(formats)];
  const texel_format format = uniform_format(e, 1);
  const int w = 1 + in.take<std::uint8_t>() % 17, h = 1 + in.take<std::uint8_t>() % 17;
  sampler_state state;
  state.u = static_cast<address>(in.take<std::uint8_t>() % 4);
  state.v = choice % 3 == 0 ? static_cast<address>(in.take<std::uint8_t>() % 4) : state.u;
  state.linear = choice % 5 != 0;
  state.mips = static_cast<mip_selection>(in.take<std::uint8_t>() % 3);
  state.max_anisotropy = 1 + in.take<std::uint8_t>() % 16;
  const auto u = in.take<float>(), v = in.take<float>(), lod = in.take<float>();
  // Derivatives that ask for more texels than a test should wait for are folded back.
  const auto derivative = [&] {
    const auto d = in.take<float>();
    return std::isfinite(d) ? std::fmod(static_cast<double>(d), 4.0) : 0.0;
  };
  const gradients g{derivative(), derivative(), derivative(), derivative()};
  std::vector<coded_image> chain;
  for (int l = 0; l < mip_levels(w, h); ++l) {
    coded_image level(mip_size(w, l), mip_size(h, l), 1);
    // Depths, whatever the format: 0 to 1, which no sum of weights can take far away.
    for (auto& t : level.texels) t = encode(e, in.take<std::uint16_t>() * (1.0 / 65535));
    chain.push_back(std::move(level));
  }
  const device_sampler sampler(model, format, chain, state);
  // 16 probes' weights and sums, or an ellipse's: a constant 1 comes back within 2^-15.
  for (const float result : {sampler.lod(u, v, lod, 0), sampler.gradient(u, v, g, 0)})
    if (std::isfinite(u) && std::isfinite(v) && !(result >= -0x1p-15f && result <= 1 + 0x1p-15f))
      std::abort();

  if (std::isfinite(u) && std::isfinite(v)) {
    // Any codes at all, infinities and NaN among them, and any border, where the input has more.
    if (in.size > 0) {
      const auto border = in.take<double>();
      if (std::fabs(border) < 0x1p900) state.border[0] = border;
      for (coded_image& level : chain)
        for (auto& t : level.texels) t = in.take<std::uint32_t>() & low_bits(e.width);
    }
    const exact_sampler<exact_rational> exact(format, chain, state);
    const double level = std::isfinite(lod) ? lod : 0;
    const auto compare = [](auto a, auto b) {
      if (std::isnan(a) ? !std::isnan(b) : a != b || std::signbit(a) != std::signbit(b))
        std::abort();
    };
    const probe_set one{0, {{0, 0}}}, probes = vulkan_probes(g, w, h, state.max_anisotropy);
    compare(exact.lod(u, v, level, 0), exact.rational<float>(one, u, v, level, 0));
    compare(exact.lod<double>(u, v, level, 0), exact.rational<double>(one, u, v, level, 0));
    compare(exact.gradient(u, v, g, 0), exact.rational<float>(probes, u, v, probes.lambda, 0));
  }
  return 0;
}
