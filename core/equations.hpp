#pragma once

#include <vector>

#include "core/linearization.hpp"
#include "core/state.hpp"

namespace arcwall {

/// Which unstable directions of a system the negative eigenvalues of K count.
enum class CountedDirections {
  all,
  some,  ///< the second variation vanishes in others, so that stability is indeterminate
  none,  ///< no branch points are searched for either; an example is the equations of an event that is followed
};

/// Defines equilibrium equations F(x, λ) = 0 that are smooth for each active set: the first of three levels of a
/// system.
///
/// Equations without contact have one active set, the empty ActiveSet. x has size(active_set) entries, in units of the
/// implementation's choice; weights() makes them dimensionless. F is internal minus external force. A unit of F_i times
/// one of x_i is an energy.
///
/// Override size, residual, linearize and energy. residual() and linearize() return the same F; K, B, C and F_λ are its
/// derivatives; K is symmetric. Without multipliers F is the gradient of the energy. check_derivatives() in
/// core/derivative_check.hpp tests this. Immutable: each result depends on the arguments alone.
class Equations {
 public:
  virtual ~Equations() = default;

  /// Returns the number of unknowns: those of the structure, then one contact force a closed contact.
  virtual Index size(const ActiveSet& active_set) const = 0;

  /// Writes the residual F, size(state.active_set) entries.
  virtual void residual(const State& state, Eigen::Ref<Vector> F) const = 0;

  /// Writes F, K and F_λ. Allocates the pattern of K again if `out` was last used with another active set.
  virtual void linearize(const State& state, Linearization& out) const = 0;

  /// Returns the total potential energy: strain energy minus the work of the loads [force·length].
  virtual double energy(const State& state) const = 0;

  /// Returns the weights w of the path metric: Σ w_i x_i² is dimensionless. size(active_set) entries, ≥ 0, and 0 for
  /// multipliers.
  virtual Vector weights(const ActiveSet& active_set) const {
    return Vector::Ones(size(active_set)) / double(size(active_set));
  }

  /// Returns the squared length, in that metric, by which a unit of λ moves supports and obstacles or expands members.
  virtual double squared_motion_by_lambda(const ActiveSet&) const { return 0.0; }

  /// Returns for each unknown the number of its rotation set, or −1. F is unchanged if all unknowns of a set grow by
  /// 2π. Empty if there are no sets; the entries of multipliers may be missing.
  virtual std::vector<Index> turning_sets(const ActiveSet&) const { return {}; }

  /// Returns the number of Lagrange multipliers, the last unknowns of K. Their diagonal of K is 0 or negative. Each
  /// adds one negative eigenvalue to K, which the stability count leaves out.
  virtual Index multiplier_count(const ActiveSet&) const { return 0; }

  /// Returns which unstable directions the negative eigenvalues of K count.
  virtual CountedDirections counted_directions(const ActiveSet&) const { return CountedDirections::all; }
};

}  // namespace arcwall
