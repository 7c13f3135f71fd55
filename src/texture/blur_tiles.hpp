// Blurs tile by tile: rows of a tile stay in the cache between both directions.
#pragma once

#include "texture/blur_rows.hpp"
#include "texture/jobs.hpp"
#include "texture/texels.hpp"

namespace bitshade::texture_kernels {

template <class V, class Texels>
class blur_tiles {
 public:
  using code = typename Texels::code;
  using f = typename V::f;

  explicit blur_tiles(const blur_job& job)
      : job_(job),
        row_size_(static_cast<std::size_t>(job.width) * static_cast<std::size_t>(job.channels)),
        step_(static_cast<std::size_t>(job.channels)),
        margin_(static_cast<std::size_t>(job.taps / 2) * step_),
        ring_row_((job.along == blur_job::direction::both ? blur_job::tile : row_size_) +
                  blur_job::slack),
        stream_(V::width * sizeof(code) >= 32 && row_size_ * sizeof(code) % 64 == 0 &&
                row_size_ * sizeof(code) * static_cast<std::size_t>(job.height) >=
                    cached_bytes) {}

  void run() {
    switch (job_.along) {
      case blur_job::direction::x:
        for (int y = job_.first; y < job_.last; ++y) across(y);
        return;
      case blur_job::direction::y:
        for (int y = job_.first; y < job_.last; y += blur_job::group) {
          down(y, job_.last - y < blur_job::group ? job_.last - y : blur_job::group);
        }
        if (stream_) V::fence();
        return;
      case blur_job::direction::both:
        for (std::size_t at = 0; at < row_size_; at += blur_job::tile) {
          strip(at, row_size_ - at < blur_job::tile ? row_size_ - at : blur_job::tile);
        }
        if (stream_) V::fence();
    }
  }

 private:
  float* line(int i) const { return job_.scratch + static_cast<std::size_t>(i) * ring_row_; }
  /// The decoded source of a row of tile, with margins; behind the ring.
  float* source_line() const {
    const int lines = job_.along == blur_job::direction::both ? blur_job::most + job_.taps : 1;
    return line(lines);
  }
  code* out_row(int y) const {
    return static_cast<code*>(job_.out) + static_cast<std::size_t>(y) * row_size_;
  }
  const code* in_row(int y) const {
    return static_cast<const code*>(job_.in) + static_cast<std::size_t>(y) * row_size_;
  }

  /// Stores n values, of which whole vectors may be read.
  void put(const float* from, std::size_t n, code* to) const {
    std::size_t i = 0;
    for (; i + V::width <= n; i += V::width) texels_.store(to + i, V::load(from + i));
    if (i == n) return;
    code last[V::width];
    texels_.store(last, V::load(from + i));
    for (std::size_t k = 0; i + k < n; ++k) to[i + k] = last[k];
  }

  /// Loads n values; whole vectors may be written.
  void get(const code* from, std::size_t n, float* to) const {
    constexpr std::size_t line = 64 / sizeof(code);
    std::size_t i = 0;
    for (; i + line <= n; i += line) {
      __builtin_prefetch(from + i + 4096 / sizeof(code));
#pragma GCC unroll 4
      for (std::size_t k = 0; k < line; k += V::width)
        V::store(to + i + k, texels_.load(from + i + k));
    }
    for (; i + V::width <= n; i += V::width) V::store(to + i, texels_.load(from + i));
    if (i == n) return;
    code last[V::width] = {};
    for (std::size_t k = 0; i + k < n; ++k) last[k] = from[i + k];
    V::store(to + i, texels_.load(last));
  }

  /// A value beyond the edge, counted from the first column of the table.
  float beyond(const code* row, std::size_t i) const {
    const int column = job_.columns[i / step_];
    if (column < 0) return job_.border;
    float one[V::width];
    get(row + static_cast<std::size_t>(column) * step_ + i % step_, 1, one);
    return one[0];
  }

  /// Values [at, at + n) of row y with their margins, decoded; columns beyond the edge as the table
  /// says.
  const float* buffered(int y, std::size_t at, std::size_t n) const {
    const code* row = in_row(y);
    float* to = source_line();
    // What lies within the row; whole vectors may spill behind it.
    const std::size_t before = at >= margin_ ? 0 : margin_ - at;
    const std::size_t from = at + before - margin_;
    const std::size_t end = at + n + margin_ < row_size_ ? at + n + margin_ : row_size_;
    const std::size_t within = end > from ? end - from : 0;
    get(row + from, within, to + before);
    for (std::size_t i = 0; i < before; ++i) to[i] = beyond(row, at + i);
    for (std::size_t i = before + within; i < n + 2 * margin_; ++i) to[i] = beyond(row, at + i);
    return to;
  }

