// results.sqlite: every finished cell, committed at once.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "run/row.hpp"

struct sqlite3;

namespace bitshade {

/// What a study looked at: enough to head a report.
struct input_description {
  std::string digest;
  std::string name;
  std::string description;  ///< JSON: sizes, histogram, how to reproduce
};

/// A PNG file by what it shows: "visibility", "error", "format-error".
using picture_files = std::map<std::string, std::string>;

/// The results of all studies in one folder.
///
/// A cell and its pictures enter in one transaction, with a rollback journal: a process killed at
/// any moment loses only the cell it was at, and the next opening rolls back what was half-written.
/// Several processes may share a database; each waits for the others' commits.
/// Failure  every call throws `failure` with the file, SQLite's reason and the cure.
class database {
 public:
  enum class access { create, read };

  explicit database(const std::filesystem::path& file, access how = access::create);
  ~database();
  database(const database&) = delete;
  database& operator=(const database&) = delete;

  /// The row of that key, or nothing: then the cell is still to be computed.
  std::optional<row> find(const std::string& key) const;
  /// All rows, in the order of their insertion.
  std::vector<row> rows() const;
  std::vector<input_description> inputs() const;
  /// Pictures of a cell (by its key) or of an input (by its digest).
  picture_files pictures(const std::string& owner) const;

  /// Stores a cell with its pictures, in place of what has that key.
  void store_cell(const row& r, const picture_files& pictures);
  void store_input(const input_description& input, const picture_files& pictures);

  /// Takes over what another database has and this one lacks; returns the number of new rows.
  std::size_t merge(const std::filesystem::path& other);

 private:
  class statement;
  void execute(const char* sql);
  [[noreturn]] void fail(const std::string& what) const;

  std::filesystem::path file_;
  sqlite3* handle_ = nullptr;
};

}  // namespace bitshade
