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

/// Counts what an active set consists of.
struct Dimensions {
  Index unknowns = 0;     ///< entries of x: those of the structure, then one contact force a closed contact
  Index multipliers = 0;  ///< of the unknowns of K the last ones. Each adds one negative eigenvalue to K, which the
                          ///< stability count leaves out; their diagonal of K is 0 or negative
  Index bounds = 0;       ///< validity bounds: guards that follow those of the contacts (see System)
};

/// Defines the distance of states with one active set, of which the path metric consists.
struct StateMetric {
  Vector weights{};  ///< w ≥ 0, an entry an unknown: Σ w_i x_i² is dimensionless; 0 for multipliers
  double squared_motion_by_lambda = 0.0;  ///< of supports, obstacles and expanding members by a unit of λ
  /// For each unknown the number of its rotation set, or −1. F is unchanged if all unknowns of a set grow by 2π. Empty
  /// if there are no sets; the entries of multipliers may be missing.
  std::vector<Index> turning_sets{};
};

/// Defines equilibrium equations F(x, λ) = 0 that are smooth for each active set: the first of three levels of a
/// system.
///
/// Equations without contact have one active set, the empty ActiveSet. The entries of x have units of the
/// implementation's choice; metric() makes them dimensionless. F is internal minus external force. A unit of F_i times
/// one of x_i is an energy.
///
/// Override dimensions, residual, linearize and energy. residual() and linearize() return the same F; K, B, C and F_λ
/// are its derivatives; K is symmetric. Without multipliers F is the gradient of the energy. check_derivatives() in
/// core/derivative_check.hpp tests this. Immutable: each result depends on the arguments alone.
class Equations {
 public:
  virtual ~Equations() = default;

  /// Returns the numbers of unknowns and of the multipliers among them.
  virtual Dimensions dimensions(const ActiveSet& active_set) const = 0;

  /// Writes the residual F, size(state.active_set) entries.
  virtual void residual(const State& state, Eigen::Ref<Vector> F) const = 0;

  /// Writes F, K and F_λ. Allocates the pattern of K again if `out` was last used with another active set.
  virtual void linearize(const State& state, Linearization& out) const = 0;

  /// Returns the total potential energy: strain energy minus the work of the loads [force·length].
  virtual double energy(const State& state) const = 0;

  /// Returns how the distance of states is measured: by default by the mean square of all unknowns.
  virtual StateMetric metric(const ActiveSet& active_set) const {
    return {.weights = Vector::Ones(size(active_set)) / double(size(active_set))};
  }

  /// Returns which unstable directions the negative eigenvalues of K count.
  virtual CountedDirections counted_directions(const ActiveSet&) const { return CountedDirections::all; }

  Index size(const ActiveSet& active_set) const { return dimensions(active_set).unknowns; }
  Index multiplier_count(const ActiveSet& active_set) const { return dimensions(active_set).multipliers; }
  Vector weights(const ActiveSet& active_set) const { return metric(active_set).weights; }
};

}  // namespace arcwall
