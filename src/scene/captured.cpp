// A captured depth map, and the receivers that look it up.

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/depth_file.hpp"
#include "io/error.hpp"
#include "io/numbers.hpp"
#include "io/text.hpp"
#include "scene/limits.hpp"
#include "scene/scene.hpp"

namespace bitshade {
namespace {

constexpr float nothing = std::numeric_limits<float>::quiet_NaN();

/// What is wrong with a map, for one sentence.
struct faults {
  std::size_t not_finite = 0, out_of_range = 0, first = 0;
  double first_value = 0;
  double low = std::numeric_limits<double>::infinity(), high = -low;  // of the finite ones
};

std::string value_text(double value) {
  if (value != value) return "NaN";
  if (std::isinf(value)) return value < 0 ? "-infinity" : "infinity";
  return shortest(value);
}

[[noreturn]] void refuse(const faults& f, const image<double>& values, const std::string& name,
                         bool ranged) {
  std::string text = name + " has ";
  if (f.not_finite > 0) text += std::to_string(f.not_finite) + " NaN or infinite";
  if (f.not_finite > 0 && f.out_of_range > 0) text += " and ";
  if (f.out_of_range > 0) {
    text += std::to_string(f.out_of_range) +
            (ranged ? " depths outside --depth-range" : " depths outside [0,1]");
  } else {
    text += " depths";
  }
  const auto width = static_cast<std::size_t>(values.width);
  text += " among " + std::to_string(values.texels.size()) + ", the first (" +
          value_text(f.first_value) + ") at column " + std::to_string(f.first % width) + ", row " +
          std::to_string(f.first / width) + " counted from 0";
  if (f.low <= f.high) {
    text += "; finite ones run from " + shortest(f.low) + " to " + shortest(f.high);
  }
  text += ": give ";
  if (f.out_of_range > 0)
    text += ranged ? "a wider --depth-range or " : "--depth-range NEAR,FAR or ";
  throw failure(text + "--mask-invalid to take them as never drawn");
}

/// Stored numbers as depths in [0,1], rounded once; NaN where there is none and that was allowed.
image<float> normalise(const stored_depths& stored, const scene_options& options,
                       const std::string& name) {
  const double near = options.depth_range ? options.depth_range->first : 0;
  const double far = options.depth_range ? options.depth_range->second : stored.one;
  image<float> out(stored.values.width, stored.values.height);
  faults found;
  for (std::size_t i = 0; i < out.texels.size(); ++i) {
    const double value = stored.values.texels[i];
    const double depth = (value - near) / (far - near);
    const bool finite = std::isfinite(value);
    if (finite) {
      found.low = std::min(found.low, value);
      found.high = std::max(found.high, value);
    }
    if (depth >= 0 && depth <= 1) {
      out.texels[i] = static_cast<float>(depth) + 0.0f;  // -0 becomes 0
      continue;
    }
    if (found.not_finite + found.out_of_range == 0) {
      found.first = i;
      found.first_value = value;
    }
    ++(finite ? found.out_of_range : found.not_finite);
    out.texels[i] = nothing;
  }
  if (found.not_finite + found.out_of_range > 0 && !options.mask_invalid) {
    refuse(found, stored.values, name, options.depth_range.has_value());
  }
  return out;
}

/// Change of depth from texel to texel along one axis: the smaller of the two one-sided
/// differences, so that a silhouette is not taken for a slope.
float slope(float before, float here, float after) {
  const float back = here - before, forth = after - here;
  if (!(back == back)) return forth == forth ? forth : 0;
  if (!(forth == forth)) return back;
  return std::abs(back) < std::abs(forth) ? back : forth;
}

/// A receiver at the centre of each pixel of `depths`; none where the depth is NaN.
void receivers_of(const image<float>& depths, frame& out) {
  const auto at = [&](int x, int y) {
    const bool inside = x >= 0 && y >= 0 && x < depths.width && y < depths.height;
    return inside ? depths.at(x, y) : nothing;
  };
  for (int y = 0; y < depths.height; ++y) {
    for (int x = 0; x < depths.width; ++x) {
      receiver& r = out.receivers[depths.offset(x, y)];
      const float t = depths.at(x, y);
      if (!(t == t)) continue;
      r.t = t;
      r.dt_du = slope(at(x - 1, y), t, at(x + 1, y)) * static_cast<float>(depths.width);
      r.dt_dv = slope(at(x, y - 1), t, at(x, y + 1)) * static_cast<float>(depths.height);
      r.surface = 1;
    }
  }
}

void seen_from_above(frame& out) {
  for (int y = 0; y < out.view_height; ++y) {
    for (int x = 0; x < out.view_width; ++x) {
      receiver& r =
          out.receivers[static_cast<std::size_t>(y) * static_cast<std::size_t>(out.view_width) +
                        static_cast<std::size_t>(x)];
      const auto on_grid = [](double value) {
        return static_cast<float>(std::floor(value * 0x1p24 + 0.5) * 0x1p-24);
      };
      r.u = on_grid((x + 0.5) / out.view_width);
      r.v = on_grid((y + 0.5) / out.view_height);
      r.du_dx = static_cast<float>(1.0 / out.view_width);
      r.dv_dy = static_cast<float>(1.0 / out.view_height);
      r.surface = 0;
      r.diffuse = 1;
    }
  }
}

void set_view(frame& out, int width, int height) {
  out.view_width = width;
  out.view_height = height;
  out.receivers.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  seen_from_above(out);
}

/// The depth of the synthetic receiver plane: the deepest one drawn.
float deepest(const image<float>& depths) {
  float plane = -1;
  for (const float d : depths.texels) {
    if (d < 1 && d > plane) plane = d;  // 1 is the usual clear value; NaN compares false
  }
  return plane < 0 ? 1 : plane;
}

}  // namespace

frame load_captured(const std::filesystem::path& file, const scene_options& options) {
  frame out;
  out.name = file.stem().string();
  image<float> depths = normalise(read_depths(file, options.channel), options, file.string());

  const std::string& wanted = options.receivers;
  const bool own_view = !options.given.contains("--view");
  if (is_depth_file(wanted) || wanted == "self") {
    if (!own_view) {
      throw usage_error("--view and --receivers " + wanted +
                        " contradict each other: the receivers have a size of their own");
    }
    const image<float> receivers =
        wanted == "self" ? depths
                         : normalise(read_depths(wanted, options.channel), options, wanted);
    set_view(out, receivers.width, receivers.height);
    receivers_of(receivers, out);
  } else {
    float plane = 0;
    if (wanted.empty() || wanted == "plane") {
      plane = deepest(depths);
    } else if (wanted.find_first_not_of("0123456789.eE+-") == std::string::npos) {
      const double depth = parse_numbers(wanted, "--receivers", 1, 1)[0];
      if (!(depth >= 0 && depth <= 1)) {
        throw usage_error("--receivers takes a depth from 0 to 1, but not " + wanted);
      }
      plane = static_cast<float>(depth);
    } else {
      throw usage_error(
          "--receivers takes plane, self, a depth from 0 to 1 or a depth image (.exr, "
          ".png, .pfm, .npy), but not '" +
          wanted + "'");
    }
    if (!own_view) check_sizes(options, 0);
    set_view(out, own_view ? depths.width : options.view_width,
             own_view ? depths.height : options.view_height);
    for (receiver& r : out.receivers) {
      r.t = plane;
      r.surface = 1;
    }
  }
  for (float& d : depths.texels) {
    if (!(d == d)) d = 1;  // masked: never drawn
  }
  out.depth = std::move(depths);
  return out;
}

}  // namespace bitshade
