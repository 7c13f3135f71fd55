// Any text as a format's name: an encoding that is valid and whose name reads back, or a sentence.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "bitshade/formats/name.hpp"
#include "io/format_names.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string name(reinterpret_cast<const char*>(data), size);
  const auto e = bitshade::parse_encoding(name);
  if (e && (!bitshade::is_valid(*e) || bitshade::parse_encoding(bitshade::name_of(*e)) != *e)) std::abort();
  if (size < 64 && !e && bitshade::explain_format_name(name).size() < 20) std::abort();
  return 0;
}
