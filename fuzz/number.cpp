// Text to bits: whatever parse_number reads without a power of 2 and 10 together, MPFR reads as the same number.
#include <mpfr.h>

#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "bitshade/formats/text.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 2000) return 0;
  const std::string text(reinterpret_cast<const char*>(data), size);
  const auto x = bitshade::parse_number(text);
  if (!x) return 0;
  constexpr bitshade::encoding e = bitshade::binary64::value;
  const std::uint64_t bits = bitshade::encode(e, *x);
  bitshade::encode(bitshade::unorm16::value, *x);
  bitshade::encode(bitshade::fixed_encoding(4, 12), *x);
  // MPFR reads plain decimals and hexadecimal floats; among binary64's normal numbers 53 bits are its rounding.
  const auto trimmed = bitshade::detail::trimmed(text);
  if (x->what != bitshade::exact_number::kind::finite || trimmed.find('/') != std::string_view::npos) return 0;
  mpfr_t want;
  mpfr_init2(want, 53);
  char* end = nullptr;
  const std::string word(trimmed);
  mpfr_strtofr(want, word.c_str(), &end, 0, MPFR_RNDN);
  if (*end != '\0') std::abort();
  const double got = std::bit_cast<double>(bits);
  const double size_of = got < 0 ? -got : got;
  if (size_of > 0x1p-1000 && size_of < 0x1p1000 && mpfr_cmp_d(want, got) != 0) std::abort();
  mpfr_clear(want);
  return 0;
}
