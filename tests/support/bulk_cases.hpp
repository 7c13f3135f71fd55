// Encodings, rules and inputs that bulk kernels are held against the definition with.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "bitshade/arithmetic/bulk.hpp"
#include "bitshade/formats/name.hpp"
#include "bitshade/formats/random.hpp"
#include "bitshade/formats/round_to.hpp"

namespace bulk_cases {

using namespace bitshade;

inline std::vector<bulk::instruction_set> sets() {
  std::vector<bulk::instruction_set> found;
  for (const auto set : {bulk::instruction_set::scalar, bulk::instruction_set::baseline, bulk::instruction_set::avx2,
                         bulk::instruction_set::avx512}) {
    if (bulk::has(set)) found.push_back(set);
  }
  return found;
}

inline const char* name_of(bulk::instruction_set set) {
  constexpr const char* names[] = {"best", "scalar", "baseline", "avx2", "avx512"};
  return names[static_cast<int>(set)];
}

inline std::string describe(const encoding& e, const rules& r, bulk::instruction_set set) {
  std::ostringstream text;
  text << bitshade::name_of(e) << " set=" << name_of(set) << " rounding=" << int(r.direction)
       << " subnormal=" << int(r.subnormal) << " overflow=" << int(r.overflow) << " nan=" << int(r.nan)
       << " norm=" << int(r.norm) << " random_bits=" << r.random_bits;
  return text.str();
}

template <class T>
auto bits_of(T x) {
  if constexpr (std::is_same_v<T, float>) return std::bit_cast<std::uint32_t>(x);
  if constexpr (std::is_same_v<T, double>) return std::bit_cast<std::uint64_t>(x);
  if constexpr (std::is_integral_v<T>) return x;
}

/// One rule for every direction and every value of every other axis, the axes varied one at a time.
inline std::vector<rules> all_rules() {
  std::vector<rules> list;
  for (int d = 0; d < 7; ++d) {
    for (int o = 0; o < 3; ++o) {
      for (int s = 0; s < 4; ++s) {
        rules r;
        r.direction = static_cast<rounding>(d);
        r.overflow = static_cast<overflow>(o);
        r.subnormal = static_cast<subnormals>(s);
        r.nan = (o + s) % 2 ? nan_payload::canonical : nan_payload::keep;
        r.norm = (o + s) % 3 == 1 ? norm_decode::reciprocal : norm_decode::exact;
        constexpr int lengths[] = {64, 1, 8, 31, 32, 33, 24, 53};
        r.random_bits = lengths[(4 * o + s) % 8];
        list.push_back(r);
      }
    }
  }
  return list;
}

/// Codes, midpoints and thirds between them, each with its neighbours in T; specials; random bit patterns.
template <class T>
std::vector<T> inputs(const encoding& e, std::size_t codes, std::size_t randoms) {
  using word = decltype(bits_of(T{}));
  std::vector<T> list;
  const auto add = [&](double x) {
    const T t = static_cast<T>(x);
    for (const int step : {-1, 0, 1}) list.push_back(std::bit_cast<T>(static_cast<word>(bits_of(t) + step)));
  };
  using limits = std::numeric_limits<T>;
  for (const T x : {T(0), -T(0), limits::denorm_min(), limits::min(), limits::max(), T(1), T(0.5), limits::infinity()}) {
    for (const T signed_x : {x, -x}) {
      list.push_back(signed_x);
      list.push_back(std::nextafter(signed_x, T(0)));
      list.push_back(std::nextafter(signed_x, T(2)));
    }
  }
  constexpr word quiet = word{1} << (limits::digits - 2);
  const word infinity = bits_of(limits::infinity());
  for (const word payload : {word{1}, word{quiet - 1}, quiet, word{quiet | 1}, word{quiet | (quiet >> 1)}}) {
    list.push_back(std::bit_cast<T>(infinity | payload));
    list.push_back(std::bit_cast<T>(static_cast<word>(infinity | payload | ~(~word{0} >> 1))));
  }
  const std::uint64_t count = e.width >= 63 ? ~std::uint64_t{0} >> 1 : std::uint64_t{1} << e.width;
  const std::uint64_t stride = count / codes + 1;
  const auto near_code = [&](std::uint64_t c) {
    const double x = decode(e, c & low_bits(e.width)), y = decode(e, (c + 1) & low_bits(e.width));
    add(x), add(x + (y - x) / 2), add(x + (y - x) / 3);
  };
  for (std::uint64_t c = 0; c < count - stride; c += stride) near_code(c);
  for (const std::uint64_t c : {max_bits(e), max_bits(e) - 1, min_normal_bits(e), min_normal_bits(e) - 1, std::uint64_t{0},
                                std::uint64_t{1}}) {
    near_code(c), near_code(c | sign_bit(e));
  }
  const double largest = decode(e, max_bits(e)), step = largest - decode(e, max_bits(e) - 1);
  for (const double s : {1.0, -1.0}) add(s * (largest + step / 2)), add(s * (largest + step)), add(s * 2 * largest);
  for (std::size_t j = 0; j < randoms; ++j) {
    const std::uint64_t r = random_bits(42, j);
    list.push_back(std::bit_cast<T>(static_cast<word>(r)));
    list.push_back(static_cast<T>(static_cast<double>(r) * 0x1p-64));
    list.push_back(static_cast<T>(std::ldexp(static_cast<double>(r) * 0x1p-63 - 1, static_cast<int>(j % 300) - 150)));
  }
  return list;
}

}  // namespace bulk_cases
