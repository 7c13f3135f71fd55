#include "bitshade/texture/sat.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <thread>
#include <vector>

#include "bulk/dispatch.hpp"
#include "bulk/float_environment.hpp"
#include "bulk/pause.hpp"
#include "texture/dispatch.hpp"

namespace bitshade::bulk {

namespace {

using texture_kernels::sat_job;
using texture_kernels::sums;
using texture_kernels::texels;

/// Strips of columns, each summed from the top down by one thread. A strip follows the one to its
/// left by a band of rows: it needs where that one's rows ended.
class sat_strips {
 public:
  sat_strips(const texture_kernels::kernels& kernels, const sat_job& whole, int height,
             const execution& how)
      : kernels_(kernels), whole_(whole), height_(height), how_(how) {
    const auto channels = static_cast<std::size_t>(whole.channels);
    // Strips begin at whole cache lines and whole texels.
    const std::size_t step = 64 * channels;
    const std::size_t wanted = std::max<std::size_t>(1, std::min<std::size_t>(threads_of(how), whole.row_size / step));
    width_ = (whole.row_size / wanted + step - 1) / step * step;
    count_ = (whole.row_size + width_ - 1) / width_;
    carry_.assign(static_cast<std::size_t>(height) * channels, nothing());
    above_.assign(whole.row_size, nothing());
    done_ = std::vector<std::atomic<int>>(count_);
  }

  bool run() {
    std::atomic<bool> known = true;
    // Begun in order, so that a strip's left neighbour is always under way.
    in_pieces(how_, count_, [&](std::size_t k) {
      const float_environment environment(float_environment::direction::nearest);
      if (!sum(k)) known = false;
    });
    return known;
  }

 private:
  std::uint32_t nothing() const {
    return whole_.what == sums::of_codes ? 0 : std::bit_cast<std::uint32_t>(-0.0f);
  }

  bool sum(std::size_t k) {
    sat_job job = whole_;
    job.first = k * width_;
    job.n = std::min(width_, whole_.row_size - job.first);
    job.above = above_.data() + job.first;
    bool known = true;
    for (int y = 0; y < height_; y += sat_job::band) {
      if (k > 0) wait(done_[k - 1], y);
      job.first_row = y;
      job.rows = std::min(sat_job::band, height_ - y);
      job.carry = carry_.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(job.channels);
      known = known && kernels_.sat(job);
      done_[k].store(y + job.rows, std::memory_order_release);
    }
    return known;
  }

  /// Bands take microseconds: worth asking a few times before giving the core away.
  static void wait(const std::atomic<int>& rows, int y) {
    for (int tries = 0; rows.load(std::memory_order_acquire) <= y; ++tries) {
      if (tries < 1000)
        pause();
      else
        std::this_thread::yield();
    }
  }

  const texture_kernels::kernels& kernels_;
  const sat_job whole_;
  const int height_;
  const execution& how_;
  std::size_t width_ = 0, count_ = 0;
  std::vector<std::uint32_t> carry_, above_;
  std::vector<std::atomic<int>> done_;
};

template <class In, class Out>
bool run_kernel(sums what, texels kind, const image<In>& in, image<Out>& out,
                const execution& how) {
  require_same_size(in, out);
  if (in.texels.empty()) throw std::invalid_argument("a summed-area table needs texels");
  const auto* kernels = kernels_of(how.set);
  if (!kernels) return false;
  sat_job job{};
  job.what = what;
  job.kind = kind;
  job.in = in.texels.data();
  job.out = out.texels.data();
  job.row_size = in.row_size();
  job.channels = in.channels;
  job.streams = out.texels.size() * sizeof(Out) >= texture_kernels::cached_bytes;
  return sat_strips(*kernels, job, in.height, how).run();
}

template <class T>
image<T> running(image<T> in) {
  return make_sat(std::move(in), sat_order::running, sat_offset::none, [](std::span<T>) {}).sums;
}

}  // namespace

void sum_area(const image<float>& in, image<float>& out, const execution& how) {
  if (run_kernel(sums::of_texels, texels::binary32, in, out, how)) return;
  out = running(in);
}

void sum_area(const texel_code& code, const image<std::uint16_t>& in, image<float>& out,
              const execution& how) {
  const bool half = is_plain_half(code);
  if ((half || is_plain_unorm16(code)) &&
      run_kernel(sums::of_texels, half ? texels::half : texels::unorm16, in, out, how)) {
    return;
  }
  require_same_size(in, out);
  image<float> values(in.width, in.height, in.channels);
  decode(code.format, code.rule, in.texels, std::span(values.texels), how);
  out = running(std::move(values));
}

void sum_area(const image<std::uint16_t>& codes, image<std::uint32_t>& out, const execution& how) {
  if (run_kernel(sums::of_codes, texels::unorm16, codes, out, how)) return;
  image<std::uint32_t> wide(codes.width, codes.height, codes.channels);
  std::ranges::copy(codes.texels, wide.texels.begin());
  out = running(std::move(wide));
}

}  // namespace bitshade::bulk
