#include "continuation/factorized_equations.hpp"

namespace arcwall {

FactorStatus FactorizedEquations::look(const State& state) {
  arrived_ = false;
  if (!is_on(state.piece)) piece_ = state.piece;
  system_.linearize(state, now_);
  if (!all_finite(now_.F)) return FactorStatus::not_finite;
  return solver_.factorize(now_, system_.multiplier_count(state.piece));
}

FactorStatus FactorizedEquations::arrive(const State& state) {
  const FactorStatus status = look(state);
  here_ = state;
  arrived_ = status != FactorStatus::not_finite;
  return status;
}

Linearization& FactorizedEquations::workspace(const Piece& piece) {
  arrived_ = false;
  if (!is_on(piece)) piece_ = piece;
  return now_;
}

void FactorizedEquations::track_from(const NearNull& nearest) {
  tracker_.start_from(nearest.vectors);
  if (solver_.may_use_soft()) solver_.expect_soft(nearest.soft());
}

}  // namespace arcwall
