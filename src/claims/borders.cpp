// C28: blurred moments at the edge of the ground plane.
#include <algorithm>
#include <array>
#include <cmath>

#include "bitshade/shadow/evsm.hpp"
#include "bitshade/texture/blur.hpp"
#include "claims/laboratory.hpp"
#include "claims/table.hpp"

namespace bitshade::claims {
namespace {

/// A lit ground plane that fills a map of one row, its depth rising by `slope` a texel from 0.3.
struct ground {
  double slope = 0;
  address mode = address::clamp;
  double beyond = 1;  ///< the border's depth, where the mode reads one
};

/// The most shadow on the plane: within the blur's reach of an edge, and inside.
struct shadow {
  double edge = 0, inside = 0;
};

constexpr int width = 64, reach = 4;
constexpr double exponent = 5, floor_variance = 1e-6;

/// Light at every texel from blurred moments of warp(depth).
template <class Warp, class Light>
shadow shadow_of(const ground& g, Warp warp, Light light) {
  const auto depth = [&](int x) { return 0.3 + g.slope * x; };
  const kernel blur = gaussian_kernel(2 * reach + 1, 2);
  std::array<std::vector<double>, 2> blurred;
  for (int power = 1; power <= 2; ++power) {
    image<double> row(width, 1);
    const auto moment = [&](double d) { return power == 1 ? warp(d) : warp(d) * warp(d); };
    for (int x = 0; x < width; ++x) row.at(x, 0) = moment(depth(x));
    auto& out = blurred[static_cast<std::size_t>(power - 1)];
    out.resize(width);
    blur_row_x<double>(row, blur, g.mode, 0, out, moment(g.beyond));
  }
  shadow most;
  for (int x = 0; x < width; ++x) {
    const auto i = static_cast<std::size_t>(x);
    const double dark = 1 - light(blurred[0][i], blurred[1][i], depth(x));
    double& worst = x < reach || x >= width - reach ? most.edge : most.inside;
    worst = std::max(worst, dark);
  }
  return most;
}

shadow with_vsm(const ground& g) {
  return shadow_of(
      g, [](double d) { return d; },
      [](double m1, double m2, double t) {
        return chebyshev(mean_and_variance(m1, m2), t, floor_variance);
      });
}

shadow with_evsm(const ground& g) {
  const evsm_constants c{exponent, exponent, 0};
  return shadow_of(
      g, [&](double d) { return positive_warp(d, c); },
      [&](double m1, double m2, double t) {
        return evsm_positive_bound(m1, m2, t, c, floor_variance);
      });
}

outcome measure(laboratory&) {
  outcome out;
  struct setting {
    const char* name;
    address mode;
    double beyond;
  };
  double vsm_most = 0, evsm_most = 0, flat_most = 0;
  for (const double slope : {0.0, 0.005}) {
    for (const auto& [name, mode, beyond] :
         {setting{"clamp", address::clamp, 1}, setting{"repeat", address::repeat, 1},
          setting{"mirror", address::mirror, 1}, setting{"border, depth 1", address::border, 1},
          setting{"border, depth 0", address::border, 0}}) {
      const ground g{slope, mode, beyond};
      const shadow vsm = with_vsm(g), evsm = with_evsm(g);
      const std::string head = std::string(slope == 0 ? "flat" : "slanted") + ", " + name + ": ";
      out.add(head + "darkest at the edge, VSM", vsm.edge);
      out.add(head + "darkest at the edge, EVSM", evsm.edge);
      vsm_most = std::max(vsm_most, vsm.edge);
      evsm_most = std::max(evsm_most, evsm.edge);
      if (slope == 0 && beyond == 1) flat_most = std::max({flat_most, vsm.edge, evsm.edge});
    }
  }
  out.claim("a blurred VSM darkens the edge by more than 1/255", vsm_most > tolerated_error);
  out.claim("EVSM nowhere darkens it by more than 1/255", evsm_most <= tolerated_error);
  out.add("darkest flat ground, unless a border lies in front of it, either way", flat_most);
  out.add("darkest edge, VSM", vsm_most);
  out.add("darkest edge, EVSM", evsm_most);
  out.remarks.push_back(
      "At an edge the blur's mean leaves the receiver's depth, whatever the warp; behind two "
      "depths "
      "alone, such as the ground and a border in front of it, a warp changes nothing at all.");
  return out;
}

}  // namespace

claim border_claim() {
  return {
      "C28",
      "A blurred VSM goes wrong at the edges of the ground plane; EVSM does not.",
      "[EVSMReport]",
      "A lit ground plane, flat or slanted, that fills its map; moments blurred by 9 taps under "
      "every address mode: the darkest texel within the blur's reach of the edge, c = 5.",
      measure,
      {}};
}

}  // namespace bitshade::claims
