// What makes no sense, and what cannot be done: one sentence, the right status, nothing left.
#include <sys/mount.h>

#include "io/text.hpp"
#include "support/catch.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

using namespace bitshade;
using namespace bitshade::test;

namespace {

struct bad {
  int status;
  std::vector<std::string> arguments;
  std::string says;  ///< part of the sentence
};

void check(const bad& b, const temporary_folder& folder) {
  std::string line;
  for (const std::string& a : b.arguments) line += " " + a;
  INFO("bitshade" << line);
  run_options here;
  here.folder = folder.path();
  const outcome o = run_bitshade(b.arguments, here);
  INFO("standard error: " << o.err);
  CHECK(o.status == b.status);
  CHECK(o.signal == 0);
  CHECK(o.out.empty());
  CHECK(o.err.starts_with("bitshade: "));
  CHECK(std::count(o.err.begin(), o.err.end(), '\n') == 1);
  CHECK(o.err.find(b.says) != std::string::npos);
  CHECK(!std::filesystem::exists(folder / "bitshade-out"));
}

}  // namespace

TEST_CASE("arguments that make no sense end in status 2 and a sentence with the cure", "[app]") {
  const temporary_folder folder;
  const std::vector<bad> all{
      {2, {}, "'bitshade --help'"},
      {2, {"studdy"}, "did you mean 'study'?"},
      {2, {"frobnicate"}, "there is no command 'frobnicate'"},
      {2, {"--versoin"}, "did you mean '--version'?"},
      {2, {"study", "gardne"}, "garden"},
      {2, {"study", "garden", "--fromats", "half"}, "did you mean '--formats'?"},
      {2, {"study", "--size"}, "--size"},
      {2, {"study", "--size", "0"}, "--size"},
      {2, {"study", "--size", "-5"}, "--size"},
      {2, {"study", "--size", "abc"}, "'abc' is not a number"},
      {2, {"study", "--size", "1e3"}, "--size"},
      {2, {"study", "--size", "99999999999999999999"}, "--size"},
      {2, {"study", "--size", "65536"}, "GiB"},
      {2, {"study", "--view", "640"}, "--view"},
      {2, {"study", "--view", "0x40"}, "--view"},
      {2, {"study", "--formats", "hlaf"}, "did you mean 'half'?"},
      {2, {"study", "--formats", "exakt"}, "did you mean 'exact'?"},
      {2, {"study", "--formats", "half,half"}, "twice"},
      {2, {"study", "--formats", "half,"}, "empty"},
      {2, {"study", "--formats", "r11g11b10"}, "packs"},
      {2, {"study", "--formats", "unorm99"}, "unorm"},
      {2, {"study", "--techniques", "lvms"}, "did you mean 'lvsm'?"},
      {2, {"study", "--layers", "0"}, "--layers"},
      {2, {"study", "--layers", "2,x"}, "'x'"},
      {2, {"study", "--layers", "257"}, "256"},
      {2, {"study", "--splits", "lyod"}, "did you mean 'lloyd'?"},
      {2, {"study", "--splits", "0.9,0.2"}, "0.2"},
      {2, {"study", "--splits", "1.5"}, "1.5"},
      {2, {"study", "--splits", "nan"}, "nan"},
      {2, {"study", "--splits", "0.94", "--layers", "4"}, "--layers"},
      {2, {"study", "--overlap", "-1"}, "overlap"},
      {2, {"study", "--overlap", "nan"}, "overlap"},
      {2, {"study", "--min-variance", "-1e-5"}, "min-variance"},
      {2, {"study", "--blur", "4"}, "blur"},
      {2, {"study", "--blur", "999"}, "blur"},
      {2, {"study", "--filter", "cubic"}, "known are nearest"},
      {2, {"study", "--anisotropy", "17"}, "anisotropy"},
      {2, {"study", "--threads", "-1"}, "--threads"},
      {2, {"study", "--param", "leaves"}, "NAME=NUMBER"},
      {2, {"study", "--param", "nosuch=1"}, "nosuch"},
      {2, {"render", "garden", "--formats", "half,unorm16"}, "one configuration"},
      {2, {"plan", "garden", "slope"}, "slope"},
  };
  for (const bad& b : all) check(b, folder);
}

