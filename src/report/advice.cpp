#include "report/advice.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <tuple>

#include "io/error.hpp"
#include "io/nearest.hpp"
#include "io/text.hpp"
#include "report/labels.hpp"
#include "report/pareto.hpp"
#include "report/text_table.hpp"
#include "run/study.hpp"

namespace bitshade {
namespace {

constexpr std::array<std::string_view, 3> names{"bytes", "traffic", "time"};

/// "vsm unorm16, noise floor"; where that is not enough, all settings that differ.
std::vector<std::string> short_labels(std::span<const row> rows) {
  std::vector<std::string> labels;
  std::set<std::string> seen;
  for (const row& r : rows) {
    const bool noise = r.configuration.find(" noise-floor=on") != std::string::npos;
    labels.push_back(label_of(r) + (noise ? ", noise floor" : ""));
    if (!seen.insert(labels.back()).second) return distinct_labels(rows);
  }
  return labels;
}

double time_of(const row& r) { return r.natural.relative.median; }

std::string with_unit(double value, const std::string& cost) {
  if (cost == "bytes") return brief_or_whole(value) + " B/texel";
  if (cost == "traffic") return brief(value / 1e6) + " MB a frame";
  return brief(value) + " of the reference's time";
}

/// "errs 2.50 x too much", "errs 0.44 % too much".
std::string why_wrong(double error, double most) {
  if (most == 0) return "errs";
  const double ratio = error / most;
  return "errs " + (ratio < 1.1 ? brief((ratio - 1) * 100, 2) + " %" : brief(ratio) + " x") +
         " too much";
}

/// What a configuration that keeps the error costs beyond the cheapest.
std::string why_dearer(const row& r, const row& best, const std::string& cost) {
  const double mine = cost_of(r, cost), least = cost_of(best, cost);
  if (mine > least)
    return (mine / least >= 10 ? brief(mine / least, 3) : brief(mine / least, 2)) + " x the cost";
  if (cost == "bytes" && r.device.bytes_per_frame > best.device.bytes_per_frame)
    return "as cheap, more traffic";
  if (cost != "bytes" && r.bytes_per_texel > best.bytes_per_texel) return "as cheap, more bytes";
  return "as cheap, no better";
}

}  // namespace

std::span<const std::string_view> cost_names() { return names; }

double cost_of(const row& r, std::string_view cost) {
  if (cost == "bytes") return r.bytes_per_texel;
  if (cost == "traffic") return r.device.bytes_per_frame;
  if (cost == "time") return time_of(r);
  throw usage_error("--cost: there is no '" + std::string(cost) + "'; " + suggest(cost, names));
}

std::optional<std::size_t> advice::chosen() const {
  if (order.empty() || !order.front().keeps) return std::nullopt;
  return order.front().row;
}

advice advise(std::span<const row> rows, const advice_question& question) {
  advice found{question, {}};
  const std::vector<std::string> labels = short_labels(rows);
  const auto error = [&](std::size_t i) { return measured(rows[i], question.measure); };
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].bytes_per_texel != 0)
      found.order.push_back({i, labels[i], error(i) <= question.most_error, ""});
  const auto rank = [&](const advised& a) {
    const row& r = rows[a.row];
    return std::tuple(!a.keeps, a.keeps ? cost_of(r, question.cost) : error(a.row),
                      r.bytes_per_texel, r.device.bytes_per_frame, error(a.row), a.row);
  };
  std::sort(found.order.begin(), found.order.end(),
            [&](const advised& a, const advised& b) { return rank(a) < rank(b); });
  for (advised& a : found.order) {
    if (!a.keeps)
      a.why = why_wrong(error(a.row), question.most_error);
    else
      a.why = &a == &found.order.front()
                  ? "the cheapest"
                  : why_dearer(rows[a.row], rows[found.order.front().row], question.cost);
  }
  return found;
}

std::string text_advice(const advice& found, std::span<const row> rows) {
  const advice_question& q = found.question;
  std::string out, sentence;
  if (const auto best = found.chosen()) {
    const row& r = rows[*best];
    sentence = "The cheapest that keeps " + q.measure + " within " + brief(q.most_error) + ": " +
               found.order.front().label + ", for " + with_unit(cost_of(r, q.cost), q.cost) +
               ", with an error of " + brief(measured(r, q.measure)) + ".";
  } else {
    sentence = "No configuration here keeps " + q.measure + " within " + brief(q.most_error) + ".";
  }
  for (const std::string& line : wrap(sentence, 80)) out += line + '\n';
  std::vector<text_line> lines{{"configuration", "error", "B/texel", "MB", "time", "verdict"}};
  for (const advised& a : found.order) {
    const row& r = rows[a.row];
    const std::string name =
        a.label.size() <= 30 ? a.label : label_of(r) + " #" + std::to_string(a.row + 1);
    lines.push_back({name, brief(measured(r, q.measure)), std::to_string(r.bytes_per_texel),
                     brief(r.device.bytes_per_frame / 1e6), brief(time_of(r)), a.why});
  }
  return out + '\n' + text_table(lines, {0, 5}) +
         "\nMB: read and written a frame. time: 1.0 is a frame of a single-layer VSM in\n"
         "binary32, run natively beside each. noise floor: the least floor under which the\n"
         "format's noise darkens a lit receiver by 1/255.\n";
}

nlohmann::ordered_json json_advice(const advice& found, std::span<const row> rows) {
  nlohmann::ordered_json all{{"measure", found.question.measure},
                             {"max_error", found.question.most_error},
                             {"cost", found.question.cost},
                             {"chosen", nullptr},
                             {"configurations", nlohmann::ordered_json::array()}};
  if (const auto best = found.chosen()) all["chosen"] = rows[*best].key;
  for (const advised& a : found.order) {
    const row& r = rows[a.row];
    all["configurations"].push_back(
        {{"key", r.key},
         {"label", a.label},
         {"configuration", r.configuration},
         {"keeps", a.keeps},
         {"why", a.why},
         {"error", measured(r, found.question.measure)},
         {"bytes_per_texel", r.bytes_per_texel},
         {"bytes_per_frame", r.device.bytes_per_frame},
         {"relative_time", r.natural.relative.median},
         {"relative_time_low", r.natural.relative.low},
         {"relative_time_high", r.natural.relative.high}});
  }
  return all;
}

}  // namespace bitshade
