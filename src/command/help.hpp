// Help pages of 80 columns, and sentences for arguments that make no sense.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

namespace bitshade::command {

/// CLI11's formatter with options and descriptions wrapped to 80 columns.
std::shared_ptr<CLI::FormatterBase> help_formatter();

/// What was wrong with the arguments, in one sentence, with the nearest known name.
std::string explain(const CLI::App& app, int argc, const char* const* argv,
                    const CLI::ParseError& e);

}  // namespace bitshade::command
