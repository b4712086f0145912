#include "apps/output/exit_status.hpp"

#include <cassert>

namespace arcwall {

ExitStatus exit_status(EndReason reason) {
  switch (reason) {
    case EndReason::stop:
    case EndReason::closed_loop:
    case EndReason::joined:
    case EndReason::branched:
      return ExitStatus::success;
    case EndReason::max_points:
    case EndReason::max_time:
      return ExitStatus::limit_met;
    case EndReason::interrupted:
      return ExitStatus::interrupted;
    case EndReason::min_step:
    case EndReason::singular:
    case EndReason::not_finite:
    case EndReason::no_ray:
    case EndReason::turning_control:
    case EndReason::wall_end:
    case EndReason::continuum:
    case EndReason::unsupported:
    case EndReason::adrift:
      return ExitStatus::ended_early;
  }
  assert(false);
  return ExitStatus::internal_error;
}

}  // namespace arcwall
