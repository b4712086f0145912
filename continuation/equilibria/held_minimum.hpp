#pragma once

#include <memory>
#include <optional>

#include "core/algebra/factorization.hpp"
#include "core/linearization.hpp"
#include "core/unilateral_system.hpp"

namespace arcwall {

/// Minima of the potential Π among the obstacles at fixed λ, near a given state, by Newton's method with a primal-dual
/// active set (Hintermüller, Ito, Kunisch 2003).
///
/// Each is empty if there is no minimum near, if the way to it is not convex, or if the allowed work is done.
/// Changes no state but its own workspace.
class HeldMinimum {
 public:
  /// `factorizations`: that it may make; decreased by those it makes. `system` and the number must outlive this.
  HeldMinimum(const UnilateralSystem& system, const MakeFactorization& make, Index& factorizations);

  /// Returns the minimum of Π. Newton's method ends at a correction of `arrived` [path metric].
  std::optional<State> free(const State& start, double arrived);

  /// Returns the minimum of Π if a degree of freedom keeps its value.
  std::optional<State> with_held(Index dof, const State& start, double arrived);

  /// Returns the minimum of Π + ½ μ |x − start|²_W, to a twentieth of the motion. Also empty if the linear equations at
  /// the start do not predict it to half its length. So the motion is short against the distance at which stiffness
  /// changes, whichever part of the structure moves.
  std::optional<State> with_drag(double mu, const State& start);

 private:
  struct Hold {
    double mu = 0.0;
    std::optional<Index> dof{};
    double arrived = 0.0;
  };
  std::optional<State> find(const State& start, const Hold& hold);
  bool newton(const State& from, const Hold& hold, State& state);
  std::optional<Vector> correction(const State& from, const Hold& hold, const State& state, const Vector& weights);
  std::optional<ActiveSet> next_active_set(const State& state, int change) const;

  const UnilateralSystem& system_;
  Linearization now_;
  LastPattern pattern_;  // of the matrix factorized
  std::unique_ptr<Factorization> solver_;
  Index& left_;
};

/// Returns the length of the motion of the structure between two states of one active set [path metric].
double motion_between(const UnilateralSystem& system, const State& a, const State& b);

/// Returns the length of a change of x, without multipliers, in the weights of the path metric.
double motion(const Vector& weights, Index multipliers, const Vector& change);

}  // namespace arcwall
