// The embedded scenes hold what docs/scenes.md says of them.
#include <algorithm>
#include <set>

#include "io/error.hpp"
#include "scene/scene.hpp"
#include "support/catch.hpp"
#include "support/refusals.hpp"

using namespace bitshade;

namespace {

scene_options small(std::map<std::string, std::string> parameters = {}) {
  scene_options o;
  o.map_size = 128;
  o.view_width = 96;
  o.view_height = 60;
  o.parameters = std::move(parameters);
  return o;
}

/// How many texels of the map have a depth in [low, high].
std::ptrdiff_t texels_between(const frame& f, float low, float high) {
  return std::count_if(f.depth.texels.begin(), f.depth.texels.end(),
                       [&](float d) { return d >= low && d <= high; });
}

std::string refusal(const std::string& name, const scene_options& options) {
  return message_of([&] { load_input(name, options); });
}

}  // namespace

TEST_CASE(
    "every embedded scene gives finite depths, receivers on the grid, and the same bits again") {
  for (const auto& info : known_scenes()) {
    INFO(info.name);
    scene_options one = small(), two = small();
    one.threads = 1;
    two.threads = 2;
    const frame f = load_input(info.name, one), again = load_input(info.name, two);
    CHECK(f.name == info.name);
    CHECK(f.depth == again.depth);
    CHECK(f.surface == again.surface);
    REQUIRE(f.receivers.size() == 96 * 60);
    std::size_t seen = 0, different = 0;
    for (std::size_t i = 0; i < f.receivers.size(); ++i) {
      const receiver &r = f.receivers[i], &s = again.receivers[i];
      different += r.u != s.u || r.v != s.v || r.t != s.t || r.dt_du != s.dt_du ||
                   r.dt_dv != s.dt_dv || r.du_dx != s.du_dx || r.dv_dy != s.dv_dy ||
                   r.surface != s.surface || r.diffuse != s.diffuse;
      if (r.surface == 0) continue;
      ++seen;
      CHECK((r.u >= 0 && r.u <= 1 && r.v >= 0 && r.v <= 1 && r.t >= 0 && r.t <= 1));
      CHECK(r.u * 0x1p24f == static_cast<float>(static_cast<int>(r.u * 0x1p24f)));
      CHECK(r.v * 0x1p24f == static_cast<float>(static_cast<int>(r.v * 0x1p24f)));
      CHECK((r.diffuse > 0 && r.diffuse <= 1.0001f));
    }
    CHECK(different == 0);
    CHECK(seen > f.receivers.size() / 4);  // the picture shows the scene, not the sky
    for (const float d : f.depth.texels) REQUIRE((d >= 0 && d <= 1));
  }
}

TEST_CASE("planes has its three depths and nothing else") {
  const frame f = load_input("planes", small({{"dx", "0.25"}, {"dy", "0.125"}, {"receiver", "1"}}));
  const std::set<float> depths(f.depth.texels.begin(), f.depth.texels.end());
  CHECK(depths == std::set<float>{0.625f, 0.875f, 1.0f});
  // A covers the left half of every row.
  CHECK(std::count(f.depth.texels.begin(), f.depth.texels.end(), 0.625f) == 128 * 64);
  CHECK(f.depth.at(63, 0) == 0.625f);
  CHECK(f.depth.at(64, 0) == 0.875f);
  CHECK(f.depth.at(64, 127) == 1.0f);  // the strip that B leaves free
}

TEST_CASE("garden: ground, bench and crown at their depths, one split between the first two") {
  scene_options o = small();
  o.map_size = 512;
  const frame f = load_input("garden", o);
  const auto texels = static_cast<double>(f.depth.texels.size());
  CHECK(static_cast<double>(texels_between(f, 0.95f, 0.95f)) > 0.5 * texels);
  // 1.5 x 0.4 of a window of 6 x 6, less the gaps and what the crown hides.
  const double bench = static_cast<double>(texels_between(f, 0.929999f, 0.930001f)) / texels * 36;
  CHECK((bench > 0.3 && bench < 0.6));
  CHECK(texels_between(f, 0.2f, 0.6f) > 0.05 * texels);
  CHECK(texels_between(f, 0.0f, 0.1999f) == 0);
  CHECK(texels_between(f, 0.9301f, 0.9499f) == 0);  // any split in (0.93, 0.95) parts them
}

