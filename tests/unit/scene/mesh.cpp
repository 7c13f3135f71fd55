// Meshes that the tests write themselves: what is read, what is staged, what is refused.
#include "scene/mesh.hpp"

#include <algorithm>
#include <bit>
#include <set>
#include <sstream>

#include "io/atomic_file.hpp"
#include "io/error.hpp"
#include "support/catch.hpp"
#include "support/refusals.hpp"
#include "support/temporary_folder.hpp"

using namespace bitshade;

namespace {

/// A unit cube of six quads.
const std::string cube =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 4 8 7 3\nf 1 5 8 4\nf 2 3 7 6\n";

void put(std::ostream& out, std::uint32_t word) {
  for (int shift = 0; shift < 32; shift += 8) out.put(static_cast<char>(word >> shift & 255));
}

/// A binary glTF with one triangle, lifted by its node.
std::string triangle_glb() {
  std::string json =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],)"
      R"("nodes":[{"mesh":0,"translation":[0,5,0]}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"buffers":[{"byteLength":36}],)"
      R"("bufferViews":[{"buffer":0,"byteLength":36}],)"
      R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}]})";
  json.append((4 - json.size() % 4) % 4, ' ');
  std::ostringstream out;
  out << "glTF";
  put(out, 2);
  put(out, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + 36));
  put(out, static_cast<std::uint32_t>(json.size()));
  put(out, 0x4E4F534A);
  out << json;
  put(out, 36);
  put(out, 0x004E4942);
  for (const float f : {0.f, 0.f, 0.f, 2.f, 0.f, 0.f, 0.f, 0.f, 2.f}) {
    put(out, std::bit_cast<std::uint32_t>(f));
  }
  return out.str();
}

std::string refusal(const std::string& name, const std::string& bytes,
                    const scene_options& options = {}) {
  const temporary_folder folder;
  write_file(folder / name, bytes);
  return message_of([&] { load_mesh(folder / name, options); });
}

scene load(const std::string& name, const std::string& bytes, const scene_options& options = {}) {
  const temporary_folder folder;
  write_file(folder / name, bytes);
  return load_mesh(folder / name, options);
}

}  // namespace

TEST_CASE("an .obj cube: twelve triangles, six surfaces, and a ground as the seventh") {
  const scene s = load("cube.obj", cube);
  CHECK(s.name == "cube");
  CHECK(std::set<std::uint32_t>(s.surfaces.begin(), s.surfaces.end()).size() == 7);
  CHECK(std::count_if(s.surfaces.begin(), s.surfaces.end(), [](auto id) { return id <= 6; }) == 12);
  float lowest = 1;
  for (const auto& v : s.vertices) lowest = std::min(lowest, v.y);
  CHECK(lowest == 0);  // the ground touches the cube's bottom

  scene_options bare;
  bare.parameters.emplace("ground", "0");
  CHECK(load("cube.obj", cube, bare).triangles.size() == 12);
}

TEST_CASE("a .glb's nodes move its triangles") {
  scene_options bare;
  bare.parameters.emplace("ground", "0");
  const scene s = load("triangle.glb", triangle_glb(), bare);
  REQUIRE(s.triangles.size() == 1);
  for (const auto& v : s.vertices) CHECK(v.y == 5);
}

TEST_CASE("a mesh becomes a frame: its shadow falls on the ground before the camera") {
  const temporary_folder folder;
  write_file(folder / "cube.obj", cube);
  scene_options o;
  o.map_size = 256;
  o.view_width = 160;
  o.view_height = 100;
  const frame f = load_input((folder / "cube.obj").string(), o);
  CHECK(*std::min_element(f.depth.texels.begin(), f.depth.texels.end()) < 0.3f);
  std::size_t lit = 0, shadowed = 0, cube_pixels = 0;
  for (const receiver& r : f.receivers) {
    if (r.surface == 0) continue;
    if (r.surface < 7) {
      ++cube_pixels;
      continue;
    }
    const int x = std::min(255, static_cast<int>(r.u * 256)),
              y = std::min(255, static_cast<int>(r.v * 256));
    ++(f.surface.at(x, y) == r.surface ? lit : shadowed);
  }
  CHECK(cube_pixels > 300);
  CHECK(lit > 3000);
  CHECK(shadowed > 300);

  o.light_position = glm::dvec3(3, 6, 2);
  o.metric = depth_metric::distance;
  const frame point = load_input((folder / "cube.obj").string(), o);
  CHECK(point.depth != f.depth);
}

TEST_CASE("meshes that are broken are refused with file, place and cure") {
  CHECK(holds(refusal("a.obj", ""), "it is empty"));
  CHECK(holds(refusal("a.obj", "v 0 0 0\nv 1 0 0\n"), "cannot read"));
  CHECK(holds(refusal("a.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n"), "cannot read"));
  CHECK(holds(refusal("a.obj", "hello"), "cannot read"));
  CHECK(holds(refusal("a.obj", "v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 3\n"), "not finite"));
  CHECK(holds(refusal("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1e39 0\nf 1 2 3\n"), "not finite"));
  CHECK(holds(refusal("a.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n"), "a.obj"));
  CHECK(holds(refusal("a.glb", cube), "not a binary glTF"));
  const std::string whole = triangle_glb();
  for (std::size_t size = 1; size < whole.size(); ++size) {
    INFO("truncated to " << size << " of " << whole.size());
    REQUIRE(holds(refusal("a.glb", whole.substr(0, size)), "cannot read"));
  }
  scene_options o;
  o.parameters.emplace("grund", "1");
  CHECK(holds(refusal("a.obj", cube, o), "usage: a mesh has no parameter 'grund'"));
}
