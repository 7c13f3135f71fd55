// Whole images filtered at memory speed. Compiled: link bitshade::bulk.
//
// Every function gives the bits of the templates that it names, which are the definition. Those on
// rows work on [rows.first, rows.last) of the result alone, so that a caller may share an image
// among threads in any way: the bits stay the same.
#pragma once

#include <cstdint>
#include <span>

#include "bitshade/arithmetic/bulk.hpp"
#include "bitshade/texture/address.hpp"
#include "bitshade/texture/gaussian.hpp"
#include "bitshade/texture/image.hpp"
#include "bitshade/texture/mip.hpp"

namespace bitshade::bulk {

/// Rows [first, last) of an image.
struct row_range {
  int first = 0, last = 0;
};

/// How images of codes are read and written.
struct texel_code {
  encoding format;
  rules rule{};
};

/// blur_row_x and blur_row_y of binary32 images.
///
/// Shapes   out as large as in, another image; odd taps.
/// Policy   binary32 in the templates' order; the processor rounds to nearest even.
/// Failure  std::invalid_argument for images that differ in size, rows outside them, or an
///          instruction set that this processor lacks.
void blur_x(const image<float>& in, const kernel& weights, address mode, row_range rows,
            image<float>& out, instruction_set set = instruction_set::best, float border = 0);
void blur_y(const image<float>& in, const kernel& weights, address mode, row_range rows,
            image<float>& out, instruction_set set = instruction_set::best, float border = 0);

/// Both, first along rows.
void blur(const image<float>& in, const kernel& weights, address mode, row_range rows,
          image<float>& out, instruction_set set = instruction_set::best, float border = 0);

/// Both, on 16-bit codes: decoded, blurred along rows and rounded, blurred along columns, encoded.
///
/// Policy   as above; roundings to the format are bulk::round's and bulk::encode's.
/// Failure  as above and those of bulk::encode.
void blur(const texel_code& code, const image<std::uint16_t>& in, const kernel& weights,
          address mode, row_range rows, image<std::uint16_t>& out,
          instruction_set set = instruction_set::best, float border = 0);

/// downsample_row: rows of the next smaller level.
///
/// Shapes   out: max(1, width / 2) x max(1, height / 2).
/// Policy   binary32 in the template's order; 16-bit codes are decoded before and encoded after.
/// Failure  std::invalid_argument for an image of another size or rows outside it.
void downsample(const image<float>& in, mip_filter filter, row_range rows, image<float>& out,
                instruction_set set = instruction_set::best);
void downsample(const texel_code& code, const image<std::uint16_t>& in, mip_filter filter,
                row_range rows, image<std::uint16_t>& out,
                instruction_set set = instruction_set::best);

/// All levels over levels[0], as mip_chain makes them: blocks of rows are carried through several
/// levels while they are in the cache.
///
/// Shapes   levels[l] has the size that mip_size gives. how.threads share the blocks.
/// Policy   downsample's.
/// Failure  std::invalid_argument for a level of another size, or an instruction set that this
///          processor lacks.
void fill_mips(std::span<image<float>> levels, mip_filter filter, const execution& how = {});
void fill_mips(const texel_code& code, std::span<image<std::uint16_t>> levels, mip_filter filter,
               const execution& how = {});

/// The table of make_sat(in, sat_order::running, sat_offset::none, ..): along rows, then columns,
/// in one pass; of codes the binary32 sums of what they decode to.
///
/// Shapes   out as large as in, another image. how.threads share the image by columns.
/// Failure  std::invalid_argument for images that differ in size, or an instruction set that this
///          processor lacks.
void sum_area(const image<float>& in, image<float>& out, const execution& how = {});
void sum_area(const texel_code& code, const image<std::uint16_t>& in, image<float>& out,
              const execution& how = {});

/// make_modular_sat: the wrapping sums of the codes themselves.
void sum_area(const image<std::uint16_t>& codes, image<std::uint32_t>& out,
              const execution& how = {});

}  // namespace bitshade::bulk
