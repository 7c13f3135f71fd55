// GLM in emulated formats: what works does what it does in float; what does not is listed in interop/glm.hpp.
#include "bitshade/interop/glm.hpp"

#include <glm/gtc/packing.hpp>

#include "bitshade/interop/rational.hpp"
#include "support/catch.hpp"

using namespace bitshade;

namespace {

using single = real<binary32>;
using vector = glm::vec<3, single>;

vector of(const glm::vec3& v) { return {single(v.x), single(v.y), single(v.z)}; }
bool same(const vector& a, const glm::vec3& b) {
  return static_cast<float>(a.x) == b.x && static_cast<float>(a.y) == b.y && static_cast<float>(a.z) == b.z;
}

// packHalf takes float: real converts there explicitly alone, so that nothing is rounded behind the caller's back.
template <class T>
concept packs = requires(const T& x) { glm::packHalf1x16(x); };
static_assert(packs<float> && !packs<single>);
// GLM 0.9.9.8 keeps a vector's members in unions, which hold no type with a destructor: rationals stay outside.
static_assert(!std::is_destructible_v<glm::vec<2, exact_rational>>);

}  // namespace

TEST_CASE("GLM's vectors of real<binary32> are its vectors of float") {
  const glm::vec3 a(1.5f, -2.25f, 0.1f), b(0.3f, 4.0f, -7.5f);
  const vector x = of(a), y = of(b);
  CHECK(same(x + y, a + b));
  CHECK(same(x * y, a * b));
  CHECK(same(x / y, a / b));
  CHECK(same(glm::cross(x, y), glm::cross(a, b)));
  CHECK(static_cast<float>(glm::dot(x, y)) == glm::dot(a, b));
  CHECK(static_cast<float>(glm::length(x)) == glm::length(a));
  CHECK(same(glm::normalize(x), glm::normalize(a)));
  CHECK(same(glm::mix(x, y, single(0.25f)), glm::mix(a, b, 0.25f)));
  CHECK(same(glm::clamp(x, single(-1), single(1)), glm::clamp(a, -1.0f, 1.0f)));
  CHECK(same(glm::abs(x), glm::abs(a)));
  CHECK(same(glm::floor(x), glm::floor(a)));
  CHECK(same(glm::ceil(x), glm::ceil(a)));
  CHECK(same(glm::fract(x), glm::fract(a)));
  CHECK(same(glm::min(x, y), glm::min(a, b)));
  CHECK(same(glm::sqrt(glm::abs(x)), glm::sqrt(glm::abs(a))));
  CHECK(x != y);
}

TEST_CASE("GLM's functions and matrices take half") {
  using half = real<binary16>;
  using vec = glm::vec<2, half>;
  const vec v(half(0.5), half(2));
  CHECK(glm::exp(v).x == exp(half(0.5)));
  CHECK(glm::log(v).y == log(half(2)));
  CHECK(glm::sin(v).x == sin(half(0.5)));
  CHECK(glm::pow(v, v).y == half(4));
  const glm::mat<2, 2, half> m(half(2), half(1), half(1), half(3));
  CHECK(glm::determinant(m) == half(5));
  CHECK((m * v).x == half(3));
  CHECK((glm::transpose(m) * v).y == half(6.5));
}
