#include "io/digest.hpp"

#include <string_view>

#include "support/catch.hpp"

using namespace bitshade;

namespace {
std::string digest(std::string_view text, std::size_t piece) {
  sha256 d;
  for (std::size_t i = 0; i < text.size(); i += piece)
    d.update(std::as_bytes(std::span(text.substr(i, piece))));
  return d.finish();
}
}  // namespace

TEST_CASE("digests equal those of FIPS 180-4, however the bytes arrive", "[io]") {
  for (const std::size_t piece : {1u, 3u, 63u, 64u, 65u, 1000u}) {
    CAPTURE(piece);
    CHECK(digest("", piece) == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    CHECK(digest("abc", piece) ==
          "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    CHECK(digest("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq", piece) ==
          "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    CHECK(digest(std::string(1000000, 'a'), piece) ==
          "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  }
}
