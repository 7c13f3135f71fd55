// Which stage is guilty of how much of a format's error.
#pragma once

#include <vector>

#include "bitshade/study/measures.hpp"
#include "run/stages.hpp"

namespace bitshade {

/// One stage, alone in the format and alone exact.
struct stage_blame {
  stage which = stage::store;
  error_figures alone;             ///< this stage in the format, the others exact
  error_figures without;           ///< this stage exact, the others in the format
  std::vector<double> visibility;  ///< alone
};

/// All against the run in which no stage is in the format.
struct blame {
  error_figures whole;  ///< every stage in the format
  std::vector<double> visibility, exact;
  std::vector<stage_blame> stages;

  /// A stage's part of the summed squares of all stages alone; errors that are independent add so.
  double share(const stage_blame& s) const {
    double sum = 0;
    for (const auto& one : stages) sum += one.alone.rmse * one.alone.rmse;
    return sum > 0 ? s.alone.rmse * s.alone.rmse / sum : 0;
  }
  const stage_blame& guiltiest() const;
};

/// 2 + 2 runs a stage; `choices.in_format` is not read.
///
/// Failure  as run_staged(); usage_error where the stages together are not the plain run bit for
///          bit, since the configuration then does something that no stage stands for.
blame blame_of(const frame& scene, const configuration& how, const stage_choices& choices,
               int threads = 0);

}  // namespace bitshade
