// SHA-256: inputs are told apart by what is in them, not by their names or dates.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace bitshade {

/// The digest of a stream of bytes [FIPS180-4].
class sha256 {
 public:
  void update(std::span<const std::byte> bytes);
  template <class T>
  void update_value(const T& value) {
    update(std::as_bytes(std::span<const T>(&value, 1)));
  }
  /// 64 hexadecimal digits; the object has no further use.
  std::string finish();

 private:
  void block(const std::byte* bytes);

  std::array<std::uint32_t, 8> state_{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                      0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<std::byte, 64> pending_{};
  std::size_t pending_size_ = 0;
  std::uint64_t total_ = 0;
};

}  // namespace bitshade
