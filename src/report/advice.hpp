// The cheapest of a study's configurations that keeps an error, and why the others lost.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "run/row.hpp"

namespace bitshade {

/// What is asked: the least cost among those whose measure is no more than most_error.
///
///   bytes     of a texel, all layers and channels
///   traffic   bytes that a frame reads and writes
///   time      of a frame, in frames of a single-layer VSM in binary32
struct advice_question {
  std::string measure = "total-rmse";  ///< as measured() knows it
  double most_error = 0;
  std::string cost = "bytes";
};

std::span<const std::string_view> cost_names();
/// Failure  usage_error with the nearest name where there is no such cost.
double cost_of(const row& r, std::string_view cost);

/// One configuration in the order of the answer.
struct advised {
  std::size_t row = 0;  ///< index into the rows
  std::string label;
  bool keeps = false;
  std::string why;  ///< "the cheapest", what it costs more, or by how much it errs
};

struct advice {
  advice_question question;
  std::vector<advised> order;  ///< those that keep the error by cost, then the others by error

  /// None where nothing keeps the error.
  std::optional<std::size_t> chosen() const;
};

/// Of equal costs the smaller of the other two, then the smaller error, decides. Exact rows, which
/// no device stores, do not take part.
advice advise(std::span<const row> rows, const advice_question& question);

/// Sentences and a table of at most 80 columns.
std::string text_advice(const advice& found, std::span<const row> rows);
nlohmann::ordered_json json_advice(const advice& found, std::span<const row> rows);

}  // namespace bitshade
