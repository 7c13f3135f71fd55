// Rows as CSV and JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "run/row.hpp"

namespace bitshade {

/// One row as an object: each_column's names, then splits, effects and notes.
nlohmann::ordered_json to_json(const row& r);

/// RFC 4180: a head line, one line a row, CRLF-free; numbers read back as the same bits.
std::string to_csv(std::span<const row> rows);

/// The lists of a row as JSON text, for the database, and back.
/// Failure  from_lists throws nlohmann::json::exception where the text is none of ours.
std::string lists_of(const row& r);
void from_lists(const std::string& text, row& r);

}  // namespace bitshade
