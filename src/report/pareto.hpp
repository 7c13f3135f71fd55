// Accuracy against what it costs: which configurations nothing beats, and what beats the others.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "report/html.hpp"

namespace bitshade {

/// An error that a front may be drawn of, by the name that the command line knows.
/// Failure  usage_error with the nearest name where there is no such measure.
double measured(const row& r, std::string_view measure);

/// For each (error, cost): the index of one that has no more of either and less of one, from among
/// those that nothing beats, the one of least error; -1 where there is none: the front.
std::vector<int> beaten_by(std::span<const std::pair<double, double>> points);

struct pareto_front {
  std::string measure;
  std::vector<row> rows;  ///< those that a device could store; exact ones are none
  std::vector<std::string> labels;
  std::vector<int> by_time, by_bytes;  ///< beaten_by() of each
};

/// Half the distance of the quartiles.
double deviation(const spread& s);
/// What the reference took beside a configuration: seconds that are 1.0; 1 where nothing was timed.
double reference_seconds(const natural_times& times);
/// Whether what beats row i in time does so by less than both times' quartiles are apart.
bool within_spread(const pareto_front& front, std::size_t i);

/// A sentence where the quartiles of many times lie far apart: the machine was busy; else empty.
std::string doubt_of(const pareto_front& front);

pareto_front pareto_of(std::span<const row> rows, const std::string& measure);

/// A table of at most 80 columns, and by what the others are beaten.
std::string text_pareto(const pareto_front& front);
report_part html_pareto(const pareto_front& front, const std::string& command);
nlohmann::ordered_json json_pareto(const pareto_front& front);

}  // namespace bitshade
