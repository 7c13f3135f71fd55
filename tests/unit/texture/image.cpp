#include "support/catch.hpp"

#include "bitshade/texture/image.hpp"

TEST_CASE("an image's texels are row-major with interleaved channels") {
  bitshade::image<int> picture(3, 2, 2);
  picture.at(2, 1, 1) = 7;
  CHECK(picture.texels.back() == 7);
  CHECK(picture.row(1).back() == 7);
}
