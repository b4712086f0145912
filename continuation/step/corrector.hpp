#pragma once

#include <optional>

#include "continuation/factorized_equations.hpp"
#include "continuation/metric.hpp"
#include "continuation/step/corrector_options.hpp"
#include "continuation/step/path_constraint.hpp"

namespace arcwall {

enum class CorrectorStatus { converged, too_many_iterations, diverged, complex_roots, singular, not_finite };

struct CorrectorResult {
  CorrectorStatus status = CorrectorStatus::too_many_iterations;
  State state{};                    ///< the last iterate, also when not converged
  Direction tangent{};              ///< unit tangent there, of either orientation; only when converged
  std::optional<Index> negative{};  ///< eigenvalues of K below zero with all closed contacts held; empty: the pivots do
                                    ///< not tell, count_here() may
  NearNull nearest{};               ///< estimates of the eigenpairs nearest zero, at most two; none where K is singular
  int iterations = 0;
  std::optional<ConstraintRoots> roots{};  ///< of the last correction
  bool contracts = true;                   ///< no correction was longer than the one before it, the first aside
  double unsettled = 0.0;                  ///< the last correction, where that is round-off [path metric]
  double residual = 0.0;                   ///< ‖F‖ over the load's norm at max(|λ|, load_floor) [-]

  bool converged() const { return status == CorrectorStatus::converged; }
};

/// What is asked of a point that Newton's method arrives at: the tangent alone, or the eigenpairs nearest zero and
/// their count, too.
enum class Wanted { tangent, pairs };

/// Newton's method on the closed system, whatever closes it. Keeps factorization and workspaces from call to call.
class Corrector {
 public:
  /// `system` must outlive this. `load_floor`: |λ| below which loads count as this large in the relative residual.
  Corrector(const Equations& system, const CorrectorOptions& options, double load_floor,
            const MakeFactorization& make = make_ldlt)
      : system_(system), options_(options), load_floor_(load_floor), here_(system, make) {}

  /// From `guess` to F = 0, c = 0. `length` is the distance from the guess to the last point known, `along` the tangent
  /// there, which closes the system where K is singular.
  CorrectorResult correct(State guess, const PathConstraint& constraint, const Metric& metric, const Direction& along,
                          double length, Wanted wanted = Wanted::pairs);

  /// The same from a guess of another shape than the solution, which may be long in coming: where next to nothing
  /// resists some change, the first corrections follow the guess's errors. They may grow for a while.
  CorrectorResult correct_patiently(State guess, const PathConstraint& constraint, const Metric& metric,
                                    const Direction& along, double length);

  /// The eigenpairs of a point that was found without them, and their count; the rest of the result is not there.
  CorrectorResult find_pairs(const State& state, const Metric& metric);

  /// Eigenpairs nearest zero of K at the state reached last, which is `here`, with what a border holds let go; empty
  /// where K is singular to working precision.
  std::optional<NearNull> near_null(const State& here, const Vector& weights, Index count,
                                    Convergence convergence = Convergence::tight) const;

  /// K⁻¹ times the columns, K at the state reached last; empty where it is singular to working precision.
  std::optional<Matrix> responses(Matrix columns) const;

  /// The left null vector of ∂F/∂x that goes with a null vector that near_null() gave. At the state reached last.
  Vector left_null(const Vector& vector) const;

  /// The right null vector of ∂F/∂x that goes with a left one, where both exist nearly: the same unless there is a
  /// border. At the state reached last.
  std::optional<Vector> right_null(const Vector& left);

  /// J⁻¹ f with no part along the row, at a branch point whose critical mode is not orthogonal to it, where f does no
  /// work along the mode. At the state reached last.
  std::optional<Vector> response_across(const Row& row, const Vector& f);

  /// Tangent and signs at a state that is already on the path.
  CorrectorResult inspect(const State& state, const Metric& metric, const Direction& along);

  /// Negative eigenvalues of K at the state reached last, which is `here`, as CorrectorResult::negative, but also where
  /// the pivots do not tell; `nearest`: the pairs that were found there. Empty where K is singular.
  std::optional<Index> count_here(const State& here, const NearNull& nearest) const;

  /// Whether this is the state reached last.
  bool is_at(const State& state) const { return here_.is_at(state); }

  /// From where the eigenpairs nearest zero are followed, instead of the point reached last.
  void track_from(const NearNull& nearest) { here_.track_from(nearest); }

  /// The equations at the state reached last, for others to use; what is asked of that state is asked before.
  FactorizedEquations& factorized() { return here_; }

 private:
  CorrectorResult iterate(State guess, const PathConstraint& constraint, const Metric& metric, const Direction& along,
                          double length, const CorrectorOptions& options, Wanted wanted);
  bool find_line(const Metric& metric, const Row& border);
  double take_step(const Metric& metric, double tau, State& state) const;
  void add_pairs(const State& here, const Metric& metric, const Eigen::Ref<const Matrix>& solved,
                 CorrectorResult& result);
  CorrectorResult arrived(CorrectorResult result, const Metric& metric, const Row& border, Wanted wanted);

  const Equations& system_;
  CorrectorOptions options_;
  double load_floor_;
  FactorizedEquations here_;
  EquilibriumLine line_;
};

}  // namespace arcwall
