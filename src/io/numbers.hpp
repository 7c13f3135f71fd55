// Numbers in text, whatever the locale.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace bitshade {

/// "0.2,3,1e-5" as numbers.
///
/// Failure  usage_error that names `option` if a part is no finite number, or if there are fewer
///          than `least` or more than `most`.
std::vector<double> parse_numbers(std::string_view text, const std::string& option,
                                  std::size_t least, std::size_t most);

/// A seed: 0 to 2^64 - 1, in decimal.
///
/// Failure  usage_error that names `option` for anything else; nothing wraps around.
std::uint64_t parse_seed(std::string_view text, const std::string& option);

}  // namespace bitshade
