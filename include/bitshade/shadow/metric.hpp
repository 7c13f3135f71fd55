// What a light calls depth along its axis.
#pragma once

namespace bitshade {

/// A distance z along the light's axis as a depth: 0 at near, 1 at far, linear and not clamped.
///
///   (z - near) / (far - near)
///
/// What lies in front of near comes out negative: clamp it before it is squared (clamp_depth), for
/// a square taken first brings it back as an occluder behind near.
///
/// Policy   every operation is T's.
/// Failure  none for far > near.
/// Source   (13): [Marinescu11], there for each layer's own near and far.
template <class T>
constexpr T linear_metric(const T& z, const T& near, const T& far) {
  return (z - near) / (far - near);
}

}  // namespace bitshade
