// Summed-area tables of moments: codes, running sums and the corners of a rectangle.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "bitshade/arithmetic/bulk.hpp"
#include "bitshade/formats/decode.hpp"
#include "bitshade/formats/limits.hpp"
#include "bitshade/texture/sat.hpp"
#include "io/error.hpp"
#include "run/storage.hpp"
#include "run/summed_area.hpp"

namespace bitshade {

template <class T>
T sum_over(const summed_area<T>& sums, const texel_box& box, int channel) {
  return box_sum(sums, box.x0, box.y0, box.x1 - 1, box.y1 - 1, channel);
}

/// A row's codes in the type of their sums.
template <class T, class Code>
void encode_row(const storage_format& storage, std::span<const T> row, std::span<Code> codes) {
  if constexpr (std::is_same_v<T, float> && sizeof(Code) > 4) {
    std::vector<std::uint32_t> narrow(row.size());  // binary32 never computes for wider codes
    bulk::encode(storage.format, storage.rounding, row, std::span(narrow));
    std::copy(narrow.begin(), narrow.end(), codes.begin());
  } else {
    bulk::encode(storage.format, storage.rounding, row, codes);
  }
}

/// Running sums without an offset, as every run makes them; `round` stores a row of sums.
template <class T, class Round>
summed_area<T> running_table(image<T> texels, Round round) {
  return make_sat(std::move(texels), sat_order::running, sat_offset::none, round);
}

/// Refuses a format whose largest number is below what the sums of a whole map of ones may reach.
inline void require_sums_fit(int width, int height, const storage_format& storage,
                             const std::string& name) {
  const double most = decode(storage.format, max_bits(storage.format));
  try {
    require_sat_fits(width, height, 1.0, most);
  } catch (const std::invalid_argument&) {
    throw usage_error("a summed-area table of " + std::to_string(width) + " x " +
                      std::to_string(height) + " texels overflows " + name +
                      ": ask for a smaller --size, or a format of wider range such as binary32");
  }
}

}  // namespace bitshade
