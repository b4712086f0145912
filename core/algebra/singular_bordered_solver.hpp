#pragma once

#include <Eigen/LU>
#include <optional>
#include <vector>

#include "core/algebra/factorization.hpp"
#include "core/linearization.hpp"

namespace arcwall {

/// Solves with J = ∂F/∂x bordered by F_λ and a row, where J may be singular and the whole is not (see BorderedSolver).
///
/// One spring is added to K: K + k e eᵀ with an unknown's e is regular if K's null vector has a part in that unknown,
/// and the spring's force p is one unknown more. With J = [K B; C_x C_s] and δx = (x, s)
///
///     x = X_f − X_B s − X_λ λ + X_e p,      X = (K + k e eᵀ)⁻¹ [f_x, B, F_λx, e],
///     C_x x + C_s s + F_λs λ = f_s,         c_xᵀ x + c_sᵀ s + d λ = g,         p = k eᵀ x                       (1)
///
/// Solutions are refined and checked; those that stay poor come by LU of the whole.
class SingularBorderedSolver {
 public:
  explicit SingularBorderedSolver(const MakeFactorization& make = make_ldlt) : sprung_(make()) {}

  /// `equations` must outlive the use of this factorization; the spring stands in their K while that is factorized.
  /// `soft`: a vector that is large where K's null vector is, as far as one knows.
  void factorize(Linearization& equations, const Row& border, Index multipliers, const Vector& soft);

  /// Solution for a right-hand side (f, g); empty if the whole is singular to working precision.
  std::optional<Direction> solve(const Vector& f, double g);

 private:
  bool add_spring(Index multipliers, const Vector& soft);
  Matrix rows_of(const Matrix& x) const;
  Direction solve_with_spring(const Vector& f, double g) const;
  std::optional<Direction> refined_with_spring(const Vector& f, double g) const;
  SparseMatrix with_one_held(Index held) const;
  std::optional<Direction> solve_with_lu(const Vector& f, double g) const;

  Linearization* equations_ = nullptr;
  Row border_;
  bool has_spring_ = false;
  std::unique_ptr<Factorization> sprung_;  // of K with the spring
  Index at_ = 0;                           // the unknown e
  double spring_ = 0.0;                    // k
  Matrix responses_;                       // X_B, X_λ, −X_e
  Eigen::PartialPivLU<Matrix> small_;
};

}  // namespace arcwall
