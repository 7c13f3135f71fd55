// An option whose value is one of a few names, in the order of an enum.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <string>

#include "io/error.hpp"
#include "io/nearest.hpp"

namespace bitshade::command {

/// Adds an option that sets `value` to the enumerator of the name given.
/// Failure  usage_error with the nearest name where there is no such one.
template <class Enum, class Names>
CLI::Option* add_named_option(CLI::App& app, const std::string& option, Enum& value,
                              const Names& names, const std::string& meaning) {
  return app
      .add_option_function<std::string>(
          option,
          [option, &value, &names](const std::string& name) {
            const auto at = std::find(names.begin(), names.end(), name);
            if (at == names.end())
              throw usage_error(option + ": there is no '" + name + "'; " + suggest(name, names));
            value = static_cast<Enum>(at - names.begin());
          },
          meaning)
      ->default_str(std::string(names[static_cast<std::size_t>(value)]))
      ->option_text("NAME");
}

}  // namespace bitshade::command
