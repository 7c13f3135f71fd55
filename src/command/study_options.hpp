// The options that say what is to be computed: shared by study, render and plan.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bitshade/study/configuration.hpp"

namespace CLI {
class App;
}

namespace bitshade::command {

/// Techniques, formats and layer counts as lists, the other parameters once for all.
struct study_options {
  std::string techniques = "vsm,lvsm";
  std::string formats = "unorm16,half,binary32,exact";
  std::string layers = "1,2,4";
  bool layers_given = false;
  std::string splits = "uniform";
  configuration common;  ///< everything that is not a list
  const CLI::App* app = nullptr;  ///< whose options they are

  /// Every technique in every layer count (where it has layers) and every format, in that order;
  /// cells that share all but the format stand side by side.
  /// Failure  usage_error with one sentence where a name is unknown or two options contradict.
  std::vector<configuration> cells() const;
};

/// The techniques of a --techniques list.
/// Failure  usage_error for a name that is unknown or there twice.
std::vector<technique> techniques_of(const std::string& list);

/// Adds --techniques, --formats, --layers, --splits, --overlap, --blur, --min-variance and the
/// finer ones; the defaults that `initial` holds are shown in the help.
std::shared_ptr<study_options> add_study_options(CLI::App& app, const study_options& initial);

/// The arguments of this run as a shell reads them back, without those that `left_out` names.
std::string arguments_of(const CLI::App& app, const std::vector<std::string>& left_out);

/// The same without those that are not used by `c` (option_use.hpp), which a run of it refuses.
std::string arguments_of(const CLI::App& app, std::vector<std::string> left_out,
                         const configuration& c);

}  // namespace bitshade::command
