#include "report/folder.hpp"

#include <signal.h>

#include <cerrno>
#include <charconv>
#include <set>

#include "io/atomic_file.hpp"
#include "io/text.hpp"
#include "report/labels.hpp"
#include "run/listing.hpp"

namespace bitshade {
namespace {

namespace fs = std::filesystem;
using json = nlohmann::ordered_json;

/// ".NAME.PID.SERIAL.part" and ".bitshade.PID.probe": the process that wrote it, or 0.
int writer_of(const std::string& name) {
  if (!name.starts_with('.')) return 0;
  const std::vector<std::string> parts = split(name, '.');
  std::size_t at = 0;
  if (parts.size() >= 4 && parts.back() == "part") at = parts.size() - 3;
  if (parts.size() == 4 && parts[1] == "bitshade" && parts.back() == "probe") at = 2;
  int pid = 0;
  if (at != 0) {
    const std::string& text = parts[at];
    std::from_chars(text.data(), text.data() + text.size(), pid);
  }
  return pid;
}

}  // namespace

std::string file_stem(const std::string& input_name) {
  std::string out;
  for (const char c : fs::path(input_name).stem().string()) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '-' || c == '_';
    out += plain ? c : '_';
  }
  return out.empty() ? "input" : out;
}

json results_json(const report_head& head, const std::vector<report_section>& sections) {
  json out{{"program", "bitshade"},   {"version", head.version}, {"compiler", head.compiler},
           {"machine", head.machine}, {"command", head.command}, {"inputs", json::array()},
           {"rows", json::array()}};
  if (!head.seed.empty()) out["seed"] = head.seed;
  for (const report_section& s : sections) {
    json input{{"digest", s.input.digest}, {"name", s.input.name}, {"command", s.command}};
    const auto info = json::parse(s.input.description, nullptr, false);
    if (info.is_object()) input.update(info);
    input["findings"] = findings(s.rows);
    for (const report_part& part : s.parts)
      if (!part.data.empty()) input["parts"][part.name] = json::parse(part.data);
    out["inputs"].push_back(input);
    for (const row& r : s.rows) out["rows"].push_back(to_json(r));
  }
  return out;
}

void write_results(const fs::path& folder, const report_head& head,
                   const std::vector<report_section>& sections) {
  const fs::path pictures = folder / "pictures";
  make_output_folder(pictures);
  std::vector<row> rows;
  std::set<std::string> stems;
  for (const report_section& s : sections) {
    std::string stem = file_stem(s.input.name);
    if (!stems.insert(stem).second) stem.append("-").append(s.input.digest, 0, 8);
    stems.insert(stem);
    for (const auto& [kind, png] : s.pictures)
      write_file(pictures / (stem + "-" + kind + ".png"), png);
    const std::vector<std::string> settings = settings_of(s.rows);
    for (std::size_t i = 0; i < s.rows.size(); ++i) {
      const row& r = s.rows[i];
      rows.push_back(r);
      const auto files = s.cells.find(r.key);
      if (files == s.cells.end()) continue;
      const std::string layers = r.technique == "lvsm" ? std::to_string(r.layers) : "";
      const std::string other = settings[i].empty() ? "" : "-" + r.key.substr(0, 8);
      for (const auto& [kind, png] : files->second)
        write_file(pictures / (stem + "-" + r.technique + layers + "-" + r.format + other + "-" +
                               kind + ".png"),
                   png);
    }
  }
  write_file(folder / "results.csv", to_csv(rows));
  write_file(folder / "results.json", results_json(head, sections).dump(1) + "\n");
  write_file(folder / "report.html", html_report(head, sections));
}

void sweep_leftovers(const fs::path& folder) {
  std::error_code ignored;
  for (const fs::path& place : {folder, folder / "pictures"})
    for (const fs::directory_entry& entry : fs::directory_iterator(place, ignored)) {
      const int pid = writer_of(entry.path().filename().string());
      if (pid > 0 && ::kill(pid, 0) != 0 && errno == ESRCH) fs::remove(entry.path(), ignored);
    }
}

}  // namespace bitshade
