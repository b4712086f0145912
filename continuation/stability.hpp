#pragma once

#include <optional>

#include "continuation/factorized_equations.hpp"
#include "continuation/stability_count.hpp"
#include "core/unilateral_system.hpp"

namespace arcwall {

/// Negative eigenvalues of K with all contacts of the state's active set held; what a border holds gives way. Empty
/// where K is singular. Without a border also where the pivots do not tell: `nearest` are the eigenpairs nearest zero
/// that were found there.
std::optional<Index> negative_eigenvalues(const Equations& system, const State& state, const BorderedSolver& solver,
                                          const Linearization& now, const NearNull& nearest);

/// Counts. With the equations that it shares where they are on the same active set, with its own elsewhere; keeps
/// workspaces from call to call.
class StabilityCounter {
 public:
  /// `system` and `shared` must outlive this. `force_tolerance` in the scale of the guards.
  StabilityCounter(const UnilateralSystem& system, FactorizedEquations& shared, double force_tolerance,
                   const MakeFactorization& make = make_ldlt)
      : system_(system), force_tolerance_(force_tolerance), shared_(shared), own_(system, make) {}

  /// `negative_held`: the count with all closed contacts held, if it is known already.
  StabilityCount count(const State& state, std::optional<Index> negative_held);

  /// Negative eigenvalues with all contacts of the state's active set held; empty where K is singular.
  std::optional<Index> negative_on(const State& state);

  /// What was counted elsewhere: negative_on() need not count again there.
  void remember(const State& state, std::optional<Index> negative);

  /// From where the eigenpairs nearest zero are followed, instead of the state counted last. Not copied before its
  /// own equations need it: `nearest` must outlive the counts to come.
  void track_from(const NearNull& nearest);

 private:
  std::optional<Index> counted_on(const State& state);
  Index slipping(const ActiveSet& active_set) const;
  Stability stability_of_slips(const State& state);
  std::optional<Stability> stability_with_slips(const State& state);

  const UnilateralSystem& system_;
  double force_tolerance_;
  FactorizedEquations& shared_;
  FactorizedEquations own_;
  const NearNull* start_ = nullptr;     // of what its own equations follow, until they are used
  std::optional<State> last_;           // the state counted last: what pivots leave undecided takes long
  std::optional<Index> last_negative_;  // on it
};

/// The active set on which only the contacts that carry more than the tolerance are closed.
ActiveSet strictly_active(const UnilateralSystem& system, const State& state, double force_tolerance);

}  // namespace arcwall
