// What a study adds to its report on request: which stage is guilty, and how many bits are needed.
#pragma once

#include <string>
#include <vector>

#include "command/study_job.hpp"

namespace bitshade::command {

/// The configuration with the largest format error (of those that `blame` can take apart), stage by
/// stage.
/// Failure  usage_error where no configuration of the study can be taken apart.
report_part blamed(const study_job& job, const job_result& result, std::size_t input);

/// Bits against layers, for the study's layers and floor: by the bound, on adversarial footprints,
/// and, for the store, on the input; for a SAT-VSM its store, its running sums, its shading and all
/// of them, on the input.
/// Failure  usage_error where the study has no VSM, LVSM or SAT-VSM, or where its floor is none.
std::vector<report_part> bits_needed(const study_job& job, const job_result& result,
                                     std::size_t input);

}  // namespace bitshade::command
