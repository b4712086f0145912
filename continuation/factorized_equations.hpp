#pragma once

#include <optional>

#include "core/algebra/bordered_solver.hpp"
#include "core/algebra/near_null.hpp"
#include "core/equations.hpp"

namespace arcwall {

/// The equations at one state after another, with the factorization of K and the eigenpairs nearest zero, which are
/// followed along. Of large structures this is most of the memory: who looks at states of one active set shares it.
class FactorizedEquations {
 public:
  /// `equations` must outlive this. `make`: what K is factorized by.
  explicit FactorizedEquations(const Equations& equations, const MakeFactorization& make = make_ldlt)
      : of_(equations), solver_(make) {}

  /// Evaluates and factorizes; `not_finite` also where F is not.
  FactorStatus linearize_at(const State& state);

  /// The same, and knows the state again: what is asked from here on is of this one.
  FactorStatus set_point(const State& state);

  /// Whether nothing was looked at or evaluated since a state was arrived at.
  bool has_point() const { return arrived_; }

  /// And whether that is this one.
  bool is_at(const State& state) const { return arrived_ && here_ == state; }

  /// Whether the matrix at hand has the pattern of this active set, so that its analysis serves again.
  bool is_on(const ActiveSet& active_set) const { return active_set_ == active_set; }

  Linearization& equations() { return now_; }
  const Linearization& equations() const { return now_; }
  BorderedSolver& solver() { return solver_; }
  const BorderedSolver& solver() const { return solver_; }
  NearNullTracker& tracker() { return tracker_; }
  const NearNullTracker& tracker() const { return tracker_; }

  /// The equations alone, to be evaluated at other states of an active set: nothing is factorized or arrived at then.
  Linearization& workspace(const ActiveSet& active_set);

  /// From where the eigenpairs nearest zero are followed.
  void track_from(const NearNull& nearest);

 private:
  const Equations& of_;
  Linearization now_;
  BorderedSolver solver_;
  NearNullTracker tracker_;
  std::optional<ActiveSet> active_set_;  // of the matrix
  State here_;
  bool arrived_ = false;
};

}  // namespace arcwall
