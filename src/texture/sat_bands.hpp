// Running sums along rows and down columns at once: a square of values is transposed, so that its
// rows are summed side by side, each in its own order, and transposed back.
#pragma once

#include "texture/jobs.hpp"
#include "texture/texels.hpp"

namespace bitshade::texture_kernels {

/// Sums in binary32. -0 + x is x, whatever x: it stands before the first term.
template <class V, class Texels>
struct float_sums {
  using code = typename Texels::code;
  using out = float;
  using vector = typename V::f;
  static constexpr std::uint32_t nothing = 0x80000000u;
  Texels texels;
  [[gnu::always_inline]] vector load(const code* p) const { return texels.load(p); }
  [[gnu::always_inline]] static vector add(vector a, vector b) { return V::add(a, b); }
  [[gnu::always_inline]] static typename V::f value(vector a) { return a; }
  [[gnu::always_inline]] static vector from(typename V::f a) { return a; }
};

/// Sums of codes in 32-bit integers, which wrap.
template <class V>
struct code_sums {
  using code = std::uint16_t;
  using out = std::uint32_t;
  using vector = typename V::i;
  static constexpr std::uint32_t nothing = 0;
  [[gnu::always_inline]] vector load(const code* p) const { return V::load_codes(p); }
  [[gnu::always_inline]] static vector add(vector a, vector b) { return V::iadd(a, b); }
  [[gnu::always_inline]] static typename V::f value(vector a) { return V::value(a); }
  [[gnu::always_inline]] static vector from(typename V::f a) { return V::bits(a); }
};

template <class V, class Sums, int Channels>
class sat_band {
 public:
  explicit sat_band(const sat_job& job) : job_(job) {}

  void run() {
    for (int r = 0; r < job_.rows; r += width) {
      rows_ = job_.rows - r < width ? job_.rows - r : width;
      const std::size_t at = static_cast<std::size_t>(job_.first_row + r) * job_.row_size;
      in_ = static_cast<const code*>(job_.in) + at + job_.first;
      out_ = static_cast<float*>(job_.out) + at + job_.first;
      block_rows(job_.carry + r * Channels);
    }
  }

 private:
  using code = typename Sums::code;
  using f = typename V::f;
  using vector = typename Sums::vector;
  static constexpr int width = static_cast<int>(V::width);
  static constexpr auto lanes = V::width;
  static constexpr std::size_t in_line = 64 / sizeof(float);
  static constexpr std::size_t piece = 256;  ///< values of a row, a kilobyte
  /// Where lines take several vectors, rows of codes leave room in the caches: half of them is read.
  static constexpr bool streams = in_line == lanes || sizeof(code) == sizeof(float);
  /// Fetched early: sixteen rows are more than the processor foresees.
  static constexpr std::size_t ahead = 256 / sizeof(code);

  static float number(std::uint32_t bits) { return __builtin_bit_cast(float, bits); }

  void block_rows(std::uint32_t* carry) {
    vector sum[Channels];
    for (int c = 0; c < Channels; ++c) {
      float at[lanes];
      for (int r = 0; r < width; ++r) at[r] = r < rows_ ? number(carry[r * Channels + c]) : 0;
      sum[c] = Sums::from(V::load(at));
    }
    float* above = reinterpret_cast<float*>(job_.above);
    std::size_t i = 0;
    if (rows_ == width) {
      const auto load = [&](int r) {
        prefetch(r, i);
        return sums_.load(in_ + row(r) + i);
      };
      const std::size_t head = to_line();
      // Rows of whole pages, read and written side by side, would throw each other out of the
      // first level.
      const bool gathers = job_.streams || job_.row_size * sizeof(float) % 4096 == 0;
      const bool whole_lines = job_.row_size * sizeof(float) % 64 == 0 && head % Channels == 0;
      if (streams && gathers && whole_lines && head < job_.n) {
        for (; i < head; i += lanes) partial(sum, above + i, i, head - i < lanes ? head - i : lanes);
        const std::size_t end = head + (job_.n - head) / in_line * in_line;
        if (job_.streams) pieces<true>(sum, above, head, end);
        else pieces<false>(sum, above, head, end);
        i = end;
        V::fence();
      } else {
        for (; i + lanes <= job_.n; i += lanes) {
          block(sum, above + i, width, load, [&](int r, f x) { V::store(out_ + row(r) + i, x); });
        }
      }
    }
    for (; i < job_.n; i += lanes) {
      partial(sum, above + i, i, job_.n - i < lanes ? job_.n - i : lanes);
    }
    for (int c = 0; c < Channels; ++c) {
      float at[lanes];
      V::store(at, Sums::value(sum[c]));
      for (int r = 0; r < rows_; ++r) {
        carry[r * Channels + c] = __builtin_bit_cast(std::uint32_t, at[r]);
      }
    }
  }

  /// Rows of two pieces where a vector is no line: one is gathered while the lines of the other
  /// leave for memory, so that neither waits for the other. Among reads of `in`, writes to places
  /// that end in the same 12 bits would hold each other up, as rows of a power of two do: these rows
  /// keep half a kilobyte from those of `in`.
  struct outgoing {
    static constexpr std::size_t size = (width + 1) * piece;
    alignas(64) float room[in_line == lanes ? 1 : 2 * size];
    float* filled = room;                     ///< rows of the piece being summed
    const float* full = nullptr;              ///< rows of the one before
    std::size_t at = 0, lines = 0, sent = 0;  ///< its first value, its lines a row, those sent

    /// What was filled is full; the next piece begins in the other half.
    void next(const code* in, std::size_t begin, std::size_t values) {
      full = filled;
      at = begin, lines = values / in_line, sent = 0;
      fill(filled < room + size ? room + size : room, in + begin + values);
    }
    void fill(float* half, const code* in) {
      const auto distance =
          reinterpret_cast<std::uintptr_t>(in) - reinterpret_cast<std::uintptr_t>(half);
      filled = half + (distance + 512) % 1024 / 64 * in_line;
    }
  };

