// Whole spans rounded, encoded and decoded at memory speed. Compiled: link bitshade::bulk.
#pragma once

#include <cstdint>
#include <span>

#include "bitshade/formats/encoding.hpp"
#include "bitshade/formats/rules.hpp"

namespace bitshade::bulk {

/// Which instructions do the work. All give the same bits.
enum class instruction_set : std::uint8_t {
  best,      ///< the widest that this processor has
  scalar,    ///< the definition itself, one number at a time
  baseline,  ///< what every x86-64 has: SSE2
  avx2,      ///< with FMA and F16C
  avx512     ///< F, BW, DQ and VL
};

/// Whether this processor, and this build, can run a set.
bool has(instruction_set set);

class workers;

/// How a span is worked on. The result does not depend on `threads`, `crew` or `set`.
struct execution {
  std::uint64_t seed = 0;           ///< key of stochastic rounding
  std::uint64_t first_counter = 0;  ///< element i draws rounding_bits(seed, first_counter + i)
  unsigned threads = 1;             ///< more than one only when asked
  instruction_set set = instruction_set::best;
  workers* crew = nullptr;  ///< threads that wait between calls (workers.hpp), instead of new ones
};

/// out[i] = round_to(to, in[i]), converted to out's type to nearest even.
///
/// Shapes   equal sizes; `out` may be `in`, or must not overlap it.
/// Policy   r; neither the caller's rounding direction nor flush-to-zero matters, and both are restored.
/// Error    none beyond round_to's one rounding: bit for bit decode(to, encode(to, in[i], r, random), r). The
///          last conversion only rounds what binary32 cannot hold: norms (then the binary32 nearest to the
///          code's ratio) and formats with more exponent or fraction bits.
/// Failure  std::invalid_argument for sizes that differ, an invalid encoding, codes that do not fit their
///          span's type, or an instruction set that this processor lacks.
void round(const encoding& to, const rules& r, std::span<const float> in, std::span<float> out,
           const execution& how = {});
void round(const encoding& to, const rules& r, std::span<const double> in, std::span<double> out,
           const execution& how = {});

/// out[i] = encode(to, in[i]); the span's type has at least the encoding's width.
void encode(const encoding& to, const rules& r, std::span<const float> in, std::span<std::uint8_t> out,
            const execution& how = {});
void encode(const encoding& to, const rules& r, std::span<const float> in, std::span<std::uint16_t> out,
            const execution& how = {});
void encode(const encoding& to, const rules& r, std::span<const float> in, std::span<std::uint32_t> out,
            const execution& how = {});
void encode(const encoding& to, const rules& r, std::span<const double> in, std::span<std::uint8_t> out,
            const execution& how = {});
void encode(const encoding& to, const rules& r, std::span<const double> in, std::span<std::uint16_t> out,
            const execution& how = {});
void encode(const encoding& to, const rules& r, std::span<const double> in, std::span<std::uint32_t> out,
            const execution& how = {});
void encode(const encoding& to, const rules& r, std::span<const double> in, std::span<std::uint64_t> out,
            const execution& how = {});

/// out[i] = decode(from, in[i], r), converted to out's type to nearest even (a NaN comes out quiet).
void decode(const encoding& from, const rules& r, std::span<const std::uint8_t> in, std::span<float> out,
            const execution& how = {});
void decode(const encoding& from, const rules& r, std::span<const std::uint16_t> in, std::span<float> out,
            const execution& how = {});
void decode(const encoding& from, const rules& r, std::span<const std::uint32_t> in, std::span<float> out,
            const execution& how = {});
void decode(const encoding& from, const rules& r, std::span<const std::uint8_t> in, std::span<double> out,
            const execution& how = {});
void decode(const encoding& from, const rules& r, std::span<const std::uint16_t> in, std::span<double> out,
            const execution& how = {});
void decode(const encoding& from, const rules& r, std::span<const std::uint32_t> in, std::span<double> out,
            const execution& how = {});
void decode(const encoding& from, const rules& r, std::span<const std::uint64_t> in, std::span<double> out,
            const execution& how = {});

/// Arithmetic on binary16 codes, each result the exact one rounded once to nearest even; every NaN
/// is the positive one with an empty payload, as in operations.hpp.
///
/// Shapes   equal sizes; `out` may be one of the operands.
/// Error    none beyond the one rounding, fma included: binary32 carries the others [Figueroa95], and the fma's sum
///          is rounded to odd before it is rounded to half [BoldoMelquiond08].
/// Failure  std::invalid_argument for sizes that differ or an instruction set that this processor lacks.
using half_codes = std::span<const std::uint16_t>;
void add(half_codes a, half_codes b, std::span<std::uint16_t> out, const execution& how = {});
void subtract(half_codes a, half_codes b, std::span<std::uint16_t> out, const execution& how = {});
void multiply(half_codes a, half_codes b, std::span<std::uint16_t> out, const execution& how = {});
void divide(half_codes a, half_codes b, std::span<std::uint16_t> out, const execution& how = {});
void sqrt(half_codes a, std::span<std::uint16_t> out, const execution& how = {});
void fma(half_codes a, half_codes b, half_codes c, std::span<std::uint16_t> out, const execution& how = {});

}  // namespace bitshade::bulk
