#include "io/nearest.hpp"

#include <array>

#include "support/catch.hpp"

using namespace bitshade;

TEST_CASE("edit distance counts inserts, deletes, changes and swaps", "[io]") {
  CHECK(edit_distance("", "") == 0);
  CHECK(edit_distance("half", "half") == 0);
  CHECK(edit_distance("half", "hlaf") == 1);
  CHECK(edit_distance("unorm16", "unorm6") == 1);
  CHECK(edit_distance("garden", "graden") == 1);
  CHECK(edit_distance("", "abc") == 3);
  CHECK(edit_distance("kitten", "sitting") == 3);
}

TEST_CASE("the nearest name is offered, and only where one is near", "[io]") {
  constexpr std::array<std::string_view, 4> names{"unorm8", "unorm16", "half", "binary32"};
  CHECK(nearest("unorm61", names) == "unorm16");
  CHECK(nearest("binary23", names) == "binary32");
  CHECK(nearest("xyzzy", names).empty());
  CHECK(nearest("", names).empty());
  CHECK(suggest("haf", names) == "did you mean 'half'?");
  CHECK(suggest("quadruple", names) == "known are unorm8, unorm16, half and binary32");
}
