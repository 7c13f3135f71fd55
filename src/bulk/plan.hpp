// What a kernel needs to know of an encoding and its rules, as numbers. Kernels are compiled with more
// instructions than the rest, so they call no inline function that another file might compile too; enums are all
// that they take from the library's headers.
#pragma once

#include <cstddef>
#include <cstdint>

#include "bitshade/formats/encoding.hpp"
#include "bitshade/formats/rules.hpp"

namespace bitshade::bulk_kernels {

enum class operation : std::uint8_t { round, encode, decode };

/// How a binary format's exponents lie in those of the lanes that carry it.
enum class reach : std::uint8_t {
  narrow,  ///< fewer exponent bits: subnormals begin early, found by clamping the exponent
  equal,   ///< the same: one integer addition rounds normal and subnormal numbers alike
  wider    ///< more (binary32 lanes): every lane is a normal number of the format
};

/// Numbers that depend on the width of the lanes; bits of binary32 or binary64. Some are the same for every encoding:
/// what a compiler knows to be constant it makes anew within the loops, in more instructions than a load takes.
struct lane_numbers {
  std::uint64_t magnitude, infinity;  ///< all bits but the sign; the exponent's
  std::uint64_t overflow[2];   ///< magnitude that an overflowing value becomes, positive and negative
  std::uint64_t infinite;      ///< magnitude that an infinity becomes
  std::uint64_t largest;       ///< largest finite number
  std::uint64_t limit;         ///< largest number that does not overflow to nearest even
  std::uint64_t min_normal;
  bool natural_overflow;       ///< overflow gives infinity (NaN where there is none) or, as IEEE's direction says, `largest`
};

struct plan;

/// The definition, for elements [first, first + n) of the span: what a kernel calls where it cannot decide.
using definition = void (*)(const plan&, const void* in, void* out, std::size_t n, std::size_t first);

struct plan {
  definition define;
  encoding format;
  rules rule;
  family kind;
  specials special;
  rounding direction;
  norm_decode norm;
  int exponent_bits, fraction_bits, width, bias;
  int random_bits;
  bool has_sign;
  bool flush_codes;   ///< subnormal results become zero when encoding
  bool flush_values;  ///< the same when rounding: reading flushes as well
  bool flush_loads;   ///< subnormal codes are read as zero
  bool canonical_nan;
  bool keeps;         ///< signs, subnormals and NaNs
  bool one_overflow;  ///< overflow gives one magnitude for every cause; without infinities NaN's
  std::uint64_t sign, max_code, nan_code, min_normal_code;
  std::uint64_t overflow_code[2], infinite_code;  ///< magnitudes
  lane_numbers single, wide;                      ///< seen from binary32 and binary64 lanes
  // Norms and fixed point: code = x * scale for low <= x <= high, x = code / scale.
  double scale, low, high;
  float single_step;   ///< fl32(1 / scale)
  float single_rest;   ///< fl32(1 / scale - single_step), or 0 where a reciprocal is asked for
  double wide_step;    ///< fl64(1 / scale)
  std::uint32_t random_start[2], random_middle[2];  ///< of rounding_stream: for the upper words, for the lower
  std::uint32_t random_weyl, random_factors[3];  ///< of rounding_stream
  std::uint32_t random_step;   ///< of the block of 32 numbers that the first element lies in
  std::uint64_t seed, counter;
};

/// A kernel: n elements from in to out.
using kernel = void (*)(const plan&, const void* in, void* out, std::size_t n);

/// How a kernel wants the processor's rounding direction, with flushing off; or it does not care.
enum class setting : std::uint8_t { nearest, down, up, toward_zero, any };

struct chosen {
  kernel run = nullptr;  ///< null where no kernel of this set covers the case
  setting wants = setting::nearest;
  kernel finish = nullptr;  ///< if any, goes over what `run` wrote, to nearest
};

/// What a kernel reads and writes: 'f' and 'd' for float and double, 'b' 'h' 'w' 'q' for codes of 8 to 64 bits.
struct request {
  operation what;
  char in, out;
};

namespace sse2 {
chosen choose(const plan& p, request r);
}
namespace avx2 {
chosen choose(const plan& p, request r);
chosen choose_native(const encoding& e, const rules& k, request r);  ///< by conversion instructions; needs no plan
}
namespace avx512 {
chosen choose(const plan& p, request r);
chosen choose_native(const encoding& e, const rules& k, request r);
}

}  // namespace bitshade::bulk_kernels
