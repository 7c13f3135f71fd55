// C29: what the texture filter is worth, and depths interpolated from vertices.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "claims/laboratory.hpp"
#include "claims/table.hpp"
#include "scene/light.hpp"

namespace bitshade::claims {
namespace {

/// Root mean square errors of one way to store and to sample.
struct sampled {
  double truth = 0;     ///< against the geometric truth: the method's own error included
  double filtered = 0;  ///< against the same technique in exact arithmetic, bilinear
};

/// Whether unorm16, filtered, is nearer than floats that are point-sampled.
struct ranking {
  bool truth = true, filtered = true;
};

ranking compare_on(laboratory& lab, const std::string& name, outcome& out) {
  const frame& scene = lab.scene(name);
  configuration how;
  how.blur_taps = 5, how.blur_sigma = 1.25;
  const auto truth = truth_geometric(scene, how, lab.threads());
  const auto rendered = [&](const char* format, texel_filter filter) {
    how.format = format;
    how.filter = filter;
    return lab.under_test().render(scene, how, lab.threads()).visibility;
  };
  const auto exact = rendered("exact", texel_filter::bilinear);
  const auto error = [&](const char* format, texel_filter filter, const char* label) {
    const auto got = rendered(format, filter);
    const sampled e{compare(got, truth).rmse, compare(got, exact).rmse};
    out.add(name + ", " + label + ": RMSE against the truth", e.truth);
    out.add(name + ", " + label + ": RMSE against exact and filtered", e.filtered);
    return e;
  };
  const sampled half = error("half", texel_filter::nearest, "half, nearest texel"),
                single = error("binary32", texel_filter::nearest, "binary32, nearest texel"),
                unorm = error("unorm16", texel_filter::bilinear, "unorm16, bilinear");
  error("binary32", texel_filter::bilinear, "binary32, bilinear");
  return {unorm.truth < half.truth && unorm.truth < single.truth,
          unorm.filtered < half.filtered && unorm.filtered < single.filtered};
}

/// How far a depth interpolated from a triangle's corners is from the depth of the point itself:
/// the most over random triangles in front of a light.
double interpolation_error(const laboratory& lab, depth_metric metric, bool point_light) {
  random_stream random = lab.stream(2901);
  double most = 0;
  for (long i = 0; i < lab.tries(500); ++i) {
    const auto somewhere = [&] {
      return glm::vec3(random.next(-1, 1), random.next(-1, 1), random.next(-1, 1));
    };
    scene one;
    one.vertices = {somewhere(), somewhere(), somewhere()};
    if (point_light)
      aim_point_light(one, {0.1, 4, 0.2});
    else
      aim_directional_light(one, {0.3, -1, 0.2});
    const light_projection light(one, metric, "tight");
    const triangle_points t{one.vertices[0], one.vertices[1], one.vertices[2]};
    const auto depth = [&](glm::dvec3 p) {
      const glm::dvec3 at = light.project(p);
      return light.depth_at(t, at.x, at.y);
    };
    const double b = random.next(), c = random.next() * (1 - b), a = 1 - b - c;
    const double between = a * depth(t.a) + b * depth(t.b) + c * depth(t.c);
    // A triangle seen nearly edge-on has no well-conditioned depth at a (u, v).
    const glm::dvec3 middle = t.a * a + t.b * b + t.c * c;
    const double facing = glm::dot(glm::normalize(t.normal()), light.towards_light(middle));
    if (std::fabs(facing) < 0.05) continue;
    most = std::max(most, std::fabs(between - depth(middle)));
  }
  return most;
}

outcome measure(laboratory& lab) {
  outcome out;
  ranking all;
  for (const char* name : {"garden", "rts", "beams"}) {
    const ranking here = compare_on(lab, name, out);
    all.truth = all.truth && here.truth;
    all.filtered = all.filtered && here.filtered;
  }
  out.claim("unorm16 filtered is nearer to the truth than floats point-sampled", all.truth);

  bool small = true;
  for (const char* name : {"planes", "city"}) {
    const auto depths = [&](depth_metric metric) {
      scene_options options = lab.sizes();
      options.metric = metric;
      options.light_position = glm::dvec3(2, 9, 1);
      return load_input(name, options).depth;
    };
    const auto distance = depths(depth_metric::distance), vertex = depths(depth_metric::vertex);
    double most = 0;
    for (std::size_t i = 0; i < distance.texels.size(); ++i)
      most = std::max(most, std::fabs(static_cast<double>(distance.texels[i]) -
                                      static_cast<double>(vertex.texels[i])));
    out.add(std::string(name) + ", point light: distance interpolated, largest error of depth",
            most);
    small = small && most <= tolerated_error;
  }
  out.claim("a distance interpolated from the vertices is right to 1/255 of the range", small);

  // A planar metric is linear over a triangle: what is left is binary64's, over a grazing angle.
  constexpr double rounding = 1e-12;
  double planar = 0;
  for (const bool point_light : {false, true})
    planar = std::max(planar, interpolation_error(lab, depth_metric::linear, point_light));
  out.add("random triangles, linear metric interpolated: largest error of depth", planar);
  out.add("random triangles, distance interpolated: largest error of depth",
          interpolation_error(lab, depth_metric::distance, true));
  out.condition =
      "the metric is planar, and pictures are judged by what format and filter add to the method's "
      "own error";
  out.provided("a planar metric interpolated is right to 1e-12 of the range", planar <= rounding);
  out.provided(
      "unorm16 filtered is nearer to the exact, filtered picture than floats "
      "point-sampled",
      all.filtered);
  return out;
}

}  // namespace

claim sampling_claim() {
  return {"C29",
          "Floats can only be point-sampled, so that normalised 16-bit moments look better; a "
          "distance interpolated from the vertices suffices.",
          "[Marinescu11]",
          "Three scenes with a blur of sigma 1.25, nearest and bilinear, against the truth and "
          "against the exact picture; depths under a point light by vertex and by pixel, on two "
          "scenes and on random triangles.",
          measure,
          {}};
}

}  // namespace bitshade::claims
