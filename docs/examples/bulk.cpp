// Whole spans at memory speed, in any format and direction, by the widest instructions that the processor has.
#include <cstdint>
#include <cstdio>
#include <vector>

#include "bitshade/arithmetic/bulk.hpp"
#include "bitshade/formats/name.hpp"

using namespace bitshade;

int main() {
  const std::vector<float> depths{0.1f, 0.25f, 0.7f, 1.5f};
  std::vector<float> rounded(depths.size());
  std::vector<std::uint16_t> codes(depths.size());
  for (const char* name : {"unorm16", "half", "e5m7"}) {
    const encoding e = parse_encoding(name).value();
    bulk::round(e, {}, depths, rounded);
    bulk::encode(e, {}, depths, std::span<std::uint16_t>(codes));
    std::printf("%-8s", name);
    for (std::size_t i = 0; i < depths.size(); ++i) std::printf(" %.7g (0x%04x)", static_cast<double>(rounded[i]), unsigned{codes[i]});
    std::printf("\n");
  }
}
// Prints:
// unorm16  0.1000076 (0x199a) 0.2500038 (0x4000) 0.6999924 (0xb332) 1 (0xffff)
// half     0.09997559 (0x2e66) 0.25 (0x3400) 0.7001953 (0x399a) 1.5 (0x3e00)
// e5m7     0.1000977 (0x05cd) 0.25 (0x0680) 0.6992188 (0x0733) 1.5 (0x07c0)
