#include "io/format_names.hpp"

#include "support/catch.hpp"

using bitshade::explain_format_name;

TEST_CASE("a name that no format has is explained by what it comes nearest to") {
  const auto meant = [](const char* name) {
    const std::string sentence = explain_format_name(name);
    const auto from = sentence.find("did you mean '");
    return from == std::string::npos ? sentence : sentence.substr(from + 14, sentence.size() - from - 16);
  };
  CHECK(meant("e5m10x") == "e5m10");
  CHECK(meant("e5n7") == "e5m7");
  CHECK(meant("E5M7") == "e5m7");
  CHECK(meant("unrom12") == "unorm12");
  CHECK(meant("UNORM16") == "unorm16");
  CHECK(meant("fixed4,12") == "fixed4.12");
  CHECK(meant("bfoat16") == "bfloat16");
  CHECK(meant("HALF") == "half");
  CHECK(meant("hlaf") == "half");
  CHECK(meant("fp16") == "half");
  CHECK(meant("R16_UNORM") == "unorm16");
  CHECK(meant("e4m3fn") == "fp8_e4m3");
  CHECK(meant("r11g11b1") == "r11g11b10");
  CHECK(meant("e12m3") == "is out of range: eXmY needs 2 <= X <= 11 and 1 <= Y <= 52");
  CHECK(meant("unorm33") == "is out of range: unormN needs 1 <= N <= 32");
  CHECK(meant("fixed0.8") == "is out of range: fixedI.F needs I >= 1 and 2 <= I + F <= 64");
  for (const char* name : {"", "decimal", "posit16_1"})
    CHECK(explain_format_name(name).find("eXmY (X bits of exponent, Y of fraction)") != std::string::npos);
}
