// What a configuration chooses between, and the names of each choice.
#pragma once

#include <array>
#include <stdexcept>
#include <string>
#include <string_view>

namespace bitshade {

/// The techniques of the sources, in the order of their list ([LauritzenMcCool08], reports).
/// `deep` stores each texel's filtered visibility as a function of depth: no bound, no bleeding.
enum class technique { hard, pcf, vsm, savsm, lvsm, evsm2, evsm4, esm, csm, msm, deep };

inline constexpr std::array<std::string_view, 11> technique_names{
    "hard", "pcf", "vsm", "savsm", "lvsm", "evsm2", "evsm4", "esm", "csm", "msm", "deep"};

constexpr std::string_view name_of(technique t) {
  return technique_names[static_cast<std::size_t>(t)];
}

/// The technique of that name; throws std::invalid_argument where there is none.
inline technique technique_named(std::string_view name) {
  for (std::size_t i = 0; i < technique_names.size(); ++i) {
    if (technique_names[i] == name) return static_cast<technique>(i);
  }
  throw std::invalid_argument("unknown technique '" + std::string(name) + "'");
}

/// Where the layers' boundaries come from.
///
///   uniform     equal distances
///   lloyd       Lloyd relaxation over the depth map, at rest
///   manual      as given
///   lloyd-view  Lloyd relaxation over what the camera sees of the map
///   optimal     the least of the cost that Lloyd relaxation lowers, by dynamic programming
///   receivers   the least measured error of the actual receivers, by search
enum class split_rule { uniform, lloyd, manual, lloyd_view, optimal, receivers };

inline constexpr std::array<std::string_view, 6> split_rule_names{
    "uniform", "lloyd", "manual", "lloyd-view", "optimal", "receivers"};

/// What a variance shadow map stores beside the depth x.
///
///   square            x^2, of the depth before it is rounded: the sources' way
///   square_of_stored  the square of the depth as stored: a texel of one depth errs by q/2, not 3q/2
///   centred           4 (x - 1/2)^2: the variance's error at mu = 1 falls 2.4 times
enum class second_moment { square, square_of_stored, centred };

inline constexpr std::array<std::string_view, 3> second_moment_names{"square", "square-of-stored",
                                                                     "centred"};

/// Which layers a receiver looks up; of several the darkest counts.
///
///   own      the one that its depth falls into: the source's way
///   nearer   that one and all in front of it: right where the own one is worse than no layers
///   every    all of them
enum class layer_lookup { own, nearer, every };

inline constexpr std::array<std::string_view, 3> layer_lookup_names{"own", "nearer", "every"};

/// The names of layer_warp, in its order.
inline constexpr std::array<std::string_view, 2> layer_warp_names{"clamped", "unclamped"};

/// Which solution of the moment problem bounds the light of four moments: depths on the whole line
/// or in the map's range.
enum class moment_bound { hamburger, hausdorff };

inline constexpr std::array<std::string_view, 2> moment_bound_names{"hamburger", "hausdorff"};

/// How the map is read while shading.
enum class texel_filter { nearest, bilinear, trilinear };

inline constexpr std::array<std::string_view, 3> filter_names{"nearest", "bilinear", "trilinear"};

}  // namespace bitshade
