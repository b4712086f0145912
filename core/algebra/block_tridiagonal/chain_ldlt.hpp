#pragma once

#include <optional>
#include <vector>

#include "core/algebra/block_tridiagonal/chain_elimination.hpp"
#include "core/algebra/block_tridiagonal/chain_groups.hpp"
#include "core/algebra/block_tridiagonal/lane_places.hpp"
#include "core/algebra/solvers/symmetric_factors.hpp"

namespace arcwall {

/// LDLᵀ of a block-tridiagonal matrix by cyclic reduction: every other group is eliminated, then every other one of
/// those that are left. Four stretches of the chain have nothing to do with each other, so that they are worked on at
/// once, and short parts of a chain are eliminated first: those are stiff, while the leading parts of a long column may
/// be critical by themselves. No pivoting; the unknowns of a group follow each other in their order. Of nodes
/// translation_free, solutions keep the digits that the matrix has lost: see ChainNumbers.
class ChainLdlt final : public SymmetricFactors {
 public:
  /// The greatest group for which this is meant.
  static constexpr Index widest = 8;

  /// `translation_free`: see Linearization; may be empty.
  ChainLdlt(const SparseMatrix& lower_triangle, const ChainGroups& groups,
            const std::vector<bool>& translation_free = {});

  bool factorize(const SparseMatrix& lower_triangle) override;
  bool factorize_and_solve(const SparseMatrix& lower_triangle, std::span<const ScaledColumn> of,
                           Eigen::Ref<Matrix> X) override;
  bool sees_what_is_not_finite() const override { return true; }

  /// Where a part of the chain that is eliminated before the rest is singular, and the whole is not: what is left grows
  /// by the reciprocal, and digits are lost. Another order has other parts.
  bool refused() const override { return refused_; }
  void solve(Eigen::Ref<Matrix> X) const override;
  Pivots pivots() const override { return pivots_; }
  double growth(const SparseMatrix& lower_triangle) const override {
    return greatest_entry_ ? pivots_.greatest / *greatest_entry_ : SymmetricFactors::growth(lower_triangle);
  }
  double weighted(const Eigen::Ref<const Vector>& v) const override;
  bool may_use_soft() const override { return false; }

 private:
  void find_values(const SparseMatrix& A, const ChainGroups& groups);
  void find_unknowns(const ChainGroups& groups);
  void find_afloat(const ChainGroups& groups, const std::vector<bool>& unknowns);
  // Of an entry: the group of a stretch to which it belongs, and where among that one's numbers.
  struct Spot {
    Index record, place;
  };
  Spot spot_of(Index group, Index row, Index other, Index other_row) const;
  using Columns = std::span<const ScaledColumn>;
  bool factorize_beside(const SparseMatrix& A, Columns of);
  void gather(Columns of, Index end, Index& there) const;
  void solve_backward(Eigen::Ref<Matrix> X) const;
  void ask_for_entries(Index begin, const double* values, Columns of);
  void ask_for_solutions(Index begin, const Eigen::Ref<const Matrix>& X) const;
  bool read(const ChainPivots& seen, double filling);
  bool grew(const SparseMatrix& A, double least_first);

  ChainNumbers chain_;
  // Its numbers come from main memory each time: what comes later is asked for ahead, and little is done at a time, so
  // that memory and processor work at once.
  bool is_far_ = false;
  Index together_ = 0;            // groups of a stretch whose numbers are brought to their places before the next ones
  LanePlaces values_, unknowns_;  // of the matrix and of right-hand sides
  Index unknown_count_ = 0;
  std::optional<Index> filling_;  // value of the matrix that stands on the diagonal where no unknown does
  mutable ChainWork work_;
  Pivots pivots_;
  std::optional<double> greatest_entry_;  // of the last matrix or nearly, where its pivots are far apart
  bool refused_ = false;
};

}  // namespace arcwall
