#pragma once

#include <cstdint>
#include <vector>

#include "core/chain_elimination.hpp"
#include "core/chain_groups.hpp"
#include "core/symmetric_factors.hpp"

namespace arcwall {

/// LDLᵀ of a block-tridiagonal matrix by cyclic reduction: every other group is eliminated, then every other one of
/// those that are left. Groups of one round have nothing to do with each other, so that several are worked on at once,
/// and short parts of a chain are eliminated first: those are stiff, while the leading parts of a long column may be
/// critical by themselves. No pivoting; the unknowns of a group follow each other in their order.
class ChainLdlt final : public SymmetricFactors {
 public:
  /// The greatest group for which this is meant.
  static constexpr Index widest = 8;

  ChainLdlt(const SparseMatrix& lower_triangle, const ChainGroups& groups);

  bool factorize(const SparseMatrix& lower_triangle) override;
  void solve(Eigen::Ref<Matrix> X) const override;
  Pivots pivots() const override { return pivots_; }
  double weighted(const Vector& v) const override;

 private:
  struct Place {  // of an entry of a right-hand side: the row's start, in units of right-hand sides, and the group in
                  // it
    std::int32_t row, stride, group;
  };

  void lay_out_rounds(Index groups);
  std::int32_t pivot_place(Index group, Index row) const;

  Index width_ = 0;                         // of all groups: the greatest, rounded up to a width with code of its own
  std::vector<ChainRound> rounds_;          // of elimination
  std::vector<std::int32_t> slots_;         // of each value of the matrix in numbers_
  std::vector<std::int32_t> filling_;       // places of ones on the diagonal of groups that are less wide
  std::vector<std::int32_t> empty_;         // places of the first round that no value goes to
  std::vector<std::int32_t> pivot_places_;  // of each unknown, of 1/d, in numbers_
  std::vector<Place> places_;               // of each unknown in the first round's right-hand side
  std::vector<double> numbers_;             // matrices of all rounds, then their factors
  std::vector<double> coupling_;            // workspace: between groups that are left
  mutable std::vector<double> work_;        // right-hand sides
  Index first_size_ = 0;                    // of the numbers of the first round
  Pivots pivots_;
};

}  // namespace arcwall