  /// Writes up to `count` lines of the full piece, row by row.
  template <bool Streams>
  [[gnu::always_inline]] void send(outgoing& out, std::size_t count) const {
    for (; count > 0 && out.sent < out.lines * lanes; --count, ++out.sent) {
      const std::size_t r = out.sent / out.lines, k = out.sent % out.lines * in_line;
      float* const to = out_ + row(static_cast<int>(r)) + out.at + k;
      for (std::size_t i = 0; i < in_line; i += lanes) {
        const f x = V::load(out.full + r * piece + k + i);
        Streams ? V::stream(to + i, x) : V::store(to + i, x);
      }
    }
  }

  template <bool Streams>
  void pieces(vector (&sum)[Channels], float* above, std::size_t begin, std::size_t end) const {
    outgoing out;
    if constexpr (in_line != lanes) out.fill(out.room, in_ + begin);
    for (std::size_t i = begin; i < end; i += piece) {
      lines<Streams>(sum, above, i, end - i < piece ? end : i + piece, out);
    }
    send<Streams>(out, lanes * piece);
  }

  /// Whole lines [begin, end), at most a piece of them.
  template <bool Streams>
  [[gnu::always_inline]] void lines(vector (&sum)[Channels], float* above, std::size_t begin,
                                    std::size_t end, outgoing& out) const {
    for (std::size_t i = begin; i < end; i += lanes) {
      const auto load = [&](int r) {
        if ((i - begin) % in_line == 0) prefetch(r, i);
        return sums_.load(in_ + row(r) + i);
      };
      block(sum, above + i, width, load, [&](int r, f x) {
        if constexpr (in_line == lanes)
          V::stream(out_ + row(r) + i, x);
        else
          V::store(out.filled + static_cast<std::size_t>(r) * piece + (i - begin), x);
      });
      if constexpr (in_line != lanes) send<Streams>(out, lanes * lanes / in_line);
    }
    if constexpr (in_line == lanes) return;
    send<Streams>(out, lanes * piece);
    out.next(in_, begin, end - begin);
  }

  /// What comes `ahead` values later: in the row, or where the band below begins. An address beyond
  /// the image is never read.
  [[gnu::always_inline]] void prefetch(int r, std::size_t i) const {
    const bool within = i + ahead < job_.n;
    const std::size_t at = within ? row(r) + i + ahead : row(r + width) + (i + ahead - job_.n);
    __builtin_prefetch(reinterpret_cast<const void*>(reinterpret_cast<std::uintptr_t>(in_) +
                                                     at * sizeof(code)));
  }

  std::size_t row(int r) const { return static_cast<std::size_t>(r) * job_.row_size; }

  std::size_t to_line() const {
    return (64 - reinterpret_cast<std::uintptr_t>(out_) % 64) % 64 / sizeof(float);
  }

  template <class Load, class Store>
  [[gnu::always_inline]] void block(vector (&sum)[Channels], float* above, int columns, Load load,
                                    Store store) const {
    f square[lanes];
    for (int r = 0; r < width; ++r) square[r] = Sums::value(load(r));
    V::transpose(square);
    for (int k = 0; k < columns; ++k) {
      vector& s = sum[k % Channels];
      s = Sums::add(s, Sums::from(square[k]));
      square[k] = Sums::value(s);
    }
    V::transpose(square);
    vector down = Sums::from(V::load(above));
    for (int r = 0; r < width; ++r) {
      down = Sums::add(down, Sums::from(square[r]));
      store(r, Sums::value(down));
    }
    V::store(above, Sums::value(down));
  }

  /// A block of fewer rows or columns, in buffers.
  void partial(vector (&sum)[Channels], float* above, std::size_t i, std::size_t n) const {
    code in[lanes][lanes] = {};
    float out[lanes][lanes], last[lanes] = {};
    for (int r = 0; r < rows_; ++r) {
      for (std::size_t k = 0; k < n; ++k) in[r][k] = in_[row(r) + i + k];
    }
    for (std::size_t k = 0; k < n; ++k) last[k] = above[k];
    block(
        sum, last, static_cast<int>(n), [&](int r) { return sums_.load(in[r]); },
        [&](int r, f x) { V::store(out[r], x); });
    for (int r = 0; r < rows_; ++r) {
      for (std::size_t k = 0; k < n; ++k) out_[row(r) + i + k] = out[r][k];
    }
    for (std::size_t k = 0; k < n; ++k) above[k] = out[rows_ - 1][k];
  }

  const sat_job& job_;
  const Sums sums_{};
  int rows_ = 0;
  const code* in_ = nullptr;
  float* out_ = nullptr;
};

template <class V, class Sums>
bool sat_of(const sat_job& job) {
  switch (job.channels) {
    case 1:
      sat_band<V, Sums, 1>(job).run();
      return true;
    case 2:
      sat_band<V, Sums, 2>(job).run();
      return true;
    case 4:
      sat_band<V, Sums, 4>(job).run();
      return true;
    default:
      return false;
  }
}

template <class V>
bool sat_in(const sat_job& job) {
  if (job.what == sums::of_codes) return sat_of<V, code_sums<V>>(job);
  if (job.kind == texels::binary32) return sat_of<V, float_sums<V, native_texels<V>>>(job);
  if constexpr (V::has_fma) {
    if (job.kind == texels::half) return sat_of<V, float_sums<V, half_texels<V>>>(job);
    return sat_of<V, float_sums<V, unorm16_texels<V>>>(job);
  }
  return false;
}

}  // namespace bitshade::texture_kernels
