// Pieces of GLSL that several techniques share.
#pragma once

#include <string>
#include <vector>

#include "bitshade/formats/encoding.hpp"
#include "bitshade/study/configuration.hpp"

namespace bitshade::shader_parts {

/// The shortest decimal that reads back as the same binary32, with a point or an exponent.
std::string literal(double value);
/// "const float NAME = value;  // words"
std::string constant(const std::string& name, double value, const std::string& words);
/// "const float NAME[n] = float[n](…);", wrapped at 80 columns.
std::string array(const std::string& name, const std::vector<double>& values);
/// Words as lines of "// ".
std::string comment(const std::string& words);

/// The code of the value 1 of a norm, as a number.
double largest_code(const encoding& e);

std::string chebyshev();
/// finished(p): light after the configuration's reduction of bleeding.
std::string finish(const configuration& how);
/// The four-moment technique.
std::string of_moments(const configuration& how);

}  // namespace bitshade::shader_parts
