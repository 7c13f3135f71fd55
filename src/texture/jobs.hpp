// What the row kernels are asked to do, as numbers and pointers. They are compiled with more
// instructions than the rest, so they call no inline function that another file might compile too.
#pragma once

#include <cstddef>
#include <cstdint>

namespace bitshade::texture_kernels {

/// How memory holds texels; what is computed is binary32.
enum class texels : std::uint8_t { binary32, half, unorm16 };

/// Larger images are written past the caches.
constexpr std::size_t cached_bytes = std::size_t{4} << 20;

/// Rows [first, last) of an image blurred along its rows, its columns or both.
///
/// Sums run over the taps in their order, products first, without fma; what is stored between both
/// directions and at the end is rounded as `kind` says.
struct blur_job {
  enum class direction : std::uint8_t { x, y, both };
  direction along;
  texels kind;
  const void* in;
  void* out;
  int width, height, channels;
  int first, last;
  const float* weights;
  int taps;
  bool symmetric;
  const int* columns;  ///< source column of x = -radius .. width + radius - 1; -1: the border
  const int* rows;     ///< source row of y = first - radius .. last + radius - 1; -1: the border
  float border;
  float* scratch;       ///< scratch_size(*this) of them
  const float** lines;  ///< most + taps of them

  static constexpr std::size_t tile = 4096;  ///< values a row: taps + group of them fit the cache
  static constexpr int group = 4;            ///< rows made at once
  static constexpr int most = 8;             ///< lanes may take up to so many
  static constexpr std::size_t slack = 32;   ///< whole vectors may be read and written
};

/// Rows [first, last) of the next smaller level of an image of even width and height:
/// ((a + b) + (c + d)) / 4. 1, 2 or 4 channels.
struct mip_job {
  texels kind;
  const void* in;
  void* out;
  int width, channels;  ///< of `in`
  int first, last;
};

/// What a summed-area table sums: texels in binary32, or 16-bit codes in wrapping 32-bit integers.
enum class sums : std::uint8_t { of_texels, of_codes };

/// A band of a strip of a summed-area table: running sums along its rows, then down its columns.
struct sat_job {
  sums what;
  texels kind;
  const void* in;
  void* out;
  std::size_t row_size;   ///< values from a row to the next
  std::size_t first, n;   ///< values of each row; `first` at a texel's first channel
  int channels, first_row, rows;
  bool streams;           ///< past the caches
  std::uint32_t* carry;   ///< bits of the sums at the strip's left: rows * channels, updated
  std::uint32_t* above;   ///< bits of the row above: n, updated
  static constexpr int band = 16;
};

/// How coordinates and weights are put on a grid of 2^-8.
enum class grid : std::uint8_t { none, floor, nearest, weights };
enum class blend : std::uint8_t { mul_add, fma, products };

/// Two texels and a weight along an axis, by the definition, for samples that lie at an edge: index
/// -1 is the border.
struct axis_lookup {
  int i0, i1;
  double weight;
};
struct sample_job;
using define_axis = axis_lookup (*)(const sample_job&, float coordinate, bool vertical);

/// Bilinear lookups of a level: n samples of 1 or 2 channels.
///
/// products are summed in binary64 from weights on the grid and rounded once; the others are
/// binary32 throughout.
struct sample_job {
  texels kind;
  const void* in;
  int width, height, channels;
  grid snapped;
  blend order;
  const float* u;
  const float* v;
  float* out;
  std::size_t n;
  float border[2];
  define_axis define;
  const void* context;  ///< of `define`
};

/// Exact lookups of binary32 texels, rounded once, where binary64 can tell.
struct certify_job {
  sample_job lookup;      ///< kind binary32, no grid
  double divisor;         ///< of the texels
  double relative_error;  ///< of the value, in units of the largest texel / divisor
  std::uint32_t* undecided;  ///< places in `out` that binary64 cannot tell; room for all
  std::size_t count;         ///< how many there are
};

/// The kernels of one instruction set; each returns false where it has none for the job.
struct kernels {
  bool (*blur)(const blur_job&);
  bool (*mip)(const mip_job&);
  bool (*sat)(const sat_job&);
  bool (*sample)(const sample_job&);
  bool (*certify)(certify_job&);
};

namespace sse2 {
extern const kernels all;
}
namespace avx2 {
extern const kernels all;
}
namespace avx512 {
extern const kernels all;
}

}  // namespace bitshade::texture_kernels