TEST_CASE("files that cannot be read end in one sentence and leave nothing", "[app]") {
  const temporary_folder folder;
  write(folder / "empty.exr", "");
  write(folder / "empty.obj", "");
  write(folder / "noise.exr", "this is no picture at all, but text");
  write(folder / "noise.png", "\x89PNG\r\n\x1a\nthen nothing that a PNG has");
  write(folder / "points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  write(folder / "short.pfm", "Pf\n8 8\n-1.0\n\x01\x02\x03");
  write(folder / "strange.xyz", "1 2 3");
  const auto pfm = [&](const std::string& name, float value) {
    std::string bytes = "Pf\n4 4\n-1.0\n";
    for (int i = 0; i < 16; ++i) {
      const float v = i == 5 ? value : 0.5f;
      bytes.append(reinterpret_cast<const char*>(&v), sizeof v);
    }
    write(folder / name, bytes);
  };
  pfm("nan.pfm", std::numeric_limits<float>::quiet_NaN());
  pfm("inf.pfm", std::numeric_limits<float>::infinity());
  pfm("high.pfm", 1.5f);
  const outcome depth =
      run_bitshade({"depth", "planes", "--size", "32", "--out", (folder / "whole.exr").string()});
  INFO(depth.err);
  REQUIRE(depth.status == 0);
  const std::string whole = contents(folder / "whole.exr");
  write(folder / "cut.exr", whole.substr(0, whole.size() / 2));

  for (const char* name : {"missing.exr", "missing.obj", "empty.exr", "empty.obj", "noise.exr",
                           "noise.png", "points.obj", "short.pfm", "strange.xyz", "nan.pfm",
                           "inf.pfm", "high.pfm", "cut.exr", "."}) {
    CAPTURE(name);
    run_options here;
    here.folder = folder.path();
    const outcome o = run_bitshade({"study", name}, here);
    INFO("standard error: " << o.err);
    CHECK((o.status == 1 || o.status == 2));
    CHECK(o.err.starts_with("bitshade: "));
    CHECK(std::count(o.err.begin(), o.err.end(), '\n') == 1);
    CHECK(o.err.find(name) != std::string::npos);
    CHECK(!std::filesystem::exists(folder / "bitshade-out"));
  }
}

TEST_CASE("an output folder that takes nothing ends in status 1 and a sentence", "[app]") {
  const temporary_folder folder;
  write(folder / "file", "in the way");
  const std::vector<std::string> study{"study",     "planes", "--size",       "32",
                                       "--view",    "32x20",  "--techniques", "vsm",
                                       "--formats", "half",   "--out"};
  for (const std::string& place : {(folder / "file").string(), (folder / "file/below").string(),
                                   std::string("/proc/nowhere")}) {
    CAPTURE(place);
    std::vector<std::string> arguments = study;
    arguments.push_back(place);
    const outcome o = run_bitshade(arguments);
    INFO("standard error: " << o.err);
    CHECK(o.status == 1);
    CHECK(std::count(o.err.begin(), o.err.end(), '\n') == 1);
    CHECK(o.err.find("--out") != std::string::npos);
  }
  CHECK(contents(folder / "file") == "in the way");

  // A database that is none, and one that belongs to another program.
  std::filesystem::create_directory(folder / "taken");
  write(folder / "taken/results.sqlite", std::string(4096, 'x'));
  std::vector<std::string> arguments = study;
  arguments.push_back((folder / "taken").string());
  const outcome o = run_bitshade(arguments);
  INFO("standard error: " << o.err);
  CHECK(o.status == 1);
  CHECK(o.err.find("results.sqlite") != std::string::npos);
  CHECK(contents(folder / "taken/results.sqlite") == std::string(4096, 'x'));
}

TEST_CASE("a full disk ends in status 1, with whole files only", "[app]") {
  const temporary_folder folder;
  const std::filesystem::path disk = folder / "disk";
  std::filesystem::create_directory(disk);
  if (mount("none", disk.c_str(), "tmpfs", 0, "size=192k") != 0) {
    WARN("skipped: a small file system needs the right to mount one");
    return;
  }
  const outcome o = run_bitshade(
      {"study", "garden", "--size", "128", "--view", "160x100", "--out", (disk / "out").string()});
  std::size_t left_aside = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(disk)) {
    if (entry.path().extension() == ".part") ++left_aside;
    if (entry.path().filename() == "results.json") ++left_aside;
  }
  umount(disk.c_str());
  INFO("standard error: " << o.err);
  CHECK(o.status == 1);
  CHECK(std::count(o.err.begin(), o.err.end(), '\n') == 1);
  CHECK(o.err.find("--out") != std::string::npos);
  CHECK(left_aside == 0);
}
