#pragma once

#include <memory>
#include <vector>

#include "core/algebra/block_tridiagonal/block_tridiagonal_ldlt.hpp"

namespace arcwall {

/// LDLᵀ of [A Cᵀ; C −c], where A is block tridiagonal and each row of C, a multiplier, has entries in one block. In a
/// block with the unknowns u and Cᵀ = Q R, the coordinates w = Qᵀu that multipliers with c = 0 hold are known from C
/// alone: they are taken out before A is factorized (null-space method, (3.3a) in docs/theory.md). So blocks are no
/// wider than without multipliers, and the analysis serves again when these change. A multiplier with c ≠ 0 is a spring
/// on w; one that is softer than the structure is a ground term, for which nothing is turned.
class NullSpaceLdlt final : public SymmetricFactors {
 public:
  /// `blocks`: of the unknowns that are no multipliers. Null if a multiplier acts on several blocks.
  static std::unique_ptr<NullSpaceLdlt> of(const SparseMatrix& lower_triangle, Index multipliers, const Blocks& blocks,
                                           const std::vector<bool>& translation_free = {});

  bool reuse_analysis(const SparseMatrix& lower_triangle, Index multipliers) override;
  FactorStatus factorize(const SparseMatrix& lower_triangle, const MatrixProperties& known = {}) override;
  bool refused() const override { return refused_; }
  void solve(Eigen::Ref<Matrix> X) const override;
  double weighted(const Eigen::Ref<const Vector>& v) const override;
  bool may_use_near_null() const override { return false; }

 private:
  static constexpr int widest = static_cast<int>(BlockTridiagonalLdlt::widest);
  using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, widest, widest>;
  using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, widest, 1>;
  using Unknowns = std::vector<Index>;

  // Values that follow each other both in the matrix and in A.
  struct Chunk {
    Index from, to, count;
  };
  // The entries of A between a pressed block and itself or a neighbour: where they stand in A's values, by columns.
  struct Coupling {
    const Unknowns* columns;
    std::vector<Index> places;
  };
  // A block with multipliers.
  struct PressedBlock {
    const Unknowns* unknowns;
    std::vector<Coupling> couplings{};      // with itself first
    std::vector<Index> multipliers{};       // as unknowns
    std::vector<Index> compliance{};        // places of −c in the matrix
    std::vector<std::vector<Index>> row{};  // places of C in the matrix, by the block's unknowns; −1: none
    // Of the last matrix.
    std::vector<Index> order{};  // of the multipliers: those with c = 0, of which there are `rigid`, first
    Index rigid = 0;
    bool is_turned = true;  // else Q = 1, and R = Cᵀ
    Small Q{}, R{};
    SmallVector c{};
    std::vector<Small> rows{};     // of QᵀAQ that multipliers hold, by couplings; the rigid ones are taken out
    std::vector<bool> is_stiff{};  // springs, beside the block itself

    Index unknown(Index i) const { return (*unknowns)[static_cast<std::size_t>(i)]; }
    Index multiplier(Index j) const {
      return multipliers[static_cast<std::size_t>(order[static_cast<std::size_t>(j)])];
    }
  };

  // Of (1) and (2), in solve(): what a right-hand side gives a block.
  struct Known {
    SmallVector w, f, g;  // w of the rigid ones
  };

  NullSpaceLdlt(const SparseMatrix& A, const Blocks& blocks, std::vector<bool> translation_free)
      : blocks_(blocks), translation_free_(std::move(translation_free)), A_(A), ldlt_(A, blocks, translation_free_) {}
  bool find_chunks(const SparseMatrix& matrix, Index multipliers);
  bool find_pressed_blocks(const SparseMatrix& matrix, Index multipliers);
  bool find_couplings(PressedBlock& pressed, std::size_t block) const;
  Small values(const PressedBlock& pressed, const Coupling& coupling) const;
  void set_values(const Coupling& coupling, const Small& values);
  bool eliminate_multipliers(const SparseMatrix& matrix);
  bool read_multipliers(const SparseMatrix& matrix, PressedBlock& pressed);
  bool turn(PressedBlock& pressed, const Small& Ct);
  bool keep_rows(PressedBlock& pressed) const;
  void take_out(PressedBlock& pressed);
  void tell_what_is_free();

  static SmallVector gathered(const Eigen::Ref<const Vector>& x, const Unknowns& unknowns);
  static void scatter(const SmallVector& entries, const Unknowns& unknowns, Eigen::Ref<Vector> x);
  static SmallVector turned(const PressedBlock& pressed, const Eigen::Ref<const Vector>& x);
  static Known turn_right_hand_side(const PressedBlock& pressed, Eigen::Ref<Vector> x);
  static void move_known(const PressedBlock& pressed, const Known& known, Eigen::Ref<Vector> x);
  static void find_multipliers(const PressedBlock& pressed, const Known& known, Eigen::Ref<Vector> x);

  Blocks blocks_;
  std::vector<bool> translation_free_;
  SparseMatrix A_;  // then QᵀAQ, without what is taken out
  BlockTridiagonalLdlt ldlt_;
  std::vector<Chunk> chunks_;
  std::vector<PressedBlock> pressed_;
  std::optional<std::vector<bool>> turned_;  // which of them were so when the chain was told what is free
  std::vector<GroundTerm> ground_;           // those of the matrix and soft multipliers
  mutable std::vector<Known> known_;         // room for solve()
  bool refused_ = false;
};

}  // namespace arcwall
