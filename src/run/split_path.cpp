#include "run/split_path.hpp"

#include <algorithm>
#include <cmath>

#include "run/lloyd.hpp"

namespace bitshade {

namespace {

std::vector<double> interior_of(const std::vector<double>& splits) {
  return {splits.begin() + 1, splits.end() - 1};
}

}  // namespace

split_follower::split_follower(const configuration& how, int steps_a_frame)
    : how_(how),
      steps_(steps_a_frame),
      relaxation_(interior_of(uniform_splits(how.layers)), how.lloyd.steps) {}

bool split_follower::relaxing() const {
  return how_.method == technique::lvsm && how_.layers > 1 &&
         (how_.splits == split_rule::lloyd || how_.splits == split_rule::lloyd_view);
}

configuration split_follower::follow(const frame& scene, int threads) {
  if (!relaxing()) return how_;
  const lloyd_field field(scene, how_, threads);
  for (int i = 0; i < steps_; ++i) field.step(relaxation_);
  configuration now = how_;
  const double narrowest = std::max(split_grid, on_split_grid(how_.min_width));
  now.manual_splits = interior_of(splits_from(relaxation_.interior(), narrowest));
  now.layers = static_cast<int>(now.manual_splits.size()) + 1;
  now.splits = now.layers > 1 ? split_rule::manual : split_rule::uniform;
  return now;
}

split_place split_follower::place_of(const frame& scene, const std::vector<double>& splits,
                                     int threads) {
  if (how_.method != technique::lvsm || how_.layers == 1) return {};
  const lloyd_field field(scene, how_, threads);
  split_place place;
  place.interior = relaxing() ? relaxation_.interior() : interior_of(splits);
  place.teleportations = relaxation_.teleportations();
  place.cost = field.cost(place.interior);
  place.least = field.least_cost(place.interior.size());
  if (last_.interior.size() == place.interior.size()) {
    for (std::size_t i = 0; i < place.interior.size(); ++i) {
      place.move = std::max(place.move, std::fabs(place.interior[i] - last_.interior[i]));
    }
  }
  last_ = place;
  return place;
}

}  // namespace bitshade
