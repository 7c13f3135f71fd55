#include "precision/store.hpp"

namespace bitshade::bit_search {

namespace {

using boost::multiprecision::cpp_int;

/// x >= 0 to the nearest integer, ties to even.
cpp_int nearest_integer(const rational& x) {
  const cpp_int n = numerator(x), d = denominator(x);
  cpp_int q = n / d;
  const cpp_int twice = (n - q * d) * 2;
  if (twice > d || (twice == d && (q & 1) != 0)) ++q;
  return q;
}

}  // namespace

rational stored(const moment_store& store, const rational& x) {
  if (x <= 0) return 0;
  if (!store.floating) return rational(nearest_integer(x * store.steps), store.steps);
  rational scale(store.steps);  // brings x into [steps / 2, steps)
  while (x * scale < rational(store.steps, 2)) scale *= 2;
  while (x * scale >= store.steps) scale /= 2;
  return nearest_integer(x * scale) / scale;
}

double stored_units(const moment_store& store, double x) {
  if (!store.floating) return std::nearbyint(x * static_cast<double>(store.steps));
  if (!(x > 0)) return 0;
  int exponent = 0;
  const double fraction = std::frexp(x, &exponent);
  const auto steps = static_cast<double>(store.steps);
  return std::ldexp(std::nearbyint(fraction * steps) / steps, exponent);
}

}  // namespace bitshade::bit_search
