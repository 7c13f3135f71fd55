#include <algorithm>
#include <vector>

#include "bitshade/texture/blur.hpp"
#include "bulk/float_environment.hpp"
#include "texture/dispatch.hpp"

namespace bitshade::bulk {

namespace {

using texture_kernels::blur_job;
using direction = blur_job::direction;

std::vector<int> wrapped(int first, int last, int size, address mode) {
  std::vector<int> table;
  table.reserve(static_cast<std::size_t>(last - first));
  for (int i = first; i < last; ++i) table.push_back(wrap(i, size, mode));
  return table;
}

/// What a job needs beside the images, alive as long as it runs.
struct blur_tables {
  std::vector<float> weights, scratch;
  std::vector<int> columns, rows;
  std::vector<const float*> lines;

  blur_tables(blur_job& job, const kernel& blur, address mode) {
    const int radius = blur.radius();
    for (const double w : blur.weights) weights.push_back(static_cast<float>(w));
    columns = wrapped(-radius, job.width + radius, job.width, mode);
    rows = wrapped(job.first - radius, job.last + radius, job.height, mode);
    const auto taps = weights.size(), channels = static_cast<std::size_t>(job.channels);
    const bool both = job.along == direction::both;
    const std::size_t row =
        both ? blur_job::tile : static_cast<std::size_t>(job.width) * channels;
    const std::size_t ring = both ? static_cast<std::size_t>(blur_job::most) + taps : 1;
    scratch.resize((ring + 1) * (row + blur_job::slack) + taps * channels);
    lines.resize(static_cast<std::size_t>(blur_job::most) + taps);
    job.weights = weights.data();
    job.taps = static_cast<int>(taps);
    job.symmetric = std::equal(weights.begin(), weights.end(), weights.rbegin());
    job.columns = columns.data();
    job.rows = rows.data();
    job.scratch = scratch.data();
    job.lines = lines.data();
  }
};

template <class Texel>
bool run_kernel(direction along, texture_kernels::texels kind, const image<Texel>& in,
                const kernel& weights, address mode, row_range rows, image<Texel>& out,
                instruction_set set, float border) {
  const auto* kernels = kernels_of(set);
  if (!kernels || rows.first == rows.last || in.row_size() == 0) return false;
  blur_job job{};
  job.along = along;
  job.kind = kind;
  job.in = in.texels.data();
  job.out = out.texels.data();
  job.width = in.width;
  job.height = in.height;
  job.channels = in.channels;
  job.first = rows.first;
  job.last = rows.last;
  job.border = border;
  const blur_tables tables(job, weights, mode);
  const float_environment environment(float_environment::direction::nearest);
  return kernels->blur(job);
}

template <class A, class B>
void require_blur(const image<A>& in, const kernel& weights, row_range rows, const image<B>& out) {
  require_same_size(in, out);
  require_rows(rows, in.height);
  if (weights.weights.size() % 2 == 0)
    throw std::invalid_argument("bitshade::bulk: a blur needs an odd number of taps");
}

/// The definition: rows blurred along x as they are needed, then along y.
template <class Load, class Round, class Put>
void define_both(int width, int height, int channels, const kernel& weights, address mode,
                 row_range rows, float border, Load load, Round round, Put put) {
  image<float> source(width, 1, channels), across(width, height, channels);
  std::vector<bool> made(static_cast<std::size_t>(height));
  for (int y = rows.first; y < rows.last; ++y) {
    for (int k = -weights.radius(); k <= weights.radius(); ++k) {
      const int from = wrap(y + k, height, mode);
      if (from < 0 || made[static_cast<std::size_t>(from)]) continue;
      made[static_cast<std::size_t>(from)] = true;
      load(from, source.row(0));
      blur_row_x<float>(source, weights, mode, 0, across.row(from), border);
      round(across.row(from));
    }
    blur_row_y<float>(across, weights, mode, y, source.row(0), border);
    put(y, source.row(0));
  }
}

}  // namespace

void blur_x(const image<float>& in, const kernel& weights, address mode, row_range rows,
            image<float>& out, instruction_set set, float border) {
  require_blur(in, weights, rows, out);
  if (run_kernel(direction::x, texture_kernels::texels::binary32, in, weights, mode, rows, out, set,
                 border)) {
    return;
  }
  for (int y = rows.first; y < rows.last; ++y) {
    blur_row_x<float>(in, weights, mode, y, out.row(y), border);
  }
}

void blur_y(const image<float>& in, const kernel& weights, address mode, row_range rows,
            image<float>& out, instruction_set set, float border) {
  require_blur(in, weights, rows, out);
  if (run_kernel(direction::y, texture_kernels::texels::binary32, in, weights, mode, rows, out, set,
                 border)) {
    return;
  }
  for (int y = rows.first; y < rows.last; ++y) {
    blur_row_y<float>(in, weights, mode, y, out.row(y), border);
  }
}

void blur(const image<float>& in, const kernel& weights, address mode, row_range rows,
          image<float>& out, instruction_set set, float border) {
  require_blur(in, weights, rows, out);
  if (run_kernel(direction::both, texture_kernels::texels::binary32, in, weights, mode, rows, out,
                 set, border)) {
    return;
  }
  define_both(
      in.width, in.height, in.channels, weights, mode, rows, border,
      [&](int y, std::span<float> to) { std::ranges::copy(in.row(y), to.begin()); },
      [](std::span<float>) {},
      [&](int y, std::span<const float> row) { std::ranges::copy(row, out.row(y).begin()); });
}

void blur(const texel_code& code, const image<std::uint16_t>& in, const kernel& weights,
          address mode, row_range rows, image<std::uint16_t>& out, instruction_set set,
          float border) {
  require_blur(in, weights, rows, out);
  const bool half = is_plain_half(code);
  if ((half || is_plain_unorm16(code)) &&
      run_kernel(direction::both,
                 half ? texture_kernels::texels::half : texture_kernels::texels::unorm16, in,
                 weights, mode, rows, out, set, border)) {
    return;
  }
  const execution how{.set = set};
  define_both(
      in.width, in.height, in.channels, weights, mode, rows, border,
      [&](int y, std::span<float> to) { decode(code.format, code.rule, in.row(y), to, how); },
      [&](std::span<float> row) { round(code.format, code.rule, row, row, how); },
      [&](int y, std::span<const float> row) {
        encode(code.format, code.rule, row, out.row(y), how);
      });
}

}  // namespace bitshade::bulk
