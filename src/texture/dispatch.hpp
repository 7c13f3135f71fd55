// What the functions on images share: their kernels and their refusals.
#pragma once

#include <stdexcept>

#include "bitshade/texture/bulk.hpp"
#include "texture/jobs.hpp"

namespace bitshade::bulk {

/// The kernels of a set, or null for instruction_set::scalar: the templates themselves.
/// Failure  std::invalid_argument where the processor lacks the set.
const texture_kernels::kernels* kernels_of(instruction_set set);

/// Refuses rows outside an image of `height` rows.
inline void require_rows(row_range rows, int height) {
  if (rows.first < 0 || rows.first > rows.last || rows.last > height)
    throw std::invalid_argument("bitshade::bulk: rows outside the image");
}

template <class A, class B>
void require_same_size(const image<A>& a, const image<B>& b) {
  if (a.width != b.width || a.height != b.height || a.channels != b.channels)
    throw std::invalid_argument("bitshade::bulk: the images differ in size");
}

/// The 16-bit texels that have kernels of their own, if these are some.
bool is_plain_half(const texel_code& code);
bool is_plain_unorm16(const texel_code& code);

}  // namespace bitshade::bulk
