// A configuration's storage format at run time, and rows rounded to it.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "bitshade/formats/encoding.hpp"
#include "bitshade/formats/rules.hpp"

namespace bitshade {

/// Where values are kept between stages. Without an encoding nothing is rounded.
struct storage_format {
  encoding format;               ///< what the name means
  std::optional<encoding> code;  ///< the same; none where the arithmetic's own type holds it all
  rules rounding;
  bool wide = false;  ///< computed in binary64; else in binary32
  int bits = 0;       ///< of one stored value
};

/// Throws usage_error for a name that is no format, with the nearest known one.
storage_format storage_named(const std::string& format);

/// Each value as the format hands it back.
void round_row(const storage_format& format, std::span<float> row);
void round_row(const storage_format& format, std::span<double> row);

}  // namespace bitshade
