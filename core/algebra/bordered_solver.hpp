#pragma once

#include <Eigen/LU>
#include <optional>
#include <utility>

#include "core/algebra/factorization.hpp"
#include "core/algebra/last_pattern.hpp"
#include "core/algebra/singular_bordered_solver.hpp"
#include "core/algebra/unsymmetric_factors.hpp"
#include "core/equilibrium_line.hpp"
#include "core/linearization.hpp"

namespace arcwall {

/// ∂F/∂x times the columns of X.
Matrix product(const Linearization& equations, const Matrix& X);

/// Solves with J = ∂F/∂x and with J bordered by F_λ and a row, by block elimination with one LDLᵀ factorization of K:
///
///     [ J   F_λ ] [δx]   [f]            [ K  B ]
///     [ cᵀ   d  ] [δλ] = [g],       J = [   C  ]
///
/// Where K is singular (limit points, branch points) the elimination loses digits: the result is checked, refined, and
/// at worst taken from a factorization that does not need K's.
class BorderedSolver {
 public:
  explicit BorderedSolver(const MakeFactorization& make = make_ldlt) : make_(make), inner_(make()), whole_(make) {}

  /// `equations` must outlive the use of this factorization. `singular` still allows bordered solves, for which a
  /// spring may stand in K for a moment (SingularBorderedSolver).
  FactorStatus factorize(Linearization& equations, Index multipliers);

  /// See Factorization.
  void expect_near_null(const Matrix& vectors) { inner_->expect_near_null(vectors); }
  bool may_use_near_null() const { return inner_->may_use_near_null(); }

  /// `border` closes the system where K alone is singular; the line itself does not depend on it. Its columns are the
  /// particular solution and the tangent, which is not normalised. `weights`: those of System; what they make of the
  /// columns is found by the way.
  /// Empty if the bordered matrix is singular too.
  std::optional<LineProducts> line(const Row& border, const Vector& weights, EquilibriumLine& out);

  /// The tangent of the line alone, not normalised. Column 0 of `columns` is a workspace, the others become K⁻¹ times
  /// themselves by the way, unchecked; none of them is left where K is singular. False if the bordered matrix is
  /// singular too.
  bool tangent(const Row& border, Direction& out, Matrix& columns);

  /// Solution of the bordered system for one right-hand side (f, g), with column F_λ; empty if it is singular.
  std::optional<Direction> solve(const Row& border, const Vector& f, double g);

  /// J⁻¹ X in place; false where J is singular to working precision.
  bool solve_inner(Matrix& X) const;

  /// The factorization of K alone.
  const Factorization& inner() const { return *inner_; }

  /// What makes such factorizations.
  const MakeFactorization& make() const { return make_; }

  bool inner_is_regular() const { return regular_; }

  /// C_x K⁻¹ B − C_s, what is left for the border's unknowns where K is regular.
  const Matrix& reduced() const { return reduced_; }

 private:
  bool eliminate_border();
  bool solve_inner(Matrix& X, double& cancelled) const;
  bool solve_line(EquilibriumLine& line, double& cancelled);
  bool is_suspicious(double cancelled) const;
  bool cancellation_is_small(const Row& border, const Matrix& X, const LineProducts& found) const;
  bool make_line_good(const Row& border, EquilibriumLine& line);
  bool make_tangent_good(Eigen::Ref<Vector> tangent) const;
  void factorize_whole(const Row& border, const Matrix& columns);

  Linearization* equations_ = nullptr;
  LastPattern pattern_;
  MakeFactorization make_;
  std::unique_ptr<Factorization> inner_;
  SingularBorderedSolver whole_;
  UnsymmetricFactors unsymmetric_;  // of K + N
  Index multipliers_ = 0;
  bool regular_ = false;
  Matrix border_;  // K⁻¹ B
  Matrix reduced_;
  Eigen::PartialPivLU<Matrix> slides_;  // of reduced_
};

}  // namespace arcwall
