// The command as a script sees it: lines in, lines out, exit status.
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "support/catch.hpp"

namespace {

struct outcome {
  std::string out;
  int status = 0;
};

/// Runs a command line and takes what it prints.
outcome run(const std::string& line) {
  outcome result;
  std::FILE* pipe = ::popen(line.c_str(), "r");
  REQUIRE(pipe != nullptr);
  std::array<char, 4096> buffer{};
  for (std::size_t n = 0; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    result.out.append(buffer.data(), n);
  result.status = ::pclose(pipe) >> 8;
  return result;
}

/// Runs `bitshade round` with a text as standard input; standard error joins standard output. `variables` go before it.
outcome round_text(const std::string& input, const std::string& options, const std::string& variables = "") {
  std::string path = (std::filesystem::temp_directory_path() / "bitshade_round_XXXXXX").string();
  ::close(::mkstemp(path.data()));
  std::ofstream(path, std::ios::binary) << input;
  const outcome result = run(variables + ' ' + BITSHADE_COMMAND + " round " + options + " < " + path + " 2>&1");
  std::remove(path.c_str());
  return result;
}

}  // namespace

TEST_CASE("round answers each line with its value and bits") {
  const outcome half = round_text("0.1\n1/3\n0x1.8p+1\n-inf\nnan\n-0\n", "--format half");
  CHECK(half.status == 0);
  CHECK(half.out ==
        "0x1.998p-4 0x2e66\n0x1.554p-2 0x3555\n0x1.8p+1 0x4200\n-inf 0xfc00\nnan 0x7e00\n-0x0p+0 "
        "0x8000\n");
  // The nearest binary64 of 1/65535 is not 1/65535; the ratio is, and no direction may move it.
  for (const char* direction : {"up", "down", "to-odd", "toward-zero"})
    CHECK(round_text("1/65535", std::string("--format unorm16 --rounding ") + direction).out ==
          "0x1.000100010001p-16 0x0001\n");
}

TEST_CASE("round judges overflow on the value rounded without a limit") {
  const std::string input = "65519.99999999999999999999999999999\n65520\n-1e1000000000\n";
  CHECK(round_text(input, "--format half").out == "0x1.ffcp+15 0x7bff\ninf 0x7c00\n-inf 0xfc00\n");
  CHECK(round_text(input, "--format half --rounding down").out ==
        "0x1.ffcp+15 0x7bff\n0x1.ffcp+15 0x7bff\n-inf 0xfc00\n");
  CHECK(round_text(input, "--format half --rounding toward-zero --overflow infinity").out ==
        "0x1.ffcp+15 0x7bff\n0x1.ffcp+15 0x7bff\n-inf 0xfc00\n");
  CHECK(round_text("inf\n449\n-465\n", "--format fp8_e4m3").out ==
        "nan 0x7f\n0x1.cp+8 0x7e\n-nan 0xff\n");
  CHECK(round_text("inf\n-465\n", "--format fp8_e4m3 --overflow saturate").out ==
        "0x1.cp+8 0x7e\n-0x1.cp+8 0xfe\n");
}

TEST_CASE("round flushes what is subnormal after rounding, and only that") {
  const std::string input = "0x1.ff8p-15\n-0x1.ff8p-15\n0x1.ffbp-15\n0x1.ffcp-15\n";
  CHECK(round_text(input, "--format half --subnormal flush").out ==
        "0x0p+0 0x0000\n-0x0p+0 0x8000\n0x0p+0 0x0000\n0x1p-14 0x0400\n");
}

TEST_CASE("round reads r11g11b10 three numbers a line") {
  CHECK(round_text("1 -2 3e5\n", "--format r11g11b10").out == "0x1p+0 0x0p+0 inf 0xf80003c0\n");
  const outcome two = round_text("1 2 3\n1 2\n", "--format r11g11b10");
  CHECK(two.status == 1);
  CHECK(two.out.find("line 2") != std::string::npos);
}

TEST_CASE("stochastic rounding replays from its seed") {
  std::string input;
  for (int i = 0; i < 4000; ++i)
    input += "0x1.004p+0\n";  // 1/256 of a step up: about 16 of the 4000
  const outcome a = round_text(input, "--format fp8_e5m2 --rounding stochastic --seed 7");
  CHECK(a.out == round_text(input, "--format fp8_e5m2 --rounding stochastic --seed 7").out);
  CHECK(a.out != round_text(input, "--format fp8_e5m2 --rounding stochastic --seed 8").out);
}

TEST_CASE("round answers a line of a million digits") {
  const std::string third = "0." + std::string(1'000'000, '3') + '\n';
  CHECK(round_text(third + third, "--format half").out == "0x1.554p-2 0x3555\n0x1.554p-2 0x3555\n");
  CHECK(round_text("0x" + std::string(1'000'000, '5') + "p-4000000\n", "--format unorm16").out ==
        "0x1.5555555555555p-2 0x5555\n");
}

TEST_CASE("round names the line that it cannot read") {
  for (const char* bad :
       {"abc", "", "1/0", "0x", "1e", "1..2", "--1", "1 2", "inf/2", "0x1p", "nan(1)"}) {
    INFO("line: '" << bad << "'");
    const outcome r = round_text("1\n" + std::string(bad) + "\n2\n", "--format half");
    CHECK(r.status == 1);
    CHECK(r.out.find("line 2:") != std::string::npos);
    CHECK(r.out.find("0x1p+0 0x3c00\n") != std::string::npos);
  }
  const outcome json = round_text("1\nx\n", "--format half --json");
  CHECK(json.status == 1);
  CHECK(json.out.find("[\n {\"line\": 1, \"value\": \"0x1p+0\", \"bits\": \"0x3c00\"}\n]\n") != std::string::npos);
  CHECK(round_text("1\n", "--format e5m10x").out.find("did you mean 'e5m10'?") != std::string::npos);
  CHECK(round_text("1\n", "--format bfoat16").status == 2);
  CHECK(round_text("1\n", "--format bfoat16").out.find("bfloat16") != std::string::npos);
  CHECK(round_text("1\n", "--format e12m3").out.find("2 <= X <= 11") != std::string::npos);
  CHECK(round_text("1\n", "--format half --rounding upp").status == 2);
  CHECK(round_text("1\n", "--format HALF").out.find("'half'") != std::string::npos);
  for (const char* seed : {"-1", "18446744073709551616", "1.5"})
    CHECK(round_text("1\n", "--format half --rounding stochastic --seed=" + std::string(seed)).status == 2);
}

TEST_CASE("round ends when nobody reads on, and says why it could not write or read") {
  const std::string endless = "yes 0.1 | timeout 20 " BITSHADE_COMMAND " round --format half";
  CHECK(run("{ { " + endless + "; echo $? >&3; } | head -n 1 > /dev/null; } 3>&1").out == "0\n");
  const outcome full = run("{ " + endless + " > /dev/full; } 2>&1; exit $?");
  CHECK(full.status == 1);
  CHECK(full.out.find("standard output") != std::string::npos);
  const outcome folder = run(BITSHADE_COMMAND " round --format half < / 2>&1");
  CHECK(folder.status == 1);
  CHECK(folder.out.find("standard input cannot be read") != std::string::npos);
}

TEST_CASE("an option given twice is refused in a sentence; the list of formats fits 80 columns") {
  CHECK(round_text("1\n", "--format half --rounding up --rounding down").out ==
        "bitshade: --rounding may be given once, but stands there 2 times; see 'bitshade round --help'\n");
  const std::string list = run(BITSHADE_COMMAND " formats").out;
  std::size_t from = 0, longest = 0;
  for (std::size_t end = 0; (end = list.find('\n', from)) != std::string::npos; from = end + 1)
    longest = std::max(longest, end - from);
  CHECK(longest > 0);
  CHECK(longest <= 80);
}

#if defined(BITSHADE_HOSTILE_PRELOAD)
TEST_CASE("hard case 42: round answers the same in a hostile environment and another locale") {
  const std::string hostile = "LC_ALL=de_DE.UTF-8 LD_PRELOAD=" BITSHADE_HOSTILE_PRELOAD;
  // It reaches a program: 1 / 3 is rounded up there.
  const std::string third = "awk 'BEGIN { printf \"%.17g\", 1 / 3 }'";
  REQUIRE(run(hostile + ' ' + third).out != run(third).out);
  std::string input = "0.1\n-0.1\n1/3\n-1/65535\n65519.9999999\n0x1.8p-24\n-1e-7\n1e-320\n4.9e-324\n1e400\nnan\n-0\n";
  for (int i = 1; i < 50; ++i) input += std::to_string(i) + "/97\n-0x" + std::to_string(i) + ".8p-14\n";
  for (const char* format : {"half", "binary32", "binary64", "bfloat16", "fp8_e4m3", "e2m52", "unorm16", "snorm32", "fixed4.12"}) {
    for (const char* direction : {"nearest-even", "nearest-away", "toward-zero", "up", "down", "to-odd", "stochastic"}) {
      for (const char* rest : {"", " --subnormal flush --overflow saturate", " --json"}) {
        const std::string options = std::string("--format ") + format + " --rounding " + direction + rest;
        INFO(options);
        const outcome calm = round_text(input, options), troubled = round_text(input, options, hostile);
        CHECK(calm.status == 0);
        CHECK(troubled.status == 0);
        CHECK(troubled.out == calm.out);
      }
    }
  }
  CHECK(run(hostile + ' ' + BITSHADE_COMMAND + " formats --json").out == run(BITSHADE_COMMAND " formats --json").out);
}
#endif