  template <int Taps, int Step>
  bool slide(const float* from, float* to, std::size_t n) const {
    if constexpr (V::slides && (Taps - 1) * Step <= static_cast<int>(V::width)) {
      if (job_.symmetric && job_.taps == Taps && job_.channels == Step) {
        slide_sum<V, Taps, Step>(from, job_.weights, to, n);
        return true;
      }
    }
    return false;
  }

  /// n sums along a row from their first taps on; whole vectors are written.
  void sum(const float* from, std::size_t n, float* to) const {
    if (slide<3, 1>(from, to, n) || slide<5, 1>(from, to, n) || slide<7, 1>(from, to, n) ||
        slide<9, 1>(from, to, n) || slide<3, 2>(from, to, n) || slide<5, 2>(from, to, n) ||
        slide<7, 2>(from, to, n) || slide<9, 2>(from, to, n)) {
      return;
    }
    tap_sum<V>(
        job_.taps, job_.weights, n,
        [&](int k) { return from + static_cast<std::size_t>(k) * step_; },
        [&](std::size_t i, f x) { V::store(to + i, x); });
  }

  /// Values [at, at + n) of row y summed along the row and rounded; whole vectors are written.
  ///
  /// A row is decoded, summed and rounded in three loops where lanes slide: one loop of all would
  /// fill the processor's queues with waiting additions.
  void sum_across(int y, std::size_t at, std::size_t n, float* to) const {
    if constexpr (sizeof(code) == sizeof(float)) {
      // [from, until): all taps, and all that whole vectors read beyond them, lie within the row.
      const std::size_t before = at >= margin_ ? 0 : up(margin_ - at);
      const std::size_t from = at + before, reach = margin_ + blur_job::slack;
      const std::size_t end = at + n + reach <= row_size_ ? at + n : row_size_ - reach;
      if (row_size_ >= reach && end >= from + V::width) {
        const std::size_t within = (end - from) / V::width * V::width, until = from + within;
        if (before > 0) sum(buffered(y, at, before), before, to);
        sum(in_row(y) + from - margin_, within, to + before);
        const std::size_t rest = at + n - until;
        if (rest > 0) sum(buffered(y, until, rest), rest, to + (until - at));
        return;
      }
    }
    const float* from = buffered(y, at, n);
    if constexpr (sizeof(code) != sizeof(float) && !V::slides) {
      return tap_sum<V>(
          job_.taps, job_.weights, n,
          [&](int k) { return from + static_cast<std::size_t>(k) * step_; },
          [&](std::size_t i, f x) { V::store(to + i, texels_.round(x)); });
    }
    sum(from, n, to);
    if constexpr (sizeof(code) == sizeof(float)) return;
    for (std::size_t i = 0; i < n; i += V::width) V::store(to + i, texels_.round(V::load(to + i)));
  }

  static std::size_t up(std::size_t n) { return (n + V::width - 1) / V::width * V::width; }

  /// Row y, straight to memory where whole vectors fit.
  void across(int y) const {
    if constexpr (sizeof(code) == sizeof(float)) {
      if (row_size_ % V::width == 0) return sum_across(y, 0, row_size_, out_row(y));
    }
    sum_across(y, 0, row_size_, line(0));
    put(line(0), row_size_, out_row(y));
  }

  /// Rows from y on, from the rows around them as they lie in memory.
  void down(int y, int rows) const {
    if constexpr (sizeof(code) == sizeof(float)) {
      for (int k = 0; k < job_.taps - 1 + rows; ++k) {
        const int from = job_.rows[y - job_.first + k];
        job_.lines[k] = from < 0 ? border_line() : in_row(from);
      }
      const std::size_t whole = row_size_ / V::width * V::width;
      sum_down(whole, out_row(y), rows);
      for (int r = 0; r < rows; ++r) {
        for (std::size_t i = whole; i < row_size_; ++i) {
          float sum = job_.weights[0] * job_.lines[r][i];
          for (int k = 1; k < job_.taps; ++k) sum = sum + job_.weights[k] * job_.lines[r + k][i];
          out_row(y + r)[i] = sum;
        }
      }
    }
  }

