// Several numbers side by side in vector registers: a carrier, so that one source serves scalars and SIMD.
//
// register_pack.hpp is one register, wide_pack.hpp several of them, pack_carrier.hpp how formats are rounded on them, and
// pack_math.hpp <cmath>.
#pragma once

#include <cstring>
#include <type_traits>

#include "bitshade/arithmetic/pack_carrier.hpp"
#include "bitshade/arithmetic/real.hpp"

namespace bitshade {

/// Neighbouring scalars of an array as one number over a pack, and back; nothing is rounded.
///
/// Shapes   reads or writes P::lanes scalars from p on.
template <class P, class F, rules R>
real<F, R, P> load_pack(const real<F, R, typename P::scalar>* p) {
  real<F, R, P> r;
  static_assert(std::is_trivially_copyable_v<real<F, R, P>> && sizeof r == P::lanes * sizeof *p);
  std::memcpy(static_cast<void*>(&r), p, sizeof r);
  return r;
}
template <class P, class F, rules R>
void store_pack(const real<F, R, P>& x, real<F, R, typename P::scalar>* p) {
  std::memcpy(static_cast<void*>(p), &x, sizeof x);
}

}  // namespace bitshade
