// What the compiler must not do behind our back; docs/contract.md says why.
#pragma once

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "bitshade: fast-math is on (-ffast-math, -Ofast or -ffinite-math-only), which rewrites the roundings that this library defines; compile this file without it."
#endif

// g++ shows no macro for contraction, so the CMake target says aloud that it is off.
#if (defined(__FMA__) || defined(__ARM_FEATURE_FMA)) && !defined(BITSHADE_CONTRACTION_OFF)
#error "bitshade: this file may fuse a*b + c into one rounding; compile it with -ffp-contract=off -DBITSHADE_CONTRACTION_OFF=1, or link the CMake target bitshade::bitshade, which does."
#endif
