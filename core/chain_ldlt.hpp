#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/factorization.hpp"

namespace arcwall {

/// Groups of unknowns of which each couples with itself, the group before and the group behind alone.
using ChainGroups = std::vector<std::vector<Index>>;

/// The groups of a symmetric matrix, given by its lower triangle, whose last `multipliers` unknowns follow the others
/// of their group; empty if one had more than `widest` unknowns. A chain of members has its nodes for groups.
std::optional<ChainGroups> chain_groups(const SparseMatrix& lower_triangle, Index multipliers, Index widest);

/// LDLᵀ of a block-tridiagonal matrix by cyclic reduction: every other group is eliminated, then every other one of
/// those that are left. Groups of one round have nothing to do with each other, so that several are worked on at once,
/// and short parts of a chain are eliminated first: those are stiff, while the leading parts of a long column may be
/// critical by themselves. No pivoting; the unknowns of a group follow each other in their order.
class ChainLdlt {
 public:
  /// The greatest group for which this is meant.
  static constexpr Index widest = 8;

  void analyse(const SparseMatrix& lower_triangle, const ChainGroups& groups);

  /// The values of a matrix with the pattern analysed. False if a pivot is zero or not finite.
  bool factorize(const double* values);

  /// X := A⁻¹ X.
  void solve(Eigen::Ref<Matrix> X) const;

  const Inertia& inertia() const { return inertia_; }
  double least_pivot() const { return least_pivot_; }        ///< in magnitude
  double greatest_pivot() const { return greatest_pivot_; }  ///< in magnitude

  /// |v|ᵀ |L| |D| |L|ᵀ |v|
  double weighted(const Vector& v) const;

 private:
  struct Round {
    Index eliminated = 0, left = 0;
    Index stride = 0;                                     // of what belongs to those eliminated
    Index left_stride = 0;                                // of what belongs to those that are left
    Index kept = 0;                                       // places in the numbers: D of those left,
    Index diagonal = 0;                                   // D of those eliminated, then L and 1/d,
    Index before = 0;                                     // A_ja, then Z_a,
    Index behind = 0;                                     // A_jb, then Z_b
    Index right_hand_side = 0, right_hand_side_left = 0;  // places in the work, in units of right-hand sides

    bool eliminates(Index group) const { return left == 0 || group % 2 == 1; }
    Index diagonal_at(Index group, Index entry) const {
      return eliminates(group) ? diagonal + entry * stride + group / 2 : kept + entry * left_stride + group / 2;
    }
  };
  struct Place {  // of an entry of a right-hand side: the row's start, in units of right-hand sides, and the group in
                  // it
    std::int32_t row, stride, group;
  };
  template <Index width>
  struct Code;

  void lay_out_rounds(Index groups);
  std::int32_t pivot_place(Index group, Index row) const;

  Index width_ = 0;                    // of all groups: the greatest, rounded up to a width with code of its own
  std::vector<Round> rounds_;          // of elimination
  std::vector<std::int32_t> slots_;    // of each value of the matrix in numbers_
  std::vector<std::int32_t> filling_;  // places of ones on the diagonal of groups that are less wide
  std::vector<std::int32_t> pivots_;   // of each unknown, of 1/d, in numbers_
  std::vector<Place> places_;          // of each unknown in the first round's right-hand side
  std::vector<double> numbers_;        // matrices of all rounds, then their factors
  std::vector<double> coupling_;       // workspace: between groups that are left
  mutable std::vector<double> work_;   // right-hand sides
  Index first_size_ = 0;               // of the numbers of the first round
  Inertia inertia_{};
  double least_pivot_ = 0.0, greatest_pivot_ = 0.0;
};

}  // namespace arcwall
