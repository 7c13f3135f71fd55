#include "io/numbers.hpp"

#include "io/error.hpp"
#include "support/catch.hpp"

using bitshade::parse_numbers;
using bitshade::usage_error;

TEST_CASE("numbers with commas between are read whatever the locale") {
  CHECK(parse_numbers("0.5,-3,1e-5", "--x", 3, 3) == std::vector<double>{0.5, -3, 1e-5});
  CHECK(parse_numbers("7", "--x", 1, 2) == std::vector<double>{7});
}

TEST_CASE("what is no list of finite numbers is refused with the option's name") {
  for (const char* text :
       {"", ",", "1,", ",1", "1,,2", "a", "1 2", "nan", "inf", "1e999", "0x10", "1;2"}) {
    INFO(text);
    CHECK_THROWS_AS(parse_numbers(text, "--x", 1, 3), usage_error);
  }
  CHECK_THROWS_WITH(parse_numbers("1,2", "--light", 3, 3),
                    "--light takes 3 numbers with commas between, but '1,2' has 2");
}

TEST_CASE("a seed is a whole number of 64 bits, and nothing wraps around") {
  CHECK(bitshade::parse_seed("18446744073709551615", "--seed") == ~std::uint64_t{0});
  CHECK(bitshade::parse_seed("0", "--seed") == 0);
  for (const char* text : {"", "-1", "18446744073709551616", "1.5", "0x10", "1 ", "+1", "abc"}) {
    INFO(text);
    CHECK_THROWS_AS(bitshade::parse_seed(text, "--seed"), usage_error);
  }
}
