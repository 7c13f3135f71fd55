#include "run/storage.hpp"

#include "bitshade/arithmetic/bulk.hpp"
#include "bitshade/formats/name.hpp"
#include "io/error.hpp"
#include "io/format_names.hpp"

namespace bitshade {

storage_format storage_named(const std::string& format) {
  const auto code = parse_encoding(format);
  if (!code) throw usage_error("'" + format + "' " + explain_format_name(format));
  storage_format result;
  result.format = *code;
  result.bits = code->width;
  // The rule of default_arithmetic: binary32 as far as it holds the format's range and precision.
  result.wide = code->kind == family::binary ? (code->fraction_bits > 23 || code->exponent_bits > 8)
                                             : code->width > 32;
  const bool native = *code == (result.wide ? binary64::value : binary32::value);
  if (!native) result.code = *code;
  return result;
}

void round_row(const storage_format& format, std::span<float> row) {
  if (format.code) bulk::round(*format.code, format.rounding, row, row);
}

void round_row(const storage_format& format, std::span<double> row) {
  if (format.code) bulk::round(*format.code, format.rounding, row, row);
}

}  // namespace bitshade
