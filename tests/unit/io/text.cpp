#include "io/text.hpp"

#include <cstdlib>
#include <limits>

#include "support/catch.hpp"

using namespace bitshade;

TEST_CASE("lines are wrapped at blanks and counted in code points", "[io]") {
  CHECK(wrap("one two three", 7) == std::vector<std::string>{"one two", "three"});
  CHECK(wrap("incomprehensible", 4) == std::vector<std::string>{"incomprehensible"});
  CHECK(wrap("a\n\nb", 9) == std::vector<std::string>{"a", "", "b"});
  CHECK(columns("σ²≤1") == 4);
  CHECK(pad_left("σ", 3) == "  σ");
  CHECK(pad_right("σ", 3) == "σ  ");
}

TEST_CASE("numbers for people keep their digits and their width", "[io]") {
  CHECK(brief(0) == "0");
  CHECK(brief(0.9999) == "1.00");
  CHECK(brief(0.01234) == "0.0123");
  CHECK(brief(0.00999949) == "1.00e-2");
  CHECK(brief(1.5e-5, 2) == "1.5e-5");
  CHECK(brief(2.5e-10, 2) == "2.5e-10");
  CHECK(brief(-12.345) == "-12.3");
  CHECK(brief(123456.0) == "123456");
  CHECK(brief(1e9, 2) == "1.0e9");
  CHECK(brief(std::numeric_limits<double>::infinity()) == "inf");
}

TEST_CASE("shares never round to nothing", "[io]") {
  CHECK(percent(0) == "0");
  CHECK(percent(1e-9) == "<0.01");
  CHECK(percent(0.00371) == "0.37");
  CHECK(percent(0.1236) == "12.4");
  CHECK(percent(1) == "100.0");
}

TEST_CASE("numbers for files read back as themselves", "[io]") {
  for (const double x : {0.1, 1.0 / 3, 5e-324, 1.7976931348623157e308, -0.0})
    CHECK(std::strtod(shortest(x).c_str(), nullptr) == x);
}
