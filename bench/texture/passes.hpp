// Passes over images against a copy of memory: limits of bandwidth, on one core and on two.
#pragma once

#include <functional>

#include "bitshade/arithmetic/workers.hpp"
#include "texture/images.hpp"

namespace bench {

/// A pass at 60 % of a copy's speed takes 1 / 0.6 of its time for the same bytes.
constexpr double native_limit = 1 / 0.6, stored_limit = 1 / 0.4;
constexpr int size = 2048;

/// One thread, or two that wait between calls: what all rows of two cores share, copies as well.
bulk::execution on(int threads);

/// Halves of [0, n) on one or two of these threads.
void on_threads(int threads, int n, const std::function<void(int, int)>& work);

/// What limits passes: copies of an image of 2048^2, of 32-bit and of 16-bit texels, on one core
/// and on two, and of 128 MiB. Every copy and every pass twice: among the other rows' leavings,
/// where the third level may hold an image or not (0.06 or 0.2 ns a value for a copy), and with
/// caches that were filled with something else before.
void add_copies(table& table, const std::string& group, int channels);

inline const char* copy_of(std::size_t bits) { return bits == 32 ? "copy" : "copy of 16 bits"; }

/// `work(threads)` on one core against the copy of elements of so many bits, and its gain by a
/// second core against the copy's.
void add_pass(table& table, const std::string& group, const std::string& name, double elements,
              const std::function<void(int)>& work, const std::function<std::string()>& check,
              std::size_t bits, double limit);

}  // namespace bench
