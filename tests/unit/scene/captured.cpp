// Captured depth maps: hard cases 13 and 14, receivers, and contradicting options.
#include <limits>

#include "io/depth_file.hpp"
#include "io/error.hpp"
#include "scene/scene.hpp"
#include "support/catch.hpp"
#include "support/refusals.hpp"
#include "support/temporary_folder.hpp"

using namespace bitshade;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();

struct capture {
  temporary_folder folder;
  std::string path = (folder / "map.pfm").string();
  scene_options options;

  explicit capture(std::vector<float> depths, int width = 4) {
    image<float> map(width, static_cast<int>(depths.size()) / width);
    map.texels = std::move(depths);
    write_depths(path, map);
  }
  frame load() const { return load_input(path, options); }
};

}  // namespace

TEST_CASE("NaN, infinite and out-of-range depths are refused with their count and first place") {
  capture c({0.1f, 0.2f, 0.3f, 0.4f, 0.5f, nan_value, infinity, 0.8f, 2.0f, -1.0f, 1.0f, 1.0f});
  const std::string text = message_of([&] { c.load(); });
  INFO(text);
  CHECK(holds(text, "map.pfm has 2 NaN or infinite and 2 depths outside [0,1] among 12"));
  CHECK(holds(text, "the first (NaN) at column 1, row 1"));
  CHECK(holds(text, "finite ones run from -1 to 2"));
  CHECK(holds(text, "--mask-invalid"));
  CHECK(holds(text, "--depth-range"));
}

TEST_CASE("masked depths count as never drawn") {
  capture c({0.1f, 0.2f, nan_value, 7.0f});
  c.options.mask_invalid = true;
  const frame f = c.load();
  CHECK(f.depth.texels == std::vector<float>{0.1f, 0.2f, 1.0f, 1.0f});
}

TEST_CASE("a depth range rescales, also a reversed one, and minus zero becomes zero") {
  capture c({10.0f, 15.0f, 20.0f, 30.0f});
  c.options.depth_range = {10, 30};
  CHECK(c.load().depth.texels == std::vector<float>{0, 0.25f, 0.5f, 1});
  c.options.depth_range = {30, 10};
  const frame reversed = c.load();
  CHECK(reversed.depth.texels == std::vector<float>{1, 0.75f, 0.5f, 0});
  CHECK_FALSE(std::signbit(reversed.depth.texels[3]));
  c.options.depth_range = {12, 30};
  CHECK(holds(message_of([&] { c.load(); }),
              "1 depths outside --depth-range among 4, the first (10)"));
}

TEST_CASE("integer codes are shares of their largest, or in the range's own numbers") {
  const temporary_folder folder;
  const std::string path = (folder / "map.png").string();
  image<float> map(2, 1);
  map.texels = {0.0f, 1.0f};
  write_depths(path, map);
  scene_options options;
  CHECK(load_input(path, options).depth.texels == std::vector<float>{0, 1});
  options.depth_range = {0, 131070};
  CHECK(load_input(path, options).depth.texels == std::vector<float>{0, 0.5f});
}

TEST_CASE("by default the receivers are a plane at the deepest depth that was drawn") {
  capture c({0.5f, 0.25f, 1.0f, 0.75f, 0.75f, 0.75f, 1.0f, 0.75f});
  const frame f = c.load();
  REQUIRE(f.view_width == 4);
  REQUIRE(f.view_height == 2);
  CHECK(f.surface.texels.empty());
  for (const receiver& r : f.receivers) {
    CHECK(r.t == 0.75f);
    CHECK(r.surface == 1);
    CHECK(r.dt_du == 0);
  }
  CHECK(f.receivers[5].u == 0.375f);
  CHECK(f.receivers[5].v == 0.75f);
  CHECK(f.receivers[5].du_dx == 0.25f);
  CHECK(f.receivers[5].dv_dy == 0.5f);
}

TEST_CASE("receivers: the map's own surface, a plane, or a second image of another size") {
  capture c({0.5f, 0.25f, nan_value, 0.75f, 0.5f, 0.5f, 0.5f, 0.75f});
  c.options.mask_invalid = true;
  c.options.receivers = "self";
  frame f = c.load();
  CHECK(f.receivers[1].t == 0.25f);
  CHECK(f.receivers[1].dt_du == -1.0f);  // (0.25 - 0.5) a texel, 4 texels
  CHECK(f.receivers[2].surface == 0);    // masked
  CHECK(f.receivers[3].dt_dv == 0);
  c.options.receivers = "0.875";
  CHECK(c.load().receivers[0].t == 0.875f);

  image<float> receivers(3, 1, 1, 0.9f);
  receivers.texels[2] = nan_value;
  const std::string path = (c.folder / "receivers.exr").string();
  write_depths(path, receivers);
  c.options.receivers = path;
  f = c.load();
  REQUIRE(f.receivers.size() == 3);
  CHECK(f.receivers[0].t == 0.9f);
  CHECK(f.receivers[2].surface == 0);
  CHECK(f.depth.width == 4);
  c.options.mask_invalid = false;
  CHECK(holds(message_of([&] { c.load(); }), "map.pfm has 1 NaN"));
}

TEST_CASE("options that contradict a captured map are refused") {
  capture c({0.5f, 0.25f, 0.5f, 0.75f});
  for (const char* option : {"--size", "--light", "--camera", "--metric", "--param"}) {
    c.options.given = {option};
    CHECK(holds(message_of([&] { c.load(); }), std::string("usage: ") + option + " means nothing"));
  }
  c.options.given = {"--view"};
  c.options.receivers = "self";
  CHECK(holds(message_of([&] { c.load(); }), "contradict"));
  c.options.receivers = "1.5";
  CHECK(holds(message_of([&] { c.load(); }), "from 0 to 1"));
  c.options.receivers = "plain";
  CHECK(holds(message_of([&] { c.load(); }), "but not 'plain'"));
  scene_options embedded;
  embedded.given = {"--depth-range"};
  CHECK(holds(message_of([&] { load_input("garden", embedded); }), "for captured depth maps"));
  embedded.given.clear();
  embedded.light_direction = embedded.light_position = glm::dvec3(0, -1, 0);
  CHECK(holds(message_of([&] { load_input("garden", embedded); }), "contradict each other"));
}

TEST_CASE("a missing file, a folder, another ending and an unknown name each say what to do") {
  const temporary_folder folder;
  const auto refusal = [](const std::string& name) {
    return message_of([&] { load_input(name, scene_options()); });
  };
  CHECK(holds(refusal((folder / "none.exr").string()), "check the name"));
  std::filesystem::create_directory(folder / "d.npy");
  CHECK(holds(refusal((folder / "d.npy").string()), "it is a folder"));
  CHECK(holds(refusal("map.tiff"), "check its ending"));
  CHECK(holds(refusal("bems"), "did you mean 'beams'?"));
}
