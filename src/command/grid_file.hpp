// JSON files that people write: read whole, with errors that say where.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace bitshade::command {

/// The file's JSON; // comments are allowed.
/// Failure  failure where it cannot be read; usage_error with line and column where it is no JSON,
///          and with the name where an object has one twice.
nlohmann::ordered_json read_json(const std::string& file);

}  // namespace bitshade::command
