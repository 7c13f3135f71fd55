// Pairs of loops that must compile to the same instructions: `raw_` written in float, the others in bitshade's types.
// same_code.cmake compares them.
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "bitshade/arithmetic/native.hpp"
#include "bitshade/arithmetic/policy.hpp"
#include "bitshade/arithmetic/real.hpp"
#include "bitshade/shadow/chebyshev.hpp"

using namespace bitshade;
using plain = policy<unrounded>;
using single = real<binary32>;

// Nothing is stored beside the number, and nothing at all for a policy.
static_assert(std::is_same_v<native<float>, float> && std::is_same_v<plain::filter, float>);
static_assert(std::is_empty_v<plain> && std::is_empty_v<policy<binary16>> && std::is_empty_v<unrounded>);
static_assert(std::is_empty_v<binary16> && std::is_empty_v<unorm16>);
static_assert(sizeof(single) == sizeof(float) && sizeof(real<binary64>) == sizeof(double));
static_assert(sizeof(real<binary16>) == sizeof(float) && std::is_trivially_copyable_v<real<binary16>>);
static_assert(std::is_trivially_default_constructible_v<single> && std::is_standard_layout_v<single>);

namespace {

template <class T>
void axpy(std::size_t n, T a, const T* x, T* y) {
  for (std::size_t i = 0; i < n; ++i) y[i] = a * x[i] + y[i];
}
template <class T>
void length(std::size_t n, const T* x, const T* y, T* out) {
  using std::sqrt;
  for (std::size_t i = 0; i < n; ++i) out[i] = sqrt(x[i] * x[i] + y[i] * y[i]) / (x[i] - y[i]);
}
template <class T>
void visibility(std::size_t n, const T* m1, const T* m2, const T* t, T floor, T* out) {
  for (std::size_t i = 0; i < n; ++i) out[i] = chebyshev(mean_and_variance(m1[i], m2[i]), t[i], floor);
}

/// The same without bitshade; inlined as the templates are.
void by_hand(std::size_t n, const float* m1, const float* m2, const float* t, float floor, float* out) {
  for (std::size_t i = 0; i < n; ++i) {
    const float mu = m1[i], variance = m2[i] - mu * mu, d = t[i] - mu;
    const float v = variance < floor ? floor : variance;
    const float sum = v + d * d, divisor = sum == 0 ? 1 : sum;
    const float p = sum == 0 ? 0 : v / divisor;
    out[i] = t[i] <= mu ? 1 : p;
  }
}

}  // namespace

extern "C" {

void raw_axpy(std::size_t n, float a, const float* x, float* y) {
  for (std::size_t i = 0; i < n; ++i) y[i] = a * x[i] + y[i];
}
void native_axpy(std::size_t n, float a, const float* x, float* y) { axpy<native<float>>(n, a, x, y); }
void policy_axpy(std::size_t n, float a, const float* x, float* y) { axpy<plain::filter>(n, a, x, y); }
void real_axpy(std::size_t n, single a, const single* x, single* y) { axpy(n, a, x, y); }

void raw_length(std::size_t n, const float* x, const float* y, float* out) {
  for (std::size_t i = 0; i < n; ++i) out[i] = std::sqrt(x[i] * x[i] + y[i] * y[i]) / (x[i] - y[i]);
}
void native_length(std::size_t n, const float* x, const float* y, float* out) { length<native<float>>(n, x, y, out); }
void policy_length(std::size_t n, const float* x, const float* y, float* out) { length<plain::warp>(n, x, y, out); }
void real_length(std::size_t n, const single* x, const single* y, single* out) { length(n, x, y, out); }

void raw_visibility(std::size_t n, const float* m1, const float* m2, const float* t, float floor, float* out) {
  by_hand(n, m1, m2, t, floor, out);
}
void native_visibility(std::size_t n, const float* m1, const float* m2, const float* t, float floor, float* out) {
  visibility<native<float>>(n, m1, m2, t, floor, out);
}
void policy_visibility(std::size_t n, const float* m1, const float* m2, const float* t, float floor, float* out) {
  visibility<plain::shade>(n, m1, m2, t, floor, out);
}

}  // extern "C"
