#include "run/database.hpp"

#include <sqlite3.h>

#include <type_traits>

#include "io/error.hpp"
#include "run/listing.hpp"

namespace bitshade {
namespace {

constexpr int application_id = 0x62697473;  // "bits"
constexpr int schema_version = 2;

std::string sql_type(column_kind kind) {
  switch (kind) {
    case column_kind::text:
      return "TEXT NOT NULL";
    case column_kind::integer:
      return "INTEGER NOT NULL";
    case column_kind::real:
    case column_kind::time:
      return "REAL";
  }
  return "";
}

/// The columns of `cells`, each followed by `after` and joined by commas.
template <class F>
std::string column_list(F describe) {
  std::string out;
  const row r;
  each_column(r, [&](const std::string& name, column_kind kind, const auto&) {
    out += (out.empty() ? "" : ", ") + describe(name, kind);
  });
  return out;
}

std::string names() {
  return column_list([](const std::string& name, column_kind) { return name; }) + ", lists";
}

}  // namespace

/// A prepared statement: bound by position, stepped to its end.
class database::statement {
 public:
  statement(const database& db, const std::string& sql) : db_(db) {
    if (sqlite3_prepare_v2(db.handle_, sql.c_str(), -1, &handle_, nullptr) != SQLITE_OK)
      db.fail("cannot be read");
  }
  ~statement() { sqlite3_finalize(handle_); }
  statement(const statement&) = delete;
  statement& operator=(const statement&) = delete;

  template <class T>
  statement& bind(const T& value) {
    const int at = ++bound_;
    if constexpr (std::is_convertible_v<T, std::string_view>) {
      const std::string_view text = value;
      sqlite3_bind_text64(handle_, at, text.data(), text.size(), SQLITE_TRANSIENT, SQLITE_UTF8);
    } else if constexpr (std::is_floating_point_v<T>) {
      sqlite3_bind_double(handle_, at, value);
    } else {
      sqlite3_bind_int64(handle_, at, static_cast<sqlite3_int64>(value));
    }
    return *this;
  }
  statement& bind_blob(std::string_view bytes) {
    sqlite3_bind_blob64(handle_, ++bound_, bytes.data(), bytes.size(), SQLITE_TRANSIENT);
    return *this;
  }
  bool step() {
    const int status = sqlite3_step(handle_);
    if (status != SQLITE_ROW && status != SQLITE_DONE) db_.fail("cannot be read or written");
    return status == SQLITE_ROW;
  }
  std::string text(int column) const {
    const void* bytes = sqlite3_column_blob(handle_, column);
    const int size = sqlite3_column_bytes(handle_, column);
    return bytes == nullptr
               ? ""
               : std::string(static_cast<const char*>(bytes), static_cast<std::size_t>(size));
  }
  template <class T>
  void get(int column, T& value) const {
    if constexpr (std::is_same_v<T, std::string>)
      value = text(column);
    else if constexpr (std::is_floating_point_v<T>)
      value = sqlite3_column_double(handle_, column);
    else
      value = static_cast<T>(sqlite3_column_int64(handle_, column));
  }
  row as_row() const {
    row r;
    int column = 0;
    each_column(r, [&](const std::string&, column_kind, auto& value) { get(column++, value); });
    from_lists(text(column), r);
    return r;
  }