TEST_CASE("slope crosses the whole range, half of it under the plate") {
  const frame f = load_input("slope", small());
  CHECK(texels_between(f, 0.0199f, 0.0201f) == 128 * 64);
  CHECK(f.depth.at(0, 127) < 0.07f);
  CHECK(f.depth.at(127, 127) > 0.99f);
  // Every one of eight uniform layers has receivers.
  std::set<int> layers;
  for (const auto& r : f.receivers) {
    if (r.surface != 0) layers.insert(std::min(7, static_cast<int>(r.t * 8)));
  }
  CHECK(layers.size() == 8);
}

TEST_CASE("beams: heights fall by the ratio") {
  scene_options o = small({{"count", "4"}, {"ratio", "2"}});
  o.map_size = 256;
  const frame f = load_input("beams", o);
  for (const float height : {0.9f, 0.45f, 0.225f, 0.1125f}) {
    INFO(height);
    CHECK(texels_between(f, 1 - height - 1e-6f, 1 - height + 1e-6f) > 100);
  }
}

TEST_CASE("rts: ground and buildings lie beyond 0.8, debris before 0.7") {
  const frame f = load_input("rts", small());
  CHECK(texels_between(f, 0.7001f, 0.8f) == 0);
  CHECK(texels_between(f, 0.0f, 0.0999f) == 0);
  CHECK(texels_between(f, 0.1f, 0.7f) > 50);
}

TEST_CASE("city has the triangles it is asked for") {
  for (const char* count : {"1000", "5000", "54321"}) {
    scene_options o = small({{"triangles", count}});
    const scene s = build_scene("city", o);
    INFO(count << " asked, " << s.triangles.size() << " built");
    CHECK(std::stoul(count) - s.triangles.size() < 10);
    CHECK(s.surfaces.size() == s.triangles.size());
  }
}

TEST_CASE("the seed changes what is random, and animation moves every scene") {
  for (const auto& info : known_scenes()) {
    INFO(info.name);
    const frame still = load_input(info.name, small());
    CHECK(load_input(info.name, small({{"animation", "0.3"}})).depth != still.depth);
    if (info.name == "planes" || info.name == "slope") continue;  // nothing random in them
    scene_options other = small();
    other.seed = 2;
    CHECK(load_input(info.name, other).depth != still.depth);
  }
}

TEST_CASE("every parameter works at both ends of its range") {
  for (const auto& info : known_scenes()) {
    for (const auto& p : info.parameters) {
      for (double value : {p.low, p.high}) {
        if (info.name == "city" && value > 1e6) value = 1e5;  // the largest is a bench's task
        INFO(info.name << " " << p.name << "=" << value);
        scene_options o = small({{p.name, std::to_string(value)}});
        CHECK_NOTHROW(load_input(info.name, o));
      }
    }
  }
}

TEST_CASE("unknown scenes and parameters are refused with the nearest known one") {
  CHECK(holds(refusal("gardn", small()), "did you mean 'garden'?"));
  CHECK(holds(refusal("beams", small({{"cuont", "3"}})), "did you mean 'count'?"));
  CHECK(holds(refusal("beams", small({{"count", "0"}})), "from 1 to 400"));
  CHECK(holds(refusal("beams", small({{"count", "2.5"}})), "whole number"));
  CHECK(holds(refusal("beams", small({{"ratio", "x"}})), "--param ratio"));
}

TEST_CASE("sizes of zero or beyond memory are refused before anything is allocated") {
  scene_options o = small();
  o.map_size = 0;
  CHECK_THROWS_WITH(load_input("garden", o), "--size takes sizes from 1 to 65536, but not 0");
  o = small();
  o.view_height = -1;
  CHECK_THROWS_AS(load_input("garden", o), usage_error);
  o = small();
  o.view_width = o.view_height = 65536;
  CHECK(holds(refusal("garden", o), "ask for a smaller --view"));
  o = small();
  o.map_size = 65536;
  CHECK(holds(refusal("garden", o), "ask for a smaller --size"));
}
