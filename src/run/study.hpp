// A study of one frame: every configuration run, measured, drawn and stored.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bitshade/study/configuration.hpp"
#include "bitshade/study/frame.hpp"
#include "run/database.hpp"
#include "run/progress.hpp"

namespace bitshade {

/// What is asked of a frame. Cells that share everything but the format stand side by side, so that
/// their exact reference is computed once.
struct study_request {
  std::vector<configuration> cells;
  std::string description;  ///< JSON for the database: sizes, how to reproduce
  int threads = 0;
  bool pictures = true;      ///< stored beside the figures
  bool verify_plan = false;  ///< run everything as well, and demand equal bits
  bool shaded = false;       ///< also keep pictures of the shaded scene and of its layers
  int repeats = 1;           ///< runs whose median is the time
  bool natural = false;      ///< times at the storage's natural speed as well
};

/// One cell run twice: with what the plan left, and with everything.
struct verification {
  std::string cell;
  double planned_seconds = 0;
  double everything_seconds = 0;
};

struct study_result {
  std::string input;         ///< the frame's digest
  std::vector<row> rows;     ///< one a cell, in the request's order
  std::size_t computed = 0;  ///< cells that were not in the database yet
  std::vector<verification> verified;
};

/// The digest of a frame's bits: depths, surfaces and receivers, not its name.
std::string digest_of(const frame& input);

/// "lvsm 4 unorm16"; the layers stand only where a technique has them.
std::string label_of(const configuration& c);
std::string label_of(const row& r);

/// The identity of a cell: input (its digest, and the samples that the cell reads), configuration
/// and program.
std::string cell_key(const std::string& input, const frame& scene, const configuration& c);

/// Refuses a study that would need more memory than the machine has, before it starts.
/// Failure  usage_error with what it would take, and the cure.
void check_study_memory(const frame& input, const std::vector<configuration>& cells);

/// Runs the cells that the database lacks and commits each at once. References (truths, exact
/// arithmetic) are computed only for groups with a missing cell.
///
/// Failure  failure where the database cannot take a cell, or where a plan left out an effect that
///          changes a bit.
study_result run_study(const frame& input, const study_request& request, database& results,
                       progress& bar);

}  // namespace bitshade
