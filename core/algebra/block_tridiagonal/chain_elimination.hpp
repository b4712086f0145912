#pragma once

#include <cstdint>
#include <vector>

#include "core/lanes.hpp"
#include "core/types.hpp"

namespace arcwall {

/// Place of entry (row, column) in a packed lower triangle.
constexpr Index packed(Index row, Index column) { return row * (row + 1) / 2 + column; }

/// Of the pivots of a chain; what is there to fill groups and lanes counts.
struct ChainPivots {
  double least = infinity, greatest = 0.0;  ///< magnitudes of 1/d
  double sum = 0.0;                         ///< likewise; not finite where one is not
  double least_first = infinity;            ///< magnitude of 1/d, of those that are entries of the matrix
  Index negative = 0;
};

/// LDLᵀ of a block-tridiagonal matrix by cyclic reduction, on a chain of groups of one width B that is cut into as many
/// stretches as there are lanes. These are worked on side by side, each on a group between two others of its stretch:
///
///     [D_a       Aᵀ_ja        ]            D_j = L d Lᵀ,  Y = L⁻¹ A_j,  Z = d⁻¹ Y (1) [A_ja  D_j        A_jb  ]     →
///     [          Aᵀ_jb  D_b   ]            D_a −= Y_aᵀ Z_a,  D_b −= Y_bᵀ Z_b,  A_ba = −Y_bᵀ Z_a (2)
///
/// First go groups 1, 3, 5 …, then every other one of those that are left, but each as soon as its neighbours are the
/// right ones: what is worked on stays near the processor. The first groups of the stretches are left, a chain like the
/// first.
///
/// Elements, which join a group to the next one that is left, may be translation_free: their part of the forces
/// vanishes on a parallel motion T of everything, T being the first two unknowns of each group. Their parts of those
/// columns of D follow from their couplings, when they are made longer, too:
///
///     D_a T = −Σ_b A_ab T                                                                                        (3)
///
/// Taken so (Grassmann, Taksar and Heyman 1985) and not as a difference (2), they keep their digits however stiff short
/// elements are beside the whole.
struct ChainNumbers {
  ChainNumbers() = default;
  ChainNumbers(Index width, Index groups);

  /// Where entries stand in a group's numbers: D, then L and 1/d, a packed lower triangle; the coupling A_ja with the
  /// group before, then Z_a; the coupling A_jb with the one behind, then Z_b; both B × B, by rows of the group. A
  /// coupling belongs to the group that goes first: before any has gone, to those of odd number in their stretch, and
  /// to the last.
  Index before(Index row, Index column) const { return packed(width, 0) + row * width + column; }
  Index behind(Index row, Index column) const { return before(width, 0) + row * width + column; }
  Index per_group() const { return behind(width, 0); }
  Lanes* group(Index i) { return numbers.data() + i * per_group(); }

  Index width = 0, length = 0;  ///< of groups in unknowns, of stretches in groups
  std::vector<Lanes> numbers{};
  std::vector<double> last{};  ///< numbers of the chain that is left
  /// Bits of lanes in which the element behind a group is translation_free, at first; none at all where no element is.
  std::vector<std::uint8_t> translation_free{};
  /// Bits of lanes in which both elements at a group were so, the one behind the stretch included: each has its own
  /// part of D T.
  std::vector<std::uint8_t> parted{};
  /// As `translation_free`, while elements become longer; and of the two elements between which a group went.
  std::vector<std::uint8_t> afloat_now{}, went_afloat{};
};

/// Right-hand sides, `columns` side by side: entry k of column r of group i of all stretches stands at
/// (i B + k) · columns + r.
struct ChainWork {
  std::vector<Lanes> entries{};
  std::vector<double> last{};
};

/// The least width with code of its own that groups of `greatest` unknowns fit in; 0 if there is none.
Index elimination_width(Index greatest);

/// Groups in turn, in place; those up to `end` + 1 have their numbers by then. `begin` and `end` are even, or `end` is
/// the length.
void eliminate_groups(ChainNumbers& chain, Index begin, Index end, ChainPivots& seen);

/// L y = f for one or two columns, in place, as far as the groups in turn have gone; their right-hand sides are there
/// as their numbers were. With the last part what is left of the chain is solved.
void forward_groups(const ChainNumbers& chain, Index columns, Index begin, Index end, ChainWork& work);

/// Then the other way, the last part first: solutions of a part are there when it is done.
void backward_groups(const ChainNumbers& chain, Index columns, Index begin, Index end, ChainWork& work);

/// |v|ᵀ |L| |D| |L|ᵀ |v| of one column v, whose place in the work is that of a right-hand side. What is
/// translation_free sees v without the motion that it has in common with the group eliminated: only the rest of v meets
/// round-off there.
double weighted_by_chain(const ChainNumbers& chain, ChainWork& work);

}  // namespace arcwall
