// Several numbers side by side in vector registers: a carrier, so that one source serves scalars and SIMD.
//
// register_pack.hpp is one register, wide_pack.hpp several of them, pack_carrier.hpp how formats are rounded on them, and
// pack_math.hpp <cmath>.
#pragma once

#include <bit>
#include <type_traits>

#include "bitshade/arithmetic/pack_carrier.hpp"
#include "bitshade/arithmetic/real.hpp"

namespace bitshade {

/// Neighbouring scalars of an array as one number over a pack, and back; nothing is rounded.
///
/// Shapes   reads or writes P::lanes scalars from p on.
template <class P, class F, rules R>
[[gnu::always_inline]] inline real<F, R, P> load_pack(const real<F, R, typename P::scalar>* p) {
  using T = typename P::scalar;
  static_assert(std::is_trivially_copyable_v<real<F, R, P>> && sizeof(real<F, R, T>) == sizeof(T));
  // Register by register: g++ copies several at once through memory, in pieces that a load then waits for.
  return std::bit_cast<real<F, R, P>>(P::load(static_cast<const T*>(static_cast<const void*>(p))));
}
template <class P, class F, rules R>
[[gnu::always_inline]] inline void store_pack(const real<F, R, P>& x, real<F, R, typename P::scalar>* p) {
  using T = typename P::scalar;
  x.carrier().store(static_cast<T*>(static_cast<void*>(p)));
}

}  // namespace bitshade
