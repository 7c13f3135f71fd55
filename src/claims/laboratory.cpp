#include "claims/laboratory.hpp"

#include <algorithm>
#include <cmath>

namespace bitshade::claims {

laboratory::laboratory(method under_test, laboratory_options how)
    : method_(std::move(under_test)), how_(how) {}

long laboratory::tries(long count) const {
  return std::max(40L, static_cast<long>(static_cast<double>(count) * how_.cases));
}

hunt_result laboratory::search(const trial& statement, std::uint64_t key, long count,
                               condition within) const {
  return hunt(statement, method_, stream(key), tries(count), within);
}

scene_options laboratory::sizes() const {
  const double side = std::sqrt(std::min(1.0, how_.pictures));
  const auto scaled = [&](int full) { return std::max(32, static_cast<int>(full * side)); };
  scene_options options;
  options.map_size = scaled(256);
  options.view_width = scaled(192);
  options.view_height = scaled(120);
  options.seed = how_.seed;
  options.threads = how_.threads;
  return options;
}

const frame& laboratory::scene(const std::string& name,
                               const std::map<std::string, std::string>& parameters) {
  std::string key = name;
  for (const auto& [parameter, value] : parameters) key += " " + parameter + "=" + value;
  if (const auto found = scenes_.find(key); found != scenes_.end()) return found->second;
  scene_options options = sizes();
  options.parameters = parameters;
  frame built = load_input(name, options);
  built.name = key;
  return scenes_.emplace(key, std::move(built)).first->second;
}

const std::vector<double>& laboratory::exact_of(const frame& scene, const configuration& how) {
  const std::string key = scene.name + "\n" + how.key();
  if (const auto found = pictures_.find(key); found != pictures_.end()) return found->second;
  return pictures_.emplace(key, method_.render(scene, how, how_.threads).visibility).first->second;
}

picture_result laboratory::picture(const frame& scene, const configuration& how) {
  configuration twin = how, kernel = how;
  twin.format = "exact";
  kernel.method = how.method == technique::savsm ? technique::savsm : technique::pcf;
  kernel.format = "exact";
  const auto truth = [&](const char* kind, auto compute) -> const std::vector<double>& {
    const std::string key = scene.name + "\n" + kind + kernel.key();
    if (const auto found = pictures_.find(key); found != pictures_.end()) return found->second;
    return pictures_.emplace(key, compute(scene, kernel, how_.threads)).first->second;
  };
  const auto& exact = exact_of(scene, twin);
  const auto& geometric = truth("geometric ", truth_geometric);
  const auto& pcf = truth("pcf ", truth_pcf);
  picture_result result{method_.render(scene, how, how_.threads), {}};
  result.figures = measure(scene, {result.got.visibility, exact, geometric, pcf, result.got.layer});
  return result;
}

timing summary_of(std::vector<double> seconds) {
  std::sort(seconds.begin(), seconds.end());
  return {seconds[seconds.size() / 2], seconds.front(), seconds.back()};
}

std::vector<timing> time_in_turn(const std::vector<std::function<double()>>& seconds, int rounds) {
  std::vector<std::vector<double>> all(seconds.size());
  for (int round = 0; round < rounds; ++round)
    for (std::size_t i = 0; i < seconds.size(); ++i) all[i].push_back(seconds[i]());
  std::vector<timing> result;
  for (auto& times : all) result.push_back(summary_of(std::move(times)));
  return result;
}

}  // namespace bitshade::claims
