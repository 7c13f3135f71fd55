#include "run/variance.hpp"

#include <algorithm>
#include <charconv>
#include <string>

#include "bitshade/shadow/evsm.hpp"
#include "bitshade/shadow/layer_packing.hpp"
#include "io/error.hpp"
#include "run/engines.hpp"
#include "run/layered_run.hpp"
#include "run/native.hpp"
#include "run/natural.hpp"

namespace bitshade {

namespace {

std::string three_digits(double x) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, x, std::chars_format::general, 3).ptr;
  return {text, end};
}

/// Says so where the floor is under what the format's noise needs, in the widest layer in use.
void note_low_floor(run_context& run) {
  if (run.how.noise_floor || run.how.warping == layer_warp::unclamped) return;
  double width = 0;
  for (std::size_t i = 0; i < run.layers.intervals.size(); ++i) {
    const interval& layer = run.layers.intervals[i];
    if (!run.layers.users[i].empty()) width = std::max(width, layer.far - layer.near);
  }
  const double noise = variance_noise(run.how, run.storage, run.scene.depth);
  const double needed = floor_for(noise, tolerated_error) * width * width;
  if (!(run.how.min_variance < needed)) return;
  run.result.notes.push_back("the floor " + detail::shortest(run.how.min_variance) + " is under " +
                             three_digits(needed) + ", which the noise of " + run.how.format +
                             " needs to keep lit receivers within 1/255");
}

/// Refuses what overflows without the clamp, and says so where a format's range takes its place.
void check_reach(run_context& run) {
  if (run.how.warping == layer_warp::clamped) return;
  double low = 1, high = 0;  // of the depths, then of their places in any layer
  for (const image<float>* map : depth_maps(run.scene, run.look.samples)) {
    const auto [least, most] = std::minmax_element(map->texels.begin(), map->texels.end());
    low = std::min(low, clamp_depth(static_cast<double>(*least)));
    high = std::max(high, clamp_depth(static_cast<double>(*most)));
  }
  double from = 0, to = 0;
  for (const interval& layer : run.layers.intervals) {
    from = std::min(from, warp(low, layer, layer_warp::unclamped));
    to = std::max(to, warp(high, layer, layer_warp::unclamped));
  }
  const double largest = largest_of(run.storage.format);
  const std::string reach = "without the clamp depths reach from " + three_digits(from) + " to " +
                            three_digits(to) + " in their layers";
  if (run.storage.format.kind == family::binary) {
    if (std::max(from * from, to * to) <= largest) return;
    throw usage_error(reach + ", whose square overflows " + run.how.format +
                      ": take wider layers, a format of wider range, or clamped layers");
  }
  if (from < 0 || to * to > largest) {
    run.result.notes.push_back(reach + "; " + run.how.format +
                               " saturates, the square apart from the depth");
  }
}

/// Moments of all layers from one reading of the depths, two layers in four channels side by side;
/// then each layer's are filtered like those that a post-process makes, and their bits are equal.
template <class T>
class one_pass_technique {
 public:
  one_pass_technique(const run_context& run, variance_technique<T> alone)
      : intervals_(run.layers.intervals),
        alone_(std::move(alone)),
        all_(run.scene.depth.width, run.scene.depth.height,
             4 * packed_textures(static_cast<int>(intervals_.size()))) {
    const stopwatch watch(run.result.map_seconds);
    const bool plain = run.how.second == second_moment::square && !run.how.slope_term;
    for_rows(run.threads, all_.height, [&](int y) {
      if (plain) {
        layers_row<T>(run.scene.depth.row(y), intervals_, all_.row(y),
                      static_cast<std::size_t>(all_.channels), run.how.warping);
        return;
      }
      auto technique = alone_;
      std::vector<T> row(2 * static_cast<std::size_t>(all_.width));
      for (std::size_t i = 0; i < intervals_.size(); ++i) {
        technique.begin(intervals_[i]);
        technique.fill(run.scene.depth, y, row);
        copy(row, 2, 0, all_.row(y), static_cast<std::size_t>(all_.channels), 2 * i);
      }
    });
  }

  int channels() const { return 2; }
  void begin(const interval& layer) {
    alone_.begin(layer);
    layer_ = static_cast<std::size_t>(std::find(intervals_.begin(), intervals_.end(), layer) -
                                      intervals_.begin());
  }
  void fill(const image<float>&, int y, std::span<T> row) const {
    copy(all_.row(y), static_cast<std::size_t>(all_.channels), 2 * layer_, row, 2, 0);
  }
  T light(std::span<const T> values, const T& t) const { return alone_.light(values, t); }

 private:
  /// Two channels of each texel, from channel `first` of `from` to channel `to_first` of `to`.
  static void copy(std::span<const T> from, std::size_t from_channels, std::size_t first,
                   std::span<T> to, std::size_t to_channels, std::size_t to_first) {
    for (std::size_t x = 0; x < to.size() / to_channels; ++x) {
      to[x * to_channels + to_first] = from[x * from_channels + first];
      to[x * to_channels + to_first + 1] = from[x * from_channels + first + 1];
    }
  }

  const std::vector<interval>& intervals_;
  variance_technique<T> alone_;
  image<T> all_;
  std::size_t layer_ = 0;
};

template <class T, class Technique>
void run_technique(run_context& run, Technique technique) {
  if constexpr (std::is_same_v<T, float>)
    if (runs_naturally(run)) return run_natural(run, std::move(technique));
  native_engine<T, Technique> engine(run, std::move(technique));
  run_layers(engine, run);
}

template <class T>
void run_in(run_context& run) {
  variance_technique<T> usual(run.how, run.storage, run.scene.depth);
  // Samples are resolved a layer at a time; the bits would be the same.
  if (run.how.method == technique::lvsm && run.how.one_pass && run.look.samples == 1) {
    run_technique<T>(run, one_pass_technique<T>(run, std::move(usual)));
  } else {
    run_technique<T>(run, std::move(usual));
  }
}

}  // namespace

void run_variance_native(run_context& run) {
  check_reach(run);
  note_low_floor(run);
  run.storage.wide ? run_in<double>(run) : run_in<float>(run);
}

}  // namespace bitshade
