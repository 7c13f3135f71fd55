// Boost.Multiprecision's rational as the number behind `exact`.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>

#include "bitshade/arithmetic/exact.hpp"

namespace bitshade {

/// Rationals without expression templates: `auto` and `?:` then mean what they say.
using rational = boost::multiprecision::number<boost::multiprecision::cpp_rational_backend, boost::multiprecision::et_off>;
using exact_rational = exact<rational>;

}  // namespace bitshade
