// Arrays that benchmarks read and write.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <span>

namespace bench {

/// Aligned to pages, so that every contestant meets the same cache lines, and no load has the low twelve bits of the
/// address of a store just before it, for which it would wait.
template <class T>
struct array {
  static constexpr std::size_t page = 4096;
  explicit array(std::size_t n)
      : size(n), owner(static_cast<T*>(std::aligned_alloc(page, (n * sizeof(T) + page - 1) / page * page)), &std::free) {}
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
