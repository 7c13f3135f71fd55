#include "run/blame.hpp"

#include <algorithm>
#include <bit>

#include "io/error.hpp"

namespace bitshade {

const stage_blame& blame::guiltiest() const {
  return *std::max_element(stages.begin(), stages.end(), [](const auto& a, const auto& b) {
    return a.alone.rmse < b.alone.rmse;
  });
}

namespace {

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

}  // namespace

blame blame_of(const frame& scene, const configuration& how, const stage_choices& choices,
               int threads) {
  const auto run = [&](stage_set in_format) {
    stage_choices these = choices;
    these.in_format = in_format;
    return run_staged(scene, how, these, threads).visibility;
  };
  blame result;
  result.exact = run(stage_set::none());
  result.visibility = run(stage_set::all());
  if (choices.weight_bits == 0 && !choices.shading &&
      !same_bits(result.visibility,
                 run_pipeline(scene, how, make_plan(scene, how, threads), threads).visibility)) {
    throw usage_error("this configuration has a stage that blame cannot take apart: " + how.key());
  }
  result.whole = compare(result.visibility, result.exact);
  for (const stage s : stages_of(how)) {
    stage_blame one;
    one.which = s;
    one.visibility = run(stage_set::only(s));
    one.alone = compare(one.visibility, result.exact);
    one.without = compare(run(stage_set::all().without(s)), result.exact);
    result.stages.push_back(std::move(one));
  }
  return result;
}

}  // namespace bitshade
