#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/chain_elimination.hpp"
#include "core/chain_groups.hpp"
#include "core/symmetric_factors.hpp"

namespace arcwall {

/// LDLᵀ of a block-tridiagonal matrix by cyclic reduction: every other group is eliminated, then every other one of
/// those that are left. Groups of one round have nothing to do with each other, so that several are worked on at once,
/// and short parts of a chain are eliminated first: those are stiff, while the leading parts of a long column may be
/// critical by themselves. No pivoting; the unknowns of a group follow each other in their order. Of nodes afloat,
/// solutions keep the digits that the matrix has lost: see ChainRound.
class ChainLdlt final : public SymmetricFactors {
 public:
  /// The greatest group for which this is meant.
  static constexpr Index widest = 8;

  /// `afloat`: see Linearization; may be empty.
  ChainLdlt(const SparseMatrix& lower_triangle, const ChainGroups& groups, const std::vector<bool>& afloat = {});

  bool factorize(const SparseMatrix& lower_triangle) override;
  bool sees_what_is_not_finite() const override { return true; }

  /// Where a part of the chain that is eliminated before the rest is singular, and the whole is not: what is left grows
  /// by the reciprocal, and digits are lost. Another order has other parts.
  bool refused() const override { return refused_; }
  void solve(Eigen::Ref<Matrix> X) const override;
  Pivots pivots() const override { return pivots_; }
  double growth(const SparseMatrix& lower_triangle) const override {
    return greatest_entry_ ? pivots_.greatest / *greatest_entry_ : SymmetricFactors::growth(lower_triangle);
  }
  double weighted(const Vector& v) const override;
  bool may_use_soft() const override { return false; }

 private:
  // Indices at a constant distance from each other.
  struct Steps {
    std::int32_t first = 0, step = 0, count = 1;

    std::int32_t at(std::int32_t i) const { return first + i * step; }
  };
  // Values of the matrix whose places in numbers_ follow each other.
  struct ValueRun {
    std::int32_t place;
    Steps values;
  };
  // Unknowns of groups that follow each other in one row of right-hand sides in the first round's work: the row's
  // start, in units of right-hand sides, its stride and the first group in it.
  struct UnknownRun {
    std::int32_t row, stride, group;
    Steps unknowns;
  };
  // A place of a group that no unknown has: its pivot, that of the group's first unknown, and its right-hand side.
  struct Unused {
    std::int32_t pivot, first;
    UnknownRun side;
  };

  void lay_out_rounds(Index groups);
  void lay_out_values(const SparseMatrix& A, const std::vector<Index>& group_of, const std::vector<Index>& row_of);
  void lay_out_unknowns(const ChainGroups& groups);
  void find_afloat(const ChainGroups& groups, const std::vector<bool>& unknowns);
  std::int32_t pivot_place(Index group, Index row) const;
  bool read_pivots();
  bool grew(const SparseMatrix& A);
  UnknownRun side_of(Index group, Index row, Index unknown) const;
  void clear_unused(Index columns) const;

  Index width_ = 0;  // of all groups: the greatest, rounded up to a width with code of its own
  Index unknowns_ = 0;
  std::vector<ChainRound> rounds_;     // of elimination
  std::vector<ValueRun> value_runs_;   // of the matrix
  std::vector<std::int32_t> filling_;  // places of ones on the diagonal of groups that are less wide
  std::vector<std::int32_t> empty_;    // places of the first round that no value goes to
  std::vector<Unused> unused_;         // pivots
  std::vector<UnknownRun> unknown_runs_;
  std::vector<double> numbers_;       // matrices of all rounds, then their factors
  std::vector<double> coupling_;      // workspace: between groups that are left
  mutable std::vector<double> work_;  // right-hand sides
  Index first_size_ = 0;              // of the numbers of the first round
  Pivots pivots_;
  std::optional<double> greatest_entry_;  // of the last matrix or nearly, where its pivots are far apart
  bool refused_ = false;
};

}  // namespace arcwall
