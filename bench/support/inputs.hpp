// Arrays that benchmarks read and write.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <span>

namespace bench {

/// 64-byte aligned, so that every contestant meets the same cache lines.
template <class T>
struct array {
  explicit array(std::size_t n)
      : size(n), owner(static_cast<T*>(std::aligned_alloc(64, (n * sizeof(T) + 63) / 64 * 64)), &std::free) {}
  std::size_t size;
  std::unique_ptr<T, decltype(&std::free)> owner;
  T* data = owner.get();
  std::span<T> span() const { return {data, size}; }
};
template <class T>
using shared = std::shared_ptr<array<T>>;
template <class T>
shared<T> make_array(std::size_t n) {
  return std::make_shared<array<T>>(n);
}

}  // namespace bench
