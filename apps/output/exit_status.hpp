#pragma once

#include <vector>

#include "continuation/path_point.hpp"
#include "model/record.hpp"

namespace arcwall {

/// What the program returns to the shell.
enum class ExitStatus {
  success = 0,
  internal_error = 1,
  wrong_input = 2,  ///< the command line or the deck
  ended_early = 3,  ///< a branch, by one of a closed list of reasons
  no_start = 4,     ///< no equilibrium
  file_error = 5,
  limit_met = 6,      ///< on points or time
  not_confirmed = 7,  ///< what a run says does not hold
  out_of_memory = 8,
  interrupted = 130,
};

/// The status of a run whose branch ended so.
ExitStatus exit_status(EndReason reason);

/// The branch whose end decides the status of a run that has ended: an interrupt, then a limit, then an early end.
/// Early ends of branches that a search has found do not count.
const RecordBranch& decisive_branch(const Record& record);

/// The found branches that ended early.
std::vector<Index> found_that_ended_early(const Record& record);

/// The status of a run that has ended.
ExitStatus exit_status(const Record& record);

}  // namespace arcwall
