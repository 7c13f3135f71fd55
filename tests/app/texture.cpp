// sample, mipmap and convert as a user runs them: textures of every kind, every option, bad input.
#include <nlohmann/json.hpp>

#include "bitshade/formats/hexadecimal.hpp"
#include "io/png.hpp"
#include "support/catch.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

using namespace bitshade;
using namespace bitshade::test;

namespace {

const std::string header = "texture,format,level,width,height,texels_hex_row_major\n";

/// A folder with a texture of two channels, one of a byte, a PNG and coordinates of both kinds.
struct folder : temporary_folder {
  folder() {
    write(*this / "t.csv",
          header + "two,RG16_UNORM,0,2,2,0000/ffff 4000/8000 ffff/0000 8000/4000\n" +
              "two,RG16_UNORM,1,1,1,8000/8000\n" + "byte,R8_UNORM,0,4,1,00 ff 80 40\n");
    image<std::uint16_t> grey(3, 2);
    grey.texels = {0, 32768, 65535, 1, 2, 3};
    write_png(*this / "grey.png", grey);
    write(*this / "c.csv", "u,v,lod\n0.25,0.25,0\n0.5,0.5,0\n0.5,0.5,1\n-1,0.25,0\n");
    write(*this / "g.csv", "0.5,0.5,0.5,0,0,0.125\n");
  }
  outcome run(std::vector<std::string> arguments) const {
    run_options where;
    where.folder = path();
    return run_bitshade(std::move(arguments), where);
  }
  std::string sample(std::vector<std::string> more) const {
    std::vector<std::string> arguments{"sample", "--texture", "t.csv", "--name",
                                       "two",    "--coords",  "c.csv"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const outcome done = run(arguments);
    CHECK(done.err.empty());
    CHECK(done.status == 0);
    return done.out;
  }
};

std::string hex(float x) { return hexadecimal(static_cast<double>(x)); }

}  // namespace

TEST_CASE("sample answers a line a lookup and a column a channel, headed as its coordinates are") {
  const folder here;
  // The middle of four texels: their mean; (0 + 0x4000 + 0xffff + 0x8000) / 4 / 65535.
  const float mean = static_cast<float>(114687.0 / 4 / 65535);
  const std::string edge = "0x0p+0,0x1p+0\n", middle = hex(mean) + "," + hex(mean) + "\n";
  CHECK(here.sample({}) == "r,g\n" + edge + middle + middle + edge);
  const std::string half = hex(32768.0f / 65535.0f);
  CHECK(here.sample({"--filter", "trilinear"}) ==
        "r,g\n" + edge + middle + half + "," + half + "\n" + edge);
  // Repeated, u = -1 is u = 0: halfway between the columns.
  const std::string last = hex(static_cast<float>(16384.0 / 2 / 65535)) + "," +
                           hex(static_cast<float>((65535.0 + 32768) / 2 / 65535)) + "\n";
  CHECK(here.sample({"--wrap", "repeat"}) == "r,g\n" + edge + middle + middle + last);
  CHECK(here.sample({"--wrap", "border"}).ends_with("0x0p+0,0x0p+0\n"));
  CHECK(here.sample({"--wrap", "border", "--border", "0.5"}).ends_with("0x1p-1,0x1p-1\n"));
  CHECK(here.sample({"--wrap", "border", "--border", "0.5,2"}).ends_with("0x1p-1,0x1p+1\n"));
  const outcome headless = here.run({"sample", "--texture", "t.csv", "--name", "two", "--coords",
                                     "g.csv", "--filter", "trilinear", "--max-anisotropy", "4"});
  CHECK(headless.status == 0);
  CHECK(headless.out.starts_with("0x"));
}

TEST_CASE("sample knows every preset, wrap and filter") {
  const folder here;
  for (const char* preset :
       {"exact", "d3d11", "vulkan-strict", "cuda", "llvmpipe", "softpipe", "swiftshader"})
    for (const char* wrap : {"clamp", "repeat", "mirror", "border"})
      for (const char* filter : {"nearest", "bilinear", "trilinear"}) {
        CAPTURE(preset, wrap, filter);
        CHECK(here.sample({"--preset", preset, "--wrap", wrap, "--filter", filter}).size() > 20);
      }
  CHECK(here.run({"sample", "--texture", "t.csv", "--name", "byte", "--coords", "c.csv", "--preset",
                  "llvmpipe-r8"})
            .status == 0);
}

TEST_CASE("convert and mipmap give raw words that they read back") {
  const folder here;
  CHECK(here.run({"convert", "--texture", "grey.png", "--format", "half"}).out ==
        header + "grey,R16_FLOAT,0,3,2,0000 3800 3c00 0100 0200 0300\n");
  CHECK(here.run({"convert", "--texture", "t.csv", "--name", "two", "--format", "snorm16", "--out",
                  "s.csv"})
            .status == 0);
  CHECK(contents(here / "s.csv") ==
        header + "two,RG16_SNORM,0,2,2,0000/7fff 2000/4000 7fff/0000 4000/2000\n" +
            "two,RG16_SNORM,1,1,1,4000/4000\n");
  const outcome chain = here.run({"mipmap", "--texture", "t.csv", "--name", "byte"});
  // Means of two: 7f.5 and 60 to even, then their mean 70.
  CHECK(chain.out == header + "byte,R8_UNORM,0,4,1,00 ff 80 40\nbyte,R8_UNORM,1,2,1,80 60\n" +
                         "byte,R8_UNORM,2,1,1,70\n");
  write(here / "again.csv", chain.out);
  CHECK(here.run({"mipmap", "--texture", "again.csv"}).out == chain.out);
  for (const char* rule : {"box", "centre", "area"})
    CHECK(here.run({"mipmap", "--texture", "grey.png", "--mips", rule, "--format", "binary32"})
              .status == 0);
}

TEST_CASE("the texture commands answer in JSON what they answer in lines") {
  const folder here;
  using nlohmann::json;
  const std::string lines = here.sample({});
  const json list = json::parse(here.sample({"--json"}));
  std::string again = "r,g\n";
  for (const json& at : list)
    again += at["r"].get<std::string>() + "," + at["g"].get<std::string>() + "\n";
  CHECK(again == lines);
  const json chain =
      json::parse(here.run({"mipmap", "--texture", "t.csv", "--name", "byte", "--json"}).out);
  REQUIRE(chain.size() == 3);
  CHECK(chain[1] == json({{"texture", "byte"},
                          {"format", "R8_UNORM"},
                          {"level", 1},
                          {"width", 2},
                          {"height", 1},
                          {"texels", {{"0x80"}, {"0x60"}}}}));
  CHECK(here.run({"convert", "--texture", "t.csv", "--name", "two", "--format", "snorm16", "--json",
                  "--out", "s.json"})
            .out.empty());
  CHECK(json::parse(contents(here / "s.json"))[0]["texels"][1] == json({"0x2000", "0x4000"}));
}

TEST_CASE("llvmpipe-r8 takes what --format makes 8-bit unorm, and stores any format as llvmpipe") {
  const folder here;
  const auto with = [&](std::vector<std::string> arguments, const char* preset) {
    arguments.insert(arguments.end(), {"--texture", "grey.png", "--preset", preset});
    const outcome done = here.run(arguments);
    CHECK(done.status == 0);
    CHECK(done.err.empty());
    return done.out;
  };
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"sample", "--coords", "c.csv", "--format", "unorm8"},
           {"mipmap", "--format", "unorm8"},
           {"convert", "--format", "unorm8"},
           {"convert", "--format", "half"}})
    CHECK(with(arguments, "llvmpipe-r8") == with(arguments, "llvmpipe"));
}

