#include "report/labels.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

#include "bitshade/study/configuration.hpp"
#include "io/text.hpp"
#include "run/study.hpp"

namespace bitshade {
namespace {

/// "name=value" words of a configuration, without its technique.
std::map<std::string, std::string> words_of(const row& r) {
  std::map<std::string, std::string> words;
  for (const std::string& word : split(r.configuration, ' ')) {
    const std::size_t equals = word.find('=');
    if (equals != std::string::npos) words[word.substr(0, equals)] = word.substr(equals + 1);
  }
  return words;
}

}  // namespace

std::vector<std::string> settings_of(std::span<const row> rows) {
  std::map<std::string, std::vector<std::size_t>> same;
  for (std::size_t i = 0; i < rows.size(); ++i) same[label_of(rows[i])].push_back(i);
  std::vector<std::string> settings(rows.size());
  for (const auto& [label, members] : same) {
    if (members.size() < 2) continue;
    std::map<std::string, std::set<std::string>> seen;
    std::map<std::string, std::size_t> times;
    for (const std::size_t i : members)
      for (const auto& [name, value] : words_of(rows[i])) seen[name].insert(value), ++times[name];
    for (const std::size_t i : members) {
      const auto words = words_of(rows[i]);
      for (const auto& [name, values] : seen) {
        if (values.size() == 1 && times[name] == members.size()) continue;
        const auto mine = words.find(name);
        settings[i] += (settings[i].empty() ? "" : ", ") + name + " " +
                       (mine == words.end() ? "none" : mine->second);
      }
    }
  }
  return settings;
}

std::vector<std::string> distinct_labels(std::span<const row> rows) {
  std::vector<std::string> labels = settings_of(rows);
  for (std::size_t i = 0; i < rows.size(); ++i)
    labels[i] = label_of(rows[i]) + (labels[i].empty() ? "" : ", ") + labels[i];
  return labels;
}

std::vector<row> telling_rows(std::span<const row> rows, std::size_t limit) {
  std::vector<row> all(rows.begin(), rows.end());
  if (all.size() <= limit) return all;
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto less = [&](std::size_t i, std::size_t j) {
    return std::tuple(all[i].figures.total.rmse, i) < std::tuple(all[j].figures.total.rmse, j);
  };
  std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(limit), order.end(),
                   less);
  order.resize(limit);
  std::sort(order.begin(), order.end());
  std::vector<row> chosen;
  for (const std::size_t i : order) chosen.push_back(std::move(all[i]));
  return chosen;
}

std::string method_of(const row& r) {
  std::string text = r.configuration;
  const std::size_t at = text.find(" format=");
  if (at != std::string::npos) text.erase(at, text.find(' ', at + 1) - at);
  return text;
}

bool shown_before(const row& a, const row& b) {
  const auto rank = [](const row& r) {
    const auto at = std::find(technique_names.begin(), technique_names.end(), r.technique);
    return std::tuple(at - technique_names.begin(), r.layers, method_of(r), r.bytes_per_texel == 0,
                      r.bytes_per_texel, r.format, r.key);
  };
  return rank(a) < rank(b);
}

}  // namespace bitshade