  float* border_line() const {
    for (std::size_t i = 0; i < row_size_; ++i) line(0)[i] = job_.border;
    return line(0);
  }

  /// Values [at, at + n) of all rows in both directions.
  void strip(std::size_t at, std::size_t n) const {
    const int lines = blur_job::most + job_.taps;
    const auto make = [&](int i) {  // line i of the rows' table
      float* to = line(i % lines);
      const int from = job_.rows[i];
      if (from >= 0) return sum_across(from, at, n, to);
      for (std::size_t k = 0; k < n; ++k) to[k] = job_.border;
    };
    const int margin = job_.taps - 1, count = job_.last - job_.first;
    for (int i = 0; i < margin; ++i) make(i);
    for (int y = 0, rows = 0; y < count; y += rows) {
      rows = rows_at_once(count - y);
      for (int r = 0; r < rows; ++r) make(y + margin + r);
      for (int i = 0; i < rows + margin; ++i) job_.lines[i] = line((y + i) % lines);
      sum_down(n, out_row(job_.first + y) + at, rows);
    }
  }

  static int rows_at_once(int left) {
    if (left >= V::blur_rows) return V::blur_rows;
    return left < blur_job::group ? left : blur_job::group;
  }

  /// A vector of sums to the row r of `out`, of which n values exist.
  void put_vector(code* out, int r, std::size_t i, std::size_t n, f sum) const {
    code* to = out + static_cast<std::size_t>(r) * row_size_ + i;
    if (i + V::width <= n) return texels_.store(to, sum);
    code last[V::width];
    texels_.store(last, sum);
    for (std::size_t k = 0; i + k < n; ++k) to[k] = last[k];
  }

  template <int Taps, int Rows = V::blur_rows>
  bool symmetric_down(std::size_t n, code* out, int rows) const {
    if (!job_.symmetric || job_.taps != Taps) return false;
    if (rows != Rows) {
      if constexpr (Rows > blur_job::group) return symmetric_down<Taps, blur_job::group>(n, out, rows);
      return false;
    }
    const auto sums = [&](std::size_t first, std::size_t end, auto put) {
      row_sums<V, Taps, Rows>(job_.lines, job_.weights, first, end, put);
    };
    const auto put = [&](int r, std::size_t i, f sum)
                         __attribute__((always_inline)) { put_vector(out, r, i, n, sum); };
    const std::size_t row = row_size_, head = stream_ ? to_line(out) : 0;
    const std::size_t end = n < head ? 0 : head + (n - head) / V::width * V::width;
    const Texels texels = texels_;
    if (stream_ && end > 0) {
      // What the caches cannot keep goes past them, by whole aligned vectors.
      sums(0, head, put);
      sums(head, end, [=](int r, std::size_t i, f sum) __attribute__((always_inline)) {
        texels.stream(out + static_cast<std::size_t>(r) * row + i, sum);
      });
    } else {
      sums(0, end, [=](int r, std::size_t i, f sum) __attribute__((always_inline)) {
        texels.store(out + static_cast<std::size_t>(r) * row + i, sum);
      });
    }
    sums(end, n, put);
    return true;
  }

  /// Values up to the next cache line.
  static std::size_t to_line(const code* p) {
    return (64 - reinterpret_cast<std::uintptr_t>(p) % 64) % 64 / sizeof(code);
  }

  void sum_down(std::size_t n, code* out, int rows) const {
    if (symmetric_down<3>(n, out, rows) || symmetric_down<5>(n, out, rows) ||
        symmetric_down<7>(n, out, rows) || symmetric_down<9>(n, out, rows)) {
      return;
    }
    for (int r = 0; r < rows; ++r) {
      tap_sum<V>(
          job_.taps, job_.weights, n, [&](int k) { return job_.lines[r + k]; },
          [&](std::size_t i, f sum) { put_vector(out, r, i, n, sum); });
    }
  }

  const blur_job& job_;
  const Texels texels_{};
  const std::size_t row_size_;
  const std::size_t step_, margin_, ring_row_;
  /// All rows start alike within a cache line, and there are many of them. Of smaller pieces than
  /// half a line each, some would leave the processor's buffers before their line is whole.
  const bool stream_;
};

}  // namespace bitshade::texture_kernels
