#include "continuation/factorized_equations.hpp"

namespace arcwall {

FactorStatus FactorizedEquations::linearize_at(const State& state) {
  of_.linearize(state, workspace(state.active_set));
  if (!all_finite(now_.F)) return FactorStatus::not_finite;
  return solver_.factorize(now_, of_.multiplier_count(state.active_set));
}

FactorStatus FactorizedEquations::set_point(const State& state) {
  const FactorStatus status = linearize_at(state);
  here_ = state;
  arrived_ = status != FactorStatus::not_finite;
  return status;
}

Linearization& FactorizedEquations::workspace(const ActiveSet& active_set) {
  arrived_ = false;
  if (!is_on(active_set)) active_set_ = active_set;
  return now_;
}

void FactorizedEquations::track_from(const NearNull& nearest) {
  tracker_.start_from(nearest.vectors);
  if (solver_.may_use_near_null()) solver_.expect_near_null(nearest.least_resisted());
}

}  // namespace arcwall