TEST_CASE("exact sampling and chains of texels that are no numbers, and of far coordinates") {
  const folder here;
  write(here / "odd.csv", header + "a,R16_FLOAT,0,2,2,7e00 3c00 7c00 3800\n");
  write(here / "where.csv", "0.9,0.9,0\n0.1,0.1,0\n0.25,0.75,0\n");
  CHECK(here.run({"sample", "--texture", "odd.csv", "--coords", "where.csv", "--filter", "nearest"})
            .out == "0x1p-1\nnan\ninf\n");
  CHECK(here.run({"sample", "--texture", "odd.csv", "--coords", "where.csv", "--filter", "trilinear"})
            .status == 0);
  CHECK(here.run({"mipmap", "--texture", "odd.csv"}).out.ends_with("a,R16_FLOAT,1,1,1,7e00\n"));
  write(here / "far.csv", "1073741822,-1073741822,0\n");
  write(here / "near.csv", "0,0,0\n");
  for (const char* wrap : {"repeat", "mirror"}) {
    const auto at = [&](const char* file) {
      return here.run({"sample", "--texture", "grey.png", "--coords", file, "--wrap", wrap}).out;
    };
    CHECK(at("far.csv") == at("near.csv"));
  }
}

TEST_CASE("bad textures, coordinates and options: one sentence, the place in it, no output") {
  const folder here;
  write(here / "double.csv", header + "a,R64_FLOAT,0,2,1,3ff0000000000001 3ff0000000000000\n");
  write(here / "line.csv", "0.5,0.5,0,0,0,0\n0.5,0.5,1e9,0,0,1e-9\n");
  write(here / "no-header.csv", "a,R8_UNORM,0,1,1,00\n");
  write(here / "few.csv", header + "a,R8_UNORM,0,60000,60000,00\n");
  write(here / "wide.csv", header + "a,R8_UNORM,0,1,1,1ff\n");
  write(here / "format.csv", header + "a,R99_UNORM,0,1,1,00\n");
  write(here / "level.csv", header + "a,R8_UNORM,0,2,2,00 00 00 00\na,R8_UNORM,2,1,1,00\n");
  write(here / "short.png", contents(here / "grey.png").substr(0, 60));
  write(here / "word.csv", "u,v,lod\n0.1,x,0\n");
  write(here / "columns.csv", "0.1,0.2\n");
  struct bad {
    int status;
    std::vector<std::string> arguments;
    std::string says;
  };
  const std::vector<std::string> sample{"sample", "--texture", "t.csv", "--name",
                                        "two",    "--coords",  "c.csv"};
  const auto with = [&](std::vector<std::string> more) {
    std::vector<std::string> all = sample;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  for (const bad& b : std::vector<bad>{
           {1, {"mipmap", "--texture", "no-header.csv"}, "line 1"},
           {1, {"mipmap", "--texture", "few.csv"}, "line 2: too few texels"},
           {1, {"mipmap", "--texture", "wide.csv"}, "'1ff' is no word of 8 bits"},
           {1, {"mipmap", "--texture", "format.csv"}, "R99_UNORM"},
           {1, {"mipmap", "--texture", "level.csv"}, "level 1"},
           {1, {"convert", "--texture", "short.png", "--format", "half"}, "ends too early"},
           {1, {"convert", "--texture", "none.exr", "--format", "half"}, "none.exr"},
           {1, {"mipmap", "--texture", "double.csv"}, "'a' is R64_FLOAT"},
           {1, {"sample", "--texture", "double.csv", "--coords", "c.csv"}, "with --format"},
           {1,
            {"sample", "--texture", "grey.png", "--coords", "line.csv", "--preset", "llvmpipe",
             "--filter", "trilinear", "--max-anisotropy", "4"},
            "line.csv: lookup 2"},
           {2, {"convert", "--texture", "t.txt", "--format", "half"}, ".csv, .png or .exr"},
           {2, {"convert", "--texture", "t.csv", "--format", "half"}, "--name"},
           {2, {"convert", "--texture", "grey.png", "--format", "hafl"}, "half"},
           {2, {"convert", "--texture", "grey.png", "--format", "RG16_UNORM"}, "2 channels"},
           {1, {"convert", "--texture", "grey.png", "--format", "half", "--out", "no/x"}, "no/x"},
           {2, {"mipmap", "--texture", "grey.png", "--mips", "bx"}, "box"},
           {1, {"sample", "--texture", "grey.png", "--coords", "word.csv"}, "word.csv, line 2"},
           {1, {"sample", "--texture", "grey.png", "--coords", "columns.csv"}, "u,v,lod"},
           {2, with({"--preset", "d3d12"}), "d3d11"},
           {2, with({"--preset", "llvmpipe-r8"}), "8-bit unorm"},
           {2, with({"--wrap", "clam"}), "clamp"},
           {2, with({"--border", "1"}), "--wrap border"},
           {2, with({"--wrap", "border", "--border", "1,x"}), "--border"},
           {2, with({"--wrap", "border", "--border", "1e99"}), "finite binary32"},
           {2, with({"--filter", "cubic"}), "--filter"},
           {2, with({"--max-anisotropy", "4"}), "trilinear"},
           {2, with({"--filter", "trilinear", "--max-anisotropy", "4"}), "derivatives"},
           {2, with({"--filter", "trilinear", "--max-anisotropy", "17"}), "1 to 16"},
       }) {
    const outcome done = here.run(b.arguments);
    CAPTURE(b.arguments, done.out, done.err);
    CHECK(done.status == b.status);
    CHECK(done.out.empty());
    CHECK(done.err.find(b.says) != std::string::npos);
    CHECK(done.err.starts_with("bitshade: "));
    CHECK(std::count(done.err.begin(), done.err.end(), '\n') == 1);
  }
}

TEST_CASE("the texture commands' help keeps to 80 columns") {
  for (const char* command : {"sample", "mipmap", "convert"}) {
    const outcome done = run_bitshade({command, "--help"});
    CHECK(done.status == 0);
    std::size_t column = 0;
    for (const char c : done.out) {
      column = c == '\n' ? 0 : column + 1;
      REQUIRE(column <= 80);
    }
  }
}
