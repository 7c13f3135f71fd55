#include "run/blame.hpp"

#include <algorithm>

namespace bitshade {

const stage_blame& blame::guiltiest() const {
  return *std::max_element(stages.begin(), stages.end(), [](const auto& a, const auto& b) {
    return a.alone.rmse < b.alone.rmse;
  });
}

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
