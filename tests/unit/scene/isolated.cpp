#include "scene/isolated.hpp"

#include <signal.h>

#include <cstdlib>
#include <stdexcept>

#include "support/catch.hpp"

using bitshade::run_isolated;

TEST_CASE("isolated work returns its bytes, however many") {
  const auto result = run_isolated(
      [] {
        std::vector<std::uint8_t> bytes(1000000);
        for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i * 7);
        return bytes;
      },
      10);
  CHECK_FALSE(result.crashed);
  CHECK(result.error.empty());
  REQUIRE(result.bytes.size() == 1000000);
  CHECK(result.bytes[999999] == static_cast<std::uint8_t>(999999 * 7));
}

TEST_CASE("isolated work's exceptions come back as text") {
  const auto result =
      run_isolated([]() -> std::vector<std::uint8_t> { throw std::runtime_error("no luck"); }, 10);
  CHECK_FALSE(result.crashed);
  CHECK(result.error == "no luck");
  CHECK(result.bytes.empty());
}

TEST_CASE("isolated work that crashes, exits or never ends is only a result") {
  using bytes = std::vector<std::uint8_t>;
  const std::function<bytes()> bad[] = {[] {
                                          ::raise(SIGSEGV);
                                          return bytes{1};
                                        },
                                        [] {
                                          std::_Exit(0);
                                          return bytes{1};
                                        },
                                        [] {
                                          for (volatile bool forever = true; forever;) {
                                          }
                                          return bytes{1};
                                        }};
  for (const auto& work : bad) {
    const auto result = run_isolated(work, 1);
    CHECK(result.crashed);
    CHECK(result.bytes.empty());
  }
}
