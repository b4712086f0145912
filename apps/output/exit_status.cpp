#include "apps/output/exit_status.hpp"

#include <algorithm>
#include <cassert>

#include "answers/search.hpp"

namespace arcwall {

ExitStatus exit_status(EndReason reason) {
  switch (reason) {
    case EndReason::stop:
    case EndReason::closed_loop:
    case EndReason::reached_branch:
    case EndReason::switched_branch:
    case EndReason::jumped:
      return ExitStatus::success;
    case EndReason::max_points:
    case EndReason::max_time:
      return ExitStatus::limit_met;
    case EndReason::interrupted:
      return ExitStatus::interrupted;
    case EndReason::min_step:
    case EndReason::singular:
    case EndReason::not_finite:
    case EndReason::no_continuation:
    case EndReason::control_turns:
    case EndReason::wall_end:
    case EndReason::equilibrium_family:
    case EndReason::not_modelled:
    case EndReason::rigid_body_motion:
    case EndReason::jammed:
    case EndReason::unstable:
      return ExitStatus::ended_early;
  }
  assert(false);
  return ExitStatus::internal_error;
}

const RecordBranch& decisive_branch(const Record& record) {
  const auto severity = [&](const RecordBranch& branch) {
    switch (exit_status(branch.end->reason)) {
      case ExitStatus::interrupted:
        return 3;
      case ExitStatus::limit_met:
        return 2;
      case ExitStatus::success:
        return 0;
      case ExitStatus::ended_early:  // what was found beside the paths is more than was asked for
        return comes_of_search(record, branch) ? 0 : 1;
      case ExitStatus::internal_error:
      case ExitStatus::wrong_input:
      case ExitStatus::no_start:
      case ExitStatus::file_error:
      case ExitStatus::not_confirmed:
      case ExitStatus::out_of_memory:
        return 1;
    }
    return 1;
  };
  return *std::max_element(record.branches.begin(), record.branches.end(),
                           [&](const RecordBranch& a, const RecordBranch& b) { return severity(a) < severity(b); });
}

std::vector<Index> found_that_ended_early(const Record& record) {
  std::vector<Index> branches;
  for (const RecordBranch& branch : record.branches)
    if (comes_of_search(record, branch) && branch.end && exit_status(branch.end->reason) == ExitStatus::ended_early)
      branches.push_back(branch.id);
  return branches;
}

ExitStatus exit_status(const Record& record) { return exit_status(decisive_branch(record).end->reason); }

}  // namespace arcwall
