// What is wrong with a format's name that no format has.
#pragma once

#include <string>
#include <string_view>

namespace bitshade {

/// The end of an error sentence about it:
///   "is out of range: unormN needs 1 <= N <= 32"     right in form
///   "is no format; did you mean 'unorm12'?"          a few edits from one, of any number of bits
///   "is no format; write half, ... or eXmY, ..."     anything else
/// The case of letters is no edit; names of other tools (fp16, R16_UNORM ...) find ours.
std::string explain_format_name(std::string_view name);

}  // namespace bitshade
