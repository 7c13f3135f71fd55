// Everything of a study that people and programs read, written into one folder.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "report/html.hpp"
#include "report/summary.hpp"

namespace bitshade {

/// The study as one JSON object: the head, then inputs with their rows.
nlohmann::ordered_json results_json(const report_head& head,
                                    const std::vector<report_section>& sections);

/// Writes results.csv, results.json, report.html and pictures/*.png, each whole or not at all.
/// Failure  throws failure with the file, the reason and the cure.
void write_results(const std::filesystem::path& folder, const report_head& head,
                   const std::vector<report_section>& sections);

/// Removes what runs that were killed left aside in the folder, unless they still run.
void sweep_leftovers(const std::filesystem::path& folder);

/// A name that any file system takes, from an input's name or path: "bunny" from "a/b/bunny.obj".
std::string file_stem(const std::string& input_name);

}  // namespace bitshade
