// What a test's own binary64 may add to a comparison.
#pragma once

namespace bitshade::test {

/// n roundings of numbers of magnitude at most 2, each to nearest: within half of 2^-52.
constexpr double roundings(int n) { return n * 0x1p-53; }

/// A sum of `taps` products whose weights add up to 1, of numbers in [0,1]: each number passes its
/// product and at most taps - 1 additions, each half an ulp of a number that is at most 1.
constexpr double weighted_sum(int taps) { return roundings(taps); }

}  // namespace bitshade::test
