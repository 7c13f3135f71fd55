#include "run/listing.hpp"

#include "io/text.hpp"

namespace bitshade {
namespace {

using json = nlohmann::ordered_json;

json lists(const row& r) {
  json effects = json::array();
  for (const effect& e : r.effects)
    effects.push_back(
        {{"name", e.name}, {"asked", e.asked}, {"needed", e.needed}, {"evidence", e.evidence}});
  return {{"splits", r.splits}, {"effects", effects}, {"notes", r.notes}};
}

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

template <class T>
std::string cell_text(const T& value) {
  if constexpr (std::is_same_v<T, std::string>)
    return quoted(value);
  else if constexpr (std::is_same_v<T, double>)
    return shortest(value);
  else
    return std::to_string(value);
}

}  // namespace

json to_json(const row& r) {
  json object = json::object();
  each_column(
      r, [&](const std::string& name, column_kind, const auto& value) { object[name] = value; });
  object.update(lists(r));
  return object;
}

std::string to_csv(std::span<const row> rows) {
  const row head;
  std::string out, line;
  const auto put = [&](const std::string& text) {
    if (!line.empty()) line += ',';
    line += text;
  };
  each_column(head, [&](const std::string& name, column_kind, const auto&) { put(name); });
  put("splits");
  out += line + '\n';
  for (const row& r : rows) {
    line.clear();
    each_column(r,
                [&](const std::string&, column_kind, const auto& value) { put(cell_text(value)); });
    std::string splits;
    for (const double s : r.splits) splits += (splits.empty() ? "" : " ") + shortest(s);
    put(splits);
    out += line + '\n';
  }
  return out;
}

std::string lists_of(const row& r) { return lists(r).dump(); }

void from_lists(const std::string& text, row& r) {
  const json object = json::parse(text);
  r.splits = object.at("splits").get<std::vector<double>>();
  r.notes = object.at("notes").get<std::vector<std::string>>();
  r.effects.clear();
  for (const json& e : object.at("effects"))
    r.effects.push_back({e.at("name"), e.at("asked"), e.at("needed"), e.at("evidence")});
}

}  // namespace bitshade
