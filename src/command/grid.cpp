#include "command/grid.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "command/grid_file.hpp"
#include "command/option_use.hpp"
#include "command/study_options.hpp"
#include "io/build.hpp"
#include "io/error.hpp"
#include "io/nearest.hpp"

namespace bitshade::command {
namespace {

using json = nlohmann::ordered_json;

/// One field of a cell: an option's name and its value as a command line writes it.
struct field {
  std::string name, value, path;
  bool operator==(const field& other) const { return name == other.name && value == other.value; }
};
using fields = std::vector<field>;

/// The options that a cell may set: those of a study, under their first names.
class option_names {
 public:
  option_names() : options_(add_study_options(app_, {})) {
    for (const CLI::Option* option : app_.get_options())
      for (const std::string& name : option->get_lnames()) {
        if (name == "help") continue;
        first_[name] = option->get_lnames().front();
        flag_[name] = option->get_expected_max() == 0;
      }
  }
  bool knows(const std::string& name) const { return first_.contains(name); }
  bool is_flag(const std::string& name) const { return flag_.at(name); }
  const std::string& first(const std::string& file, const std::string& path,
                           const std::string& name) const {
    const auto found = first_.find(name);
    if (found != first_.end()) return found->second;
    std::vector<std::string_view> known;
    for (const auto& [key, value] : first_) known.push_back(key);
    const std::string_view near = nearest(name, known);
    throw usage_error(file + ": " + path + ": a cell has no field '" + name + "'; " +
                      (near.empty() ? "fields are the options of 'bitshade study --help' without --"
                                    : "did you mean '" + std::string(near) + "'?"));
  }

 private:
  CLI::App app_;
  std::shared_ptr<study_options> options_;
  std::map<std::string, std::string> first_;
  std::map<std::string, bool> flag_;
};

class grid {
 public:
  grid(std::string file, const std::vector<std::string>& shared) : file_(std::move(file)) {
    // Others are the scene's and the run's: no business of a cell.
    for (const std::string& argument : shared)
      if (names_.knows(argument.substr(2, argument.find('=') - 2))) shared_.push_back(argument);
  }

  std::vector<asked_cell> cells() {
    const json whole = read_json(file_);
    if (!whole.is_object()) refuse("", "the file holds no object: write {\"product\": {…}}");
    for (const auto& [name, value] : whole.items())
      if (name != "product" && name != "exclude" && name != "cells")
        refuse("/" + name, "is neither \"product\", \"exclude\" nor \"cells\"");
    if (whole.contains("exclude")) {
      if (!whole["exclude"].is_array()) refuse("/exclude", "is no list: write [{…}, …]");
      each(whole["exclude"], "/exclude", [&](const json& one, const std::string& path) {
        exclusions_.push_back({values_of(one, path), path, false});
      });
    }
    if (whole.contains("product")) {
      each(whole["product"], "/product",
           [&](const json& one, const std::string& path) { multiply(one, path); });
    }
    for (const exclusion& e : exclusions_)
      if (!e.used) refuse(e.path, "excludes no cell of the product: leave it out, or mend it");
    if (whole.contains("cells")) {
      if (!whole["cells"].is_array()) refuse("/cells", "is no list: write [{…}, …]");
      each(whole["cells"], "/cells",
           [&](const json& one, const std::string& path) { single(one, path); });
    }
    for (const auto& [place, use] : fields_)
      if (!use.second)
        refuse(place, "'" + use.first + "' is for " + users_of(use.first) +
                          ": leave it out, or describe such a cell");
    if (cells_.empty()) refuse("", "describes no cell: give a \"product\" or \"cells\"");
    return side_by_side();
  }

 private:
  struct exclusion {
    std::map<std::string, std::vector<field>> values;
    std::string path;
    bool used;
  };

  [[noreturn]] void refuse(const std::string& path, const std::string& why) const {
    throw usage_error(file_ + ": " + (path.empty() ? "" : path + ": ") + why);
  }

  /// Calls f(value, path) for a list's values, or for the one value that is no list.
  template <class F>
  void each(const json& list, const std::string& path, F f) const {
    if (!list.is_array()) return f(list, path);
    for (std::size_t i = 0; i < list.size(); ++i) f(list[i], path + "/" + std::to_string(i));
  }

  std::string text_of(const std::string& name, const json& value, const std::string& path) const {
    if (names_.is_flag(name)) {
      if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
      refuse(path, "'" + name + "' is switched on or off: write true or false");
    }
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number()) return value.dump();
    if (value.is_array()) {
      std::string all;
      for (const json& one : value) {
        if (!one.is_number())
          refuse(path,
                 "holds something else than numbers: a value of several numbers is [0.3, 0.94]");
        all += (all.empty() ? "" : ",") + one.dump();
      }
      if (!all.empty()) return all;
    }
    refuse(path, "is neither text nor a number");
  }

  /// Every field of an object with its values; `order` has their order in the file. Without
  /// `lists` a field has one value, and a list is one of several numbers.
  std::map<std::string, std::vector<field>> values_of(const json& object, const std::string& path,
                                                      std::vector<std::string>* order = nullptr,
                                                      bool lists = true) {
    if (!object.is_object()) refuse(path, "is no object: write {\"technique\": …, …}");
    if (object.empty()) refuse(path, "names no field");
    std::map<std::string, std::vector<field>> all;
    for (const auto& [key, value] : object.items()) {
      const std::string at = path + "/" + key;
      const std::string name = names_.first(file_, at, key);
      std::vector<field>& values = all[name];
      if (!values.empty()) refuse(at, "is the field '" + name + "' again: keep one of them");
      if (order != nullptr) order->push_back(name);
      const auto take = [&](const json& one, const std::string& where) {
        const field f{name, text_of(name, one, where), where};
        if (std::find(values.begin(), values.end(), f) != values.end())
          refuse(where, "stands in this list twice: once is enough");
        check(f);
        values.push_back(f);
      };
      lists ? each(value, at, take) : take(value, at);
      if (values.empty()) refuse(at, "is an empty list: give it a value, or leave it out");
    }
    return all;
  }

