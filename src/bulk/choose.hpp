// Which loop a request gets, for one instruction set.
#pragma once

#include "bulk/loops.hpp"

namespace bitshade::bulk_kernels {

template <rounding D>
struct direction_constant {
  static constexpr rounding value = D;
};

static constexpr setting setting_of(rounding d) {
  return d == rounding::nearest_even ? setting::nearest : setting::toward_zero;
}

/// Calls f with the direction as a constant.
template <bool HasRandom, class F>
chosen with_direction(rounding d, F f) {
  switch (d) {
    case rounding::nearest_even: return f(direction_constant<rounding::nearest_even>{});
    case rounding::nearest_away: return f(direction_constant<rounding::nearest_away>{});
    case rounding::toward_zero: return f(direction_constant<rounding::toward_zero>{});
    case rounding::up: return f(direction_constant<rounding::up>{});
    case rounding::down: return f(direction_constant<rounding::down>{});
    case rounding::to_odd: return f(direction_constant<rounding::to_odd>{});
    case rounding::stochastic:
      if constexpr (HasRandom) return f(direction_constant<rounding::stochastic>{});
  }
  return {};
}

/// Calls f with a value of the code type.
template <bool Wide, class F>
chosen with_code(char letter, F f) {
  switch (letter) {
    case 'b': return f(std::uint8_t{});
    case 'h': return f(std::uint16_t{});
    case 'w': return f(std::uint32_t{});
    case 'q':
      if constexpr (Wide) return f(std::uint64_t{});
  }
  return {};
}

template <class V, rounding D, class Io, class Step>
chosen value_loop() {
  return {round_values<V, D, Io, Step>, Step::wants};
}

template <class V, rounding D, ends Ends, class Io>
chosen choose_narrow(const plan& p) {
  if constexpr (D == rounding::stochastic) {
    if (p.random_bits < V::fraction_bits) return value_loop<V, D, Io, narrow_value<V, D, Ends, true>>();
  }
  return value_loop<V, D, Io, narrow_value<V, D, Ends>>();
}

template <class V, reach Reach, class Io>
chosen choose_round_binary(const plan& p) {
  const lane_numbers& n = sizeof(typename V::word) == 4 ? p.single : p.wide;
  const bool directed = p.direction == rounding::toward_zero || p.direction == rounding::to_odd ||
                        p.direction == rounding::up || p.direction == rounding::down;
  const bool ieee = p.special == specials::ieee, spare = p.fraction_bits + 2 <= V::fraction_bits;
  bool fast = p.keeps && (spare || Reach == reach::equal);
  fast = fast && (Reach == reach::narrow ? directed || p.one_overflow : ieee && n.natural_overflow);
  return with_direction<V::has_random>(p.direction, [&](auto d) -> chosen {
    constexpr rounding D = decltype(d)::value;
    if (!fast) return {round_binary<V, Reach, D, Io>, setting_of(D)};
    if constexpr (Reach != reach::narrow) {
      return value_loop<V, D, Io, shared_exponent_value<V, D, Reach == reach::wider>>();
    } else if (ieee && n.natural_overflow) {
      return choose_narrow<V, D, ends::natural, Io>(p);
    } else if (!ieee && n.natural_overflow) {
      return choose_narrow<V, D, ends::nan, Io>(p);
    } else {
      return choose_narrow<V, D, ends::any, Io>(p);
    }
  });
}

template <class V, reach Reach, class In>
chosen choose_encode_binary(const plan& p, char code) {
  return with_code<sizeof(typename V::word) == 8>(code, [&](auto c) {
    return with_direction<V::has_random>(p.direction, [](auto d) -> chosen {
      constexpr rounding D = decltype(d)::value;
      return {encode_binary<V, Reach, D, In, decltype(c)>, setting_of(D)};
    });
  });
}

/// binary16 as the instructions have it: NaNs kept, nothing flushed, overflow as the direction says. Needs no plan,
/// so that short spans cost little; to nearest even the processor's settings do not matter either.
template <class V>
chosen choose_half(const encoding& e, const rules& k, request r) {
  if (e.kind != family::binary || e.exponent_bits != 5 || e.fraction_bits != 10 || !e.has_sign ||
      e.special != specials::ieee) {
    return {};
  }
  if (r.what == operation::decode) {
    const bool flushes = k.subnormal == subnormals::flush_input || k.subnormal == subnormals::flush_both;
    return flushes || r.in != 'h' || r.out != 'f' ? chosen{} : chosen{decode_half<V>, setting::any};
  }
  const bool to_codes = r.what == operation::encode;
  if (r.in != 'f' || r.out != (to_codes ? 'h' : 'f')) return {};
  if (k.nan != nan_payload::keep || k.subnormal != subnormals::preserve || k.overflow == overflow::saturate) return {};
  if (k.direction == rounding::nearest_even) return {to_codes ? encode_half<V, 0> : round_half<V, 0>, setting::any};
  if (k.overflow != overflow::ieee) return {};
  switch (k.direction) {  // the instruction's immediate operand: 0 to 3
    case rounding::down: return {to_codes ? encode_half<V, 1> : round_half<V, 1>, setting::nearest};
    case rounding::up: return {to_codes ? encode_half<V, 2> : round_half<V, 2>, setting::nearest};
    case rounding::toward_zero: return {to_codes ? encode_half<V, 3> : round_half<V, 3>, setting::nearest};
    default: return {};
  }
}

/// binary32 lanes: formats that binary32 holds, norms and fixed point below 2^22, float in and out.
template <class V>
chosen choose_single(const plan& p, request r) {
  if (r.in == 'd' || r.out == 'd' || r.in == 'q' || r.out == 'q') return {};
  const bool decoding = r.what == operation::decode;
  if (p.kind != family::binary) {
    if constexpr (V::has_fma) {
      if (p.width > 22) return {};
      if (decoding) {
        return with_code<false>(r.in, [](auto c) -> chosen { return {decode_norm<V, decltype(c), float>, setting::nearest}; });
      }
      if (r.what == operation::round) {
        if (p.direction == rounding::stochastic) {
          if (p.random_bits > 23) return {p.has_sign ? round_norm_drawn<V, true> : round_norm_drawn<V, false>, setting::nearest};
          return {p.has_sign ? draw_norm<V, true> : draw_norm<V, false>, setting::toward_zero, norm_quotients<V>};
        }
        return with_direction<false>(p.direction, [&](auto d) -> chosen {
          constexpr rounding D = decltype(d)::value;
          return {p.has_sign ? round_norm_in<V, D, true> : round_norm_in<V, D, false>, setting::nearest};
        });
      }
      if (p.direction != rounding::nearest_even) return {};
      return with_code<false>(r.out, [](auto c) -> chosen {
        return {encode_norm<V, rounding::nearest_even, float, decltype(c)>, setting::nearest};
      });
    }
    return {};
  }
  if (!p.has_sign && p.width == 32) return {};  // magnitudes are compared as signed integers
  const auto with = [&]<reach Reach>() -> chosen {
    if (r.what == operation::round) return choose_round_binary<V, Reach, float>(p);
    if (r.what == operation::encode) return choose_encode_binary<V, Reach, float>(p, r.out);
    if constexpr (Reach != reach::wider) {
      return with_code<false>(r.in, [](auto c) -> chosen { return {decode_binary<V, Reach, decltype(c), float>, setting::nearest}; });
    }
    return {};
  };
  if (p.exponent_bits < 8 && p.fraction_bits <= (decoding ? 23 : 22)) return with.template operator()<reach::narrow>();
  // A format without infinities counts on where binary32 has its own.
  const bool beyond = p.special == specials::single_nan && decoding;
  if (p.exponent_bits == 8 && p.fraction_bits <= 23 && !beyond) return with.template operator()<reach::equal>();
  if (p.exponent_bits > 8 && p.fraction_bits <= 22) return with.template operator()<reach::wider>();
  return {};
}

/// binary64 lanes: everything that fits them, from and to float as well.
template <class V>
chosen choose_double(const plan& p, request r) {
  const bool decoding = r.what == operation::decode;
  if (p.kind != family::binary) {
    if (p.width > 50) return {};
    if (decoding) {
      if (r.out == 'd') {
        return with_code<true>(r.in, [](auto c) -> chosen { return {decode_norm<V, decltype(c), double>, setting::nearest}; });
      }
      return with_code<true>(r.in, [](auto c) -> chosen { return {decode_norm<V, decltype(c), float>, setting::nearest}; });
    }
    if (r.what == operation::round) {
      if (p.direction != rounding::nearest_even) return {};
      return r.in == 'd' ? chosen{round_norm<V, double>, setting::nearest} : chosen{round_norm<V, float>, setting::nearest};
    }
    // The discarded part must be exact for the random bits to meet it: 24 + 29 bits are.
    if (p.direction == rounding::stochastic && (r.in == 'd' || p.width > 29)) return {};
    return with_code<true>(r.out, [&](auto c) {
      return with_direction<true>(p.direction, [&](auto d) -> chosen {
        constexpr rounding D = decltype(d)::value;
        if (r.in == 'd') return {encode_norm<V, D, double, decltype(c)>, setting_of(D)};
        return {encode_norm<V, D, float, decltype(c)>, setting_of(D)};
      });
    });
  }
  const auto with = [&]<reach Reach>() -> chosen {
    switch (r.what) {
      case operation::round:
        // What binary32 cannot hold is rounded to nearest at the store; where the store follows the kernel's
        // direction, such formats are encoded and decoded instead.
        if (!V::stores_to_nearest && r.out == 'f' && p.direction != rounding::nearest_even &&
            (p.exponent_bits > 8 || p.fraction_bits > 23)) {
          return {};
        }
        return r.in == 'd' ? choose_round_binary<V, Reach, double>(p) : choose_round_binary<V, Reach, float>(p);
      case operation::encode:
        return r.in == 'd' ? choose_encode_binary<V, Reach, double>(p, r.out)
                           : choose_encode_binary<V, Reach, float>(p, r.out);
      case operation::decode:
        return with_code<true>(r.in, [&](auto c) -> chosen {
          if (r.out == 'd') return {decode_binary<V, Reach, decltype(c), double>, setting::nearest};
          return {decode_binary<V, Reach, decltype(c), float>, setting::nearest};
        });
    }
    return {};
  };
  if (!p.has_sign && p.width == 64) return {};
  if (p.exponent_bits < 11 && p.fraction_bits <= (decoding ? 52 : 51)) return with.template operator()<reach::narrow>();
  const bool beyond = p.special == specials::single_nan && decoding;
  if (p.exponent_bits == 11 && !beyond) return with.template operator()<reach::equal>();
  return {};
}

}  // namespace bitshade::bulk_kernels
