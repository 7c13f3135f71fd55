// The subcommands, one file each: add_NAME() declares its options on the application and runs the
// work from CLI11's callback, throwing usage_error or failure (io/error.hpp).
#pragma once

namespace CLI {
class App;
}

namespace bitshade::command {

// (one declaration a line, in the order of --help)
void add_study(CLI::App& app);
void add_pareto(CLI::App& app);
void add_advise(CLI::App& app);
void add_merge(CLI::App& app);
void add_claims(CLI::App& app);
void add_render(CLI::App& app);
void add_plan(CLI::App& app);
void add_blame(CLI::App& app);
void add_certify(CLI::App& app);
void add_precision(CLI::App& app);
void add_depth(CLI::App& app);
void add_round(CLI::App& app);
void add_formats(CLI::App& app);
void add_sample(CLI::App& app);
void add_mipmap(CLI::App& app);
void add_convert(CLI::App& app);

/// Parses the arguments and runs the command that they name; returns the exit status:
/// 0 done, 1 it could not be done, 2 the arguments make no sense.
int run(int argc, const char* const* argv);

}  // namespace bitshade::command
