// The words of --format, --rounding, --subnormal and --overflow, which several commands share.
#pragma once

#include <string>
#include <vector>

#include "bitshade/formats/encoding.hpp"
#include "bitshade/formats/rules.hpp"

namespace bitshade::command {

inline constexpr const char* rounding_words[] = {"nearest-even", "nearest-away", "toward-zero", "up",
                                                 "down",         "to-odd",       "stochastic"};
inline constexpr const char* subnormal_words[] = {"preserve", "flush"};
inline constexpr const char* overflow_words[] = {"infinity", "saturate", "ieee"};

/// What a format's name means: one encoding, or the components of a packed texel, lowest bits first.
struct format_choice {
  std::string name;
  std::vector<encoding> components;
  int width = 0;
};

/// Throws usage_error with the nearest known name where there is no such format.
format_choice choose_format(const std::string& name);

/// Throw usage_error with the nearest known word where `word` is none.
rounding choose_rounding(const std::string& word);
subnormals choose_subnormal(const std::string& word);
overflow choose_overflow(const std::string& word);

}  // namespace bitshade::command
