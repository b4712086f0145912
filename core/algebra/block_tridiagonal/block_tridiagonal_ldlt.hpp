#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/algebra/assembly.hpp"
#include "core/algebra/block_tridiagonal/blocks.hpp"
#include "core/algebra/block_tridiagonal/cyclic_reduction.hpp"
#include "core/algebra/solvers/symmetric_factors.hpp"

namespace arcwall {

/// LDLᵀ of a block-tridiagonal matrix by cyclic reduction, without pivoting (README.md).
class BlockTridiagonalLdlt final : public SymmetricFactors {
 public:
  /// The greatest block for which this is meant.
  static constexpr Index widest = 6;

  /// `translation_free`: see Linearization; may be empty. Solutions keep the digits that the matrix has lost where
  /// blocks are nodes with two displacements as their first unknowns, one behind the other.
  BlockTridiagonalLdlt(const SparseMatrix& lower_triangle, const Blocks& blocks,
                       const std::vector<bool>& translation_free = {});

  /// Which nodes are translation-free in the matrices to come; no more can be known than at first.
  void set_translation_free(const std::vector<bool>& translation_free);

  FactorStatus factorize(const SparseMatrix& lower_triangle, const MatrixProperties& known = {}) override;

  /// Where a part of the chain that is eliminated before the rest is singular, and the whole is not: what is left grows
  /// by the reciprocal, and digits are lost. Another order has other parts.
  bool refused() const override { return refused_; }
  void solve(Eigen::Ref<Matrix> X) const override;
  double weighted(const Eigen::Ref<const Vector>& v) const override;
  bool may_use_near_null() const override { return false; }

 private:
  // Of an entry: the block of a part to which it belongs, and where among that one's numbers.
  struct Spot {
    Index record, place;
  };
  // A block that has fewer unknowns than others.
  struct Narrow {
    Index block, size;
  };

  Spot spot_of(Index block, Index row, Index other, Index other_row) const;
  void find_values(const SparseMatrix& A, const Blocks& blocks);
  void find_unknowns(const Blocks& blocks);
  bool is_free(Index block) const;
  bool is_node_with_translations(Index block, const std::vector<bool>& translation_free) const;
  void read(const SparseMatrix& A, double padding);
  void find_ground_parts(GroundTerms ground);
  void find_ground_part(Index block, bool is_free);
  double& number(Index block, Index place);
  void gather(const ShiftedLists& lists, Index record, const double* array, Index step, Lanes* to) const;
  void scatter(const ShiftedLists& lists, Index record, const Lanes* from, Index step, double* array) const;
  bool read_pivots(const PivotScan<double>& scan, double padding);
  bool has_grown(const SparseMatrix& A) const;

  BlockChain chain_;
  Index block_count_ = 0, unknown_count_ = 0;
  ShiftedLists values_, unknowns_;  // by blocks: of the matrix, by places, and of right-hand sides; −1: none
  std::vector<Narrow> narrow_;
  std::optional<Index> padding_;        // the value of the matrix that stands on the diagonal where no unknown does
  std::vector<std::int32_t> block_of_;  // unknowns, where translations are known
  std::vector<Index> grounded_before_;  // blocks before block i that resist translations, if only by K's own entries
  mutable std::vector<Lanes> work_;
  bool refused_ = false;
};

}  // namespace arcwall
