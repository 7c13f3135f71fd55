#include <algorithm>

#include "bitshade/texture/mip.hpp"
#include "bulk/dispatch.hpp"
#include "bulk/float_environment.hpp"
#include "texture/dispatch.hpp"

namespace bitshade::bulk {

namespace {

using texture_kernels::texels;

/// Runs a kernel where both sizes are halved exactly, or at least evenly from the first texel on.
template <class Texel>
bool run_kernel(texels kind, const image<Texel>& in, mip_filter filter, row_range rows,
                image<Texel>& out, instruction_set set) {
  const auto* kernels = kernels_of(set);
  const bool even = in.width % 2 == 0 && (in.height % 2 == 0 || filter == mip_filter::box);
  if (!kernels || !even || in.height < 2) return false;
  const float_environment environment(float_environment::direction::nearest);
  return kernels->mip({kind, in.texels.data(), out.texels.data(), in.width, in.channels,
                       rows.first, rows.last});
}

template <class Texel>
void require_level(const image<Texel>& in, row_range rows, const image<Texel>& out) {
  if (out.width != std::max(1, in.width / 2) || out.height != std::max(1, in.height / 2) ||
      out.channels != in.channels)
    throw std::invalid_argument("bitshade::bulk: not the size of the next level");
  require_rows(rows, out.height);
}

/// Calls level(l, rows) for every level over the first: first for blocks of rows that halve evenly
/// through several levels, each block by one thread, in turn; then for what is left.
template <class Texel, class Level>
void fill_levels(std::span<image<Texel>> levels, const execution& how, Level level) {
  if (levels.empty()) return;
  constexpr int most = 64;  // rows of a block: a few hundred kilobytes stay in the second level
  const int height = levels.front().height;
  int block = 1;
  std::size_t deep = 1;
  while (deep < levels.size() && block < most && height % (2 * block) == 0) {
    block *= 2;
    ++deep;
  }
  in_pieces(how, static_cast<std::size_t>(height / block), [&](std::size_t k) {
    const int b = static_cast<int>(k);
    int rows = block;
    for (std::size_t l = 1; l < deep; ++l) {
      rows /= 2;
      level(l, row_range{b * rows, (b + 1) * rows});
    }
  });
  for (std::size_t l = deep; l < levels.size(); ++l) level(l, row_range{0, levels[l].height});
}

}  // namespace

void downsample(const image<float>& in, mip_filter filter, row_range rows, image<float>& out,
                instruction_set set) {
  require_level(in, rows, out);
  if (run_kernel(texels::binary32, in, filter, rows, out, set)) return;
  for (int y = rows.first; y < rows.last; ++y) downsample_row<float>(in, filter, y, out.row(y));
}

void downsample(const texel_code& code, const image<std::uint16_t>& in, mip_filter filter,
                row_range rows, image<std::uint16_t>& out, instruction_set set) {
  require_level(in, rows, out);
  const bool half = is_plain_half(code);
  if ((half || is_plain_unorm16(code)) &&
      run_kernel(half ? texels::half : texels::unorm16, in, filter, rows, out, set)) {
    return;
  }
  // The few source rows that a row needs, decoded, as an image of their own.
  const execution how{.set = set};
  image<float> row(out.width, 1, out.channels);
  image<float> all(in.width, in.height, in.channels);
  std::vector<bool> made(static_cast<std::size_t>(in.height));
  for (int y = rows.first; y < rows.last; ++y) {
    const mip_taps taps = mip_axis(filter, in.height, y);
    for (int j = taps.first; j < taps.first + taps.count; ++j) {
      if (made[static_cast<std::size_t>(j)]) continue;
      made[static_cast<std::size_t>(j)] = true;
      decode(code.format, code.rule, in.row(j), all.row(j), how);
    }
    downsample_row<float>(all, filter, y, row.row(0));
    encode(code.format, code.rule, row.row(0), out.row(y), how);
  }
}

void fill_mips(std::span<image<float>> levels, mip_filter filter, const execution& how) {
  for (std::size_t l = 1; l < levels.size(); ++l) require_level(levels[l - 1], {}, levels[l]);
  fill_levels(levels, how, [&](std::size_t l, row_range rows) {
    downsample(levels[l - 1], filter, rows, levels[l], how.set);
  });
}

void fill_mips(const texel_code& code, std::span<image<std::uint16_t>> levels, mip_filter filter,
               const execution& how) {
  for (std::size_t l = 1; l < levels.size(); ++l) require_level(levels[l - 1], {}, levels[l]);
  fill_levels(levels, how, [&](std::size_t l, row_range rows) {
    downsample(code, levels[l - 1], filter, rows, levels[l], how.set);
  });
}

}  // namespace bitshade::bulk
