// Which techniques an option concerns, so that none is taken and then ignored.
#pragma once

#include <string>
#include <vector>

#include "bitshade/study/configuration.hpp"

namespace CLI {
class App;
}

namespace bitshade::command {

/// What a command does with its configurations: whether it measures them against the truth, which
/// the filters shape for every technique, even for one that does not filter so.
enum class measured { against_truth, alone };

/// Whether `option` (its first long name) can change a run of `c`, or what it is measured by. True
/// of every option that is no configuration's.
bool is_used(const std::string& option, const configuration& c,
             measured how = measured::against_truth);

/// What an option is for, in words: "lvsm of several layers".
/// Failure  std::out_of_range for an option that is_used() says nothing of.
std::string users_of(const std::string& option);

/// Refuses an option that was given and concerns none of the cells; returns a note for each that
/// concerns only some of them and could be taken to concern all.
///
/// Failure  usage_error that names the option and what it is for.
std::vector<std::string> check_use(const CLI::App& app, const std::vector<configuration>& cells,
                                   measured how = measured::against_truth);

/// Prints notes on standard output, wrapped, each with "Note: " before it.
void print_notes(const std::vector<std::string>& notes);

}  // namespace bitshade::command
