#pragma once

#include <memory>
#include <vector>

#include "core/algebra/block_tridiagonal/chain_ldlt.hpp"

namespace arcwall {

/// A chain of groups (chain_ldlt.hpp) of which multipliers hold some: [A Cᵀ; C −c], each row of C with entries in one
/// group. In a group with the unknowns u, Cᵀ = Q R, the coordinates w = Qᵀu where c = 0 are known from C alone: they
/// are taken out before the chain is factorized (null-space method), so that it is no wider than without multipliers
/// and its layout stays when these change. Where c ≠ 0 the multiplier is a spring on w.
class HeldChain final : public SymmetricFactors {
 public:
  /// `groups`: of the unknowns that are no multipliers. Null if multipliers hold them in another way.
  static std::unique_ptr<HeldChain> of(const SparseMatrix& lower_triangle, Index multipliers,
                                       const ChainGroups& groups);

  bool adopts(const SparseMatrix& lower_triangle, Index multipliers) override;
  bool factorize(const SparseMatrix& lower_triangle) override;
  bool sees_what_is_not_finite() const override { return true; }
  bool refused() const override { return refused_; }
  void solve(Eigen::Ref<Matrix> X) const override;
  Pivots pivots() const override { return pivots_; }
  double weighted(const Eigen::Ref<const Vector>& v) const override;
  bool may_use_soft() const override { return false; }

 private:
  static constexpr int widest = static_cast<int>(ChainLdlt::widest);
  using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, widest, widest>;
  using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, widest, 1>;
  using Unknowns = std::vector<Index>;

  // Values that follow each other in the matrix and in A.
  struct Chunk {
    Index from, to, count;
  };
  // Of A, between a group and itself or one beside it: the places of its entries in the values, by columns.
  struct Block {
    const Unknowns* columns;
    std::vector<Index> places;
  };
  // A group and its multipliers.
  struct Hold {
    const Unknowns* unknowns;
    std::vector<Block> blocks{};            // its own first
    std::vector<Index> multipliers{};       // as unknowns
    std::vector<Index> compliance{};        // places of −c in the matrix
    std::vector<std::vector<Index>> row{};  // places of C, by the group's unknowns; −1: none
    // Of the last matrix.
    std::vector<Index> order{};  // of the multipliers: those with c = 0, of which there are `rigid`, first
    Index rigid = 0;
    Small Q{}, R{};
    SmallVector c{};
    std::vector<Small> rows{};     // of QᵀAQ that are held, by blocks; the rigid ones are taken out
    std::vector<bool> is_stiff{};  // beside the group's own block

    Index unknown(Index i) const { return (*unknowns)[static_cast<std::size_t>(i)]; }
    Index multiplier(Index j) const {
      return multipliers[static_cast<std::size_t>(order[static_cast<std::size_t>(j)])];
    }
  };

  // Of (1) and (2), in solve(): what a right-hand side gives a group.
  struct Known {
    SmallVector w, f, g;  // w of the rigid ones
  };

  HeldChain(const SparseMatrix& A, const ChainGroups& groups) : groups_(groups), A_(A), chain_(A, groups) {}
  bool find_chunks(const SparseMatrix& matrix, Index multipliers);
  bool find_holds(const SparseMatrix& matrix, Index multipliers);
  bool find_blocks(Hold& hold, std::size_t group) const;
  Small values(const Hold& hold, const Block& block) const;
  void set_values(const Block& block, const Small& values);
  bool turn(const SparseMatrix& matrix, Hold& hold);
  void take_out(Hold& hold);
  static SmallVector gathered(const Eigen::Ref<const Vector>& x, const Unknowns& unknowns);
  static void scatter(const SmallVector& entries, const Unknowns& unknowns, Eigen::Ref<Vector> x);
  static SmallVector turned(const Hold& hold, const Eigen::Ref<const Vector>& x);
  static Known turn_right_hand_side(const Hold& hold, Eigen::Ref<Vector> x);
  static void move_known(const Hold& hold, const Known& known, Eigen::Ref<Vector> x);
  static void find_multipliers(const Hold& hold, const Known& known, Eigen::Ref<Vector> x);

  ChainGroups groups_;
  SparseMatrix A_;  // then QᵀAQ, without what is taken out
  ChainLdlt chain_;
  std::vector<Chunk> chunks_;
  std::vector<Hold> holds_;
  mutable std::vector<Known> known_;  // room for solve()
  Pivots pivots_;
  bool refused_ = false;
};

}  // namespace arcwall
