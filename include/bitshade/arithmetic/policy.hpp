// Which number type each stage of the pipeline computes in, and which format its results are stored in.
#pragma once

#include <concepts>
#include <type_traits>

#include "bitshade/arithmetic/exact.hpp"
#include "bitshade/formats/encoding.hpp"

namespace bitshade {

/// Storage that changes nothing: what is stored is what was computed.
struct unrounded {};

template <class T> inline constexpr bool is_format = false;
template <encoding E> inline constexpr bool is_format<format<E>> = true;

/// A storage: `unrounded`, format<E>, or a stranger's tag that has a constexpr encoding named value.
template <class S>
concept storage = std::same_as<S, unrounded> || requires {
  { S::value } -> std::convertible_to<encoding>;
};

/// The arithmetic that a storage suggests: float up to 24 bits of precision, then double; an exact type itself.
template <class Storage>
struct default_arithmetic {
  using type = float;
};
template <class Storage>
  requires requires { { Storage::value } -> std::convertible_to<encoding>; }
struct default_arithmetic<Storage> {
  static constexpr encoding e = Storage::value;
  static constexpr bool wide = e.kind == family::binary ? (e.fraction_bits > 23 || e.exponent_bits > 8) : e.width > 32;
  using type = std::conditional_t<wide, double, float>;
};
template <class Q>
struct default_arithmetic<exact<Q>> {
  using type = exact<Q>;
};

/// One word for a whole pipeline; derive and say `using filter = real<binary16>;` to change one stage.
///
///   policy<unorm16>               stored in unorm16, computed in float
///   policy<unrounded, exact<Q>>   or policy<exact<Q>>: nothing is ever rounded
template <class Storage, class Arithmetic = typename default_arithmetic<Storage>::type>
struct policy {
  // What is kept between stages: a format tag or `unrounded`.
  using store = std::conditional_t<is_exact<Storage>, unrounded, Storage>;  ///< the moments' texels
  using blur_store = store;  ///< between blur passes
  using mip_store = store;   ///< every mip level
  using sat_store = store;   ///< summed-area tables
  // What is computed in.
  using metric = Arithmetic;      ///< depth metric
  using warp = Arithmetic;        ///< layer and exponential warps of occluders
  using square = Arithmetic;      ///< the second moment
  using resolve = Arithmetic;     ///< MSAA
  using blur = Arithmetic;        ///< weights and accumulation
  using mip = Arithmetic;         ///< averages of a level
  using sat = Arithmetic;         ///< sums and the four-corner difference
  using load = Arithmetic;        ///< what a texel decodes to
  using filter = Arithmetic;      ///< coordinates, weights and lerps
  using lod = Arithmetic;         ///< level of detail and its fraction
  using probe = Arithmetic;       ///< anisotropic probes
  using receive = Arithmetic;     ///< the receiver's warp
  using variance = Arithmetic;    ///< mean and variance
  using shade = Arithmetic;       ///< floor and Chebyshev's bound
  using transition = Arithmetic;  ///< bleeding reduction and the blend of layers
  using lloyd = Arithmetic;       ///< sums and division
};

/// What a pipeline asks of its policy; a stranger's needs no base class.
template <class P>
concept numeric_policy = storage<typename P::store> && storage<typename P::blur_store> &&
    storage<typename P::mip_store> && storage<typename P::sat_store> && requires {
  typename P::metric; typename P::warp; typename P::square; typename P::resolve; typename P::blur;
  typename P::mip; typename P::sat; typename P::load; typename P::filter; typename P::lod;
  typename P::probe; typename P::receive; typename P::variance; typename P::shade;
  typename P::transition; typename P::lloyd;
};

}  // namespace bitshade
