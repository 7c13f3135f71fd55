// What every experiment is given: the method under test, randomness, scenes and a scale.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "bitshade/study/measures.hpp"
#include "claims/claim.hpp"
#include "scene/scene.hpp"

namespace bitshade::claims {

/// How a run of claims is set up.
struct laboratory_options {
  std::uint64_t seed = 1;
  double cases = 1;     ///< share of the random cases
  double pictures = 1;  ///< share of the pictures' area: figures, and with them verdicts, change
  int threads = 0;
};

/// A technique's picture and what it is measured against.
struct picture_result {
  cell got;
  measures figures;
};

class laboratory {
 public:
  laboratory(method under_test, laboratory_options how);

  const method& under_test() const { return method_; }
  int threads() const { return how_.threads; }

  /// `count` random cases in a full run, never fewer than 40.
  long tries(long count) const;
  /// An independent stream of random numbers.
  random_stream stream(std::uint64_t key) const { return {how_.seed, key}; }
  hunt_result search(const trial& statement, std::uint64_t key, long count,
                     condition within = nullptr) const;

  /// The sizes of a map and a picture.
  scene_options sizes() const;
  /// An embedded scene at the laboratory's size: built once a run.
  const frame& scene(const std::string& name,
                     const std::map<std::string, std::string>& parameters = {});

  /// Renders and measures against exact arithmetic and both truths.
  picture_result picture(const frame& scene, const configuration& how);

 private:
  const std::vector<double>& exact_of(const frame& scene, const configuration& how);

  method method_;
  laboratory_options how_;
  std::map<std::string, frame> scenes_;
  std::map<std::string, std::vector<double>> pictures_;  ///< exact ones and truths
};

/// What a stopwatch says of some actions, each in turn, `rounds` times: medians and spread.
struct timing {
  double median = 0;  ///< seconds
  double low = 0, high = 0;
};
timing summary_of(std::vector<double> seconds);
std::vector<timing> time_in_turn(const std::vector<std::function<double()>>& seconds, int rounds);

}  // namespace bitshade::claims
