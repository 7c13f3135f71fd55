// From an encoding and its rules to the numbers that kernels run on.
#pragma once

#include "bulk/plan.hpp"

namespace bitshade::bulk {

/// Fills every field but `define`, in a few integer operations.
void make_plan(bulk_kernels::plan& p, const encoding& e, const rules& r, std::uint64_t seed, std::uint64_t first_counter);

/// The same plan for the elements from `offset` on.
void advance(bulk_kernels::plan& p, std::uint64_t offset);

}  // namespace bitshade::bulk