 private:
  const database& db_;
  sqlite3_stmt* handle_ = nullptr;
  int bound_ = 0;
};

database::database(const std::filesystem::path& file, access how) : file_(file) {
  const int flags =
      how == access::read ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  try {
    if (sqlite3_open_v2(file.c_str(), &handle_, flags, nullptr) != SQLITE_OK)
      fail("cannot be opened");
    sqlite3_busy_timeout(handle_, 60000);
    int id = 0, version = 0;
    {
      statement read(*this, "PRAGMA application_id");
      if (read.step()) read.get(0, id);
    }
    {
      statement read(*this, "PRAGMA user_version");
      if (read.step()) read.get(0, version);
    }
    if (how == access::create && id == 0 && version == 0) {
      const std::string columns = column_list([](const std::string& name, column_kind kind) {
        return name + " " + sql_type(kind) + (name == "key" ? " PRIMARY KEY" : "");
      });
      execute("BEGIN IMMEDIATE");
      execute(("CREATE TABLE IF NOT EXISTS cells (" + columns + ", lists TEXT NOT NULL)").c_str());
      execute(
          "CREATE TABLE IF NOT EXISTS inputs (digest TEXT PRIMARY KEY, name TEXT NOT NULL, "
          "description TEXT NOT NULL)");
      execute(
          "CREATE TABLE IF NOT EXISTS pictures (owner TEXT NOT NULL, kind TEXT NOT NULL, "
          "png BLOB NOT NULL, PRIMARY KEY (owner, kind))");
      execute(("PRAGMA application_id = " + std::to_string(application_id)).c_str());
      execute(("PRAGMA user_version = " + std::to_string(schema_version)).c_str());
      execute("COMMIT");
    } else if (id != application_id) {
      throw failure(file_.string() + ": is a database, but not of bitshade's results; " +
                    "give another folder with --out");
    } else if (version != schema_version) {
      throw failure(file_.string() + ": was written by another version of bitshade (schema " +
                    std::to_string(version) + ", not " + std::to_string(schema_version) +
                    "); give another folder with --out");
    }
  } catch (...) {
    sqlite3_close(handle_);
    throw;
  }
}

database::~database() { sqlite3_close(handle_); }

void database::fail(const std::string& what) const {
  const int code = handle_ != nullptr ? sqlite3_errcode(handle_) : SQLITE_NOMEM;
  const std::string reason = handle_ != nullptr ? sqlite3_errmsg(handle_) : "out of memory";
  std::string cure = "give another folder with --out";
  if (code == SQLITE_FULL) cure = "make room, or " + cure;
  if (code == SQLITE_BUSY || code == SQLITE_LOCKED) cure = "another run holds it: wait, or " + cure;
  if (code == SQLITE_NOTADB || code == SQLITE_CORRUPT) cure = "move it away, or " + cure;
  throw failure(file_.string() + ": " + what + ": " + reason + "; " + cure);
}

void database::execute(const char* sql) {
  if (sqlite3_exec(handle_, sql, nullptr, nullptr, nullptr) == SQLITE_OK) return;
  try {
    fail("cannot be written");
  } catch (...) {
    sqlite3_exec(handle_, "ROLLBACK", nullptr, nullptr, nullptr);
    throw;
  }
}

std::optional<row> database::find(const std::string& key) const {
  statement select(*this, "SELECT " + names() + " FROM cells WHERE key = ?");
  select.bind(key);
  if (!select.step()) return std::nullopt;
  return select.as_row();
}

std::vector<row> database::rows() const {
  std::vector<row> all;
  statement select(*this, "SELECT " + names() + " FROM cells ORDER BY rowid");
  while (select.step()) all.push_back(select.as_row());
  return all;
}

std::vector<input_description> database::inputs() const {
  std::vector<input_description> all;
  statement select(*this, "SELECT digest, name, description FROM inputs ORDER BY rowid");
  while (select.step()) all.push_back({select.text(0), select.text(1), select.text(2)});
  return all;
}

picture_files database::pictures(const std::string& owner) const {
  picture_files all;
  statement select(*this, "SELECT kind, png FROM pictures WHERE owner = ?");
  select.bind(owner);
  while (select.step()) all[select.text(0)] = select.text(1);
  return all;
}

namespace {
constexpr const char* put_picture =
    "INSERT OR REPLACE INTO pictures (owner, kind, png) VALUES (?, ?, ?)";
}

void database::store_cell(const row& r, const picture_files& pictures) {
  execute("BEGIN IMMEDIATE");
  try {
    const std::string marks =
        column_list([](const std::string&, column_kind) -> std::string { return "?"; });
    statement insert(*this,
                     "INSERT OR REPLACE INTO cells (" + names() + ") VALUES (" + marks + ", ?)");
    each_column(r, [&](const std::string&, column_kind, const auto& value) { insert.bind(value); });
    insert.bind(lists_of(r)).step();
    for (const auto& [kind, png] : pictures)
      statement(*this, put_picture).bind(r.key).bind(kind).bind_blob(png).step();
  } catch (...) {
    sqlite3_exec(handle_, "ROLLBACK", nullptr, nullptr, nullptr);
    throw;
  }
  execute("COMMIT");
}

void database::store_input(const input_description& input, const picture_files& pictures) {
  execute("BEGIN IMMEDIATE");
  try {
    statement(*this, "INSERT OR REPLACE INTO inputs (digest, name, description) VALUES (?, ?, ?)")
        .bind(input.digest)
        .bind(input.name)
        .bind(input.description)
        .step();
    for (const auto& [kind, png] : pictures)
      statement(*this, put_picture).bind(input.digest).bind(kind).bind_blob(png).step();
  } catch (...) {
    sqlite3_exec(handle_, "ROLLBACK", nullptr, nullptr, nullptr);
    throw;
  }
  execute("COMMIT");
}

std::size_t database::merge(const std::filesystem::path& other) {
  { database check(other, access::read); }  // ours, whole and of this version
  statement(*this, "ATTACH ? AS other").bind(other.string()).step();
  execute("BEGIN IMMEDIATE");
  execute(("INSERT OR IGNORE INTO cells (" + names() + ") SELECT " + names() +
           " FROM other.cells ORDER BY rowid")
              .c_str());
  std::size_t added = 0;
  {
    statement changes(*this, "SELECT changes()");
    if (changes.step()) changes.get(0, added);
  }
  execute("INSERT OR IGNORE INTO inputs SELECT * FROM other.inputs ORDER BY rowid");
  execute("INSERT OR IGNORE INTO pictures SELECT * FROM other.pictures");
  execute("COMMIT");
  execute("DETACH other");
  return added;
}

}  // namespace bitshade