  /// Refuses a value that no cell could have, where it stands.
  void check(const field& f) {
    if (f.name == "layers" || f.name == "splits") {  // checked with the others: one needs the other
      cell_of({{"techniques", "lvsm", ""}, {"formats", "exact", ""}, f}, f.path, false);
      return;
    }
    fields alone{f};
    if (f.name != "techniques") alone.push_back({"techniques", "vsm", ""});
    if (f.name != "formats") alone.push_back({"formats", "exact", ""});
    alone.push_back({"layers", "1", ""});
    cell_of(alone, f.path, false);
  }

  /// The cell of these fields and the shared arguments.
  asked_cell cell_of(const fields& own, const std::string& path, bool described) {
    std::vector<std::string> arguments;
    const auto is_own = [&](const std::string& name) {
      return std::any_of(own.begin(), own.end(), [&](const field& f) { return f.name == name; });
    };
    for (const std::string& argument : shared_) {
      const std::string name = argument.substr(2, argument.find('=') - 2);
      if (!is_own(name)) arguments.push_back(argument);
    }
    for (const field& f : own) {
      if (!names_.is_flag(f.name))
        arguments.push_back("--" + f.name + "=" + f.value);
      else if (f.value == "true")
        arguments.push_back("--" + f.name);
    }
    try {
      CLI::App app;
      const auto options = add_study_options(app, {});
      std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
      app.parse(reversed);
      const std::vector<configuration> all = options->cells();
      if (all.size() != 1)
        throw usage_error(
            "is " + std::to_string(all.size()) +
            " cells: write [\"a\", \"b\"] instead of \"a,b\", and give every cell one "
            "technique, one format and one layer count");
      if (described) mark_used(own, all.front());
      std::string text;
      for (const std::string& argument : arguments) {
        const std::string name = argument.substr(2, argument.find('=') - 2);
        if (is_used(name, all.front())) text += " " + shell_quoted(argument);
      }
      return {all.front(), text};
    } catch (const CLI::ParseError& e) {
      refuse(path, e.what());
    } catch (const usage_error& e) {
      std::string cell;
      for (const field& f : own) cell += (cell.empty() ? "" : ", ") + f.name + " " + f.value;
      refuse(path, (described ? "the cell of " + cell + ": " : "") + e.what());
    }
  }

  /// Keeps which values, by their place in the file, change anything in some cell.
  void mark_used(const fields& own, const configuration& c) {
    for (const field& f : own) {
      auto& use = fields_.try_emplace(f.path, f.name, false).first->second;
      use.second = use.second || is_used(f.name, c) || f.value == "false" ||
                   (f.name == "layers" && f.value == "1");
    }
  }

  void add(const asked_cell& cell) {
    if (keys_.insert(cell.what.key()).second) cells_.push_back(cell);
  }

  bool excluded(const fields& own) {
    bool out = false;
    for (exclusion& e : exclusions_) {
      const bool hit = std::all_of(e.values.begin(), e.values.end(), [&](const auto& wanted) {
        return std::any_of(own.begin(), own.end(), [&](const field& f) {
          const auto& list = wanted.second;
          return std::find(list.begin(), list.end(), f) != list.end();
        });
      });
      e.used = e.used || hit;
      out = out || hit;
    }
    return out;
  }

  void multiply(const json& product, const std::string& path) {
    std::vector<std::string> order;
    const auto lists = values_of(product, path, &order);
    std::vector<std::size_t> at(order.size(), 0);
    for (;;) {
      fields own;
      for (std::size_t i = 0; i < order.size(); ++i) own.push_back(lists.at(order[i])[at[i]]);
      if (!excluded(own)) add(cell_of(own, path, true));
      std::size_t i = order.size();
      while (i > 0 && ++at[i - 1] == lists.at(order[i - 1]).size()) at[--i] = 0;
      if (i == 0) return;
    }
  }

  void single(const json& object, const std::string& path) {
    fields own;
    for (const auto& [name, list] : values_of(object, path, nullptr, false))
      own.push_back(list.front());
    add(cell_of(own, path, true));
  }

  /// Cells of one exact twin together, each group where its first cell stood.
  std::vector<asked_cell> side_by_side() const {
    std::map<std::string, std::size_t> groups;
    std::vector<std::vector<asked_cell>> grouped;
    for (const asked_cell& cell : cells_) {
      configuration twin = cell.what;
      twin.format = "exact";
      const auto [group, added] = groups.emplace(twin.key(), grouped.size());
      if (added) grouped.emplace_back();
      grouped[group->second].push_back(cell);
    }
    std::vector<asked_cell> all;
    for (const auto& group : grouped) all.insert(all.end(), group.begin(), group.end());
    return all;
  }

  std::string file_;
  std::vector<std::string> shared_;
  option_names names_;
  std::vector<exclusion> exclusions_;
  std::vector<asked_cell> cells_;
  std::set<std::string> keys_;
  std::map<std::string, std::pair<std::string, bool>> fields_;  ///< name, and whether it is used
};

}  // namespace

std::vector<asked_cell> read_grid(const std::string& file, const std::vector<std::string>& shared) {
  return grid(file, shared).cells();
}

}  // namespace bitshade::command
