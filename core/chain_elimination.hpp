#pragma once

#include <cstdint>
#include <vector>

#include "core/lanes.hpp"
#include "core/types.hpp"

namespace arcwall {

/// Place of entry (row, column) in a packed lower triangle.
constexpr Index packed(Index row, Index column) { return row * (row + 1) / 2 + column; }

/// A round of cyclic reduction on a chain of groups, all of one width B: groups 1, 3, 5 … of those that are left are
/// eliminated, each from its two neighbours; the last one by itself. Entry k of all groups stands together: that of
/// group i of the eliminated ones at k · stride + i. Strides are multiples of the lanes; blocks are packed lower
/// triangles or B × B by rows.
///
/// A group is afloat where its first two unknowns are the displacements of a node and no force arises from a parallel
/// motion T of everything. Then its rows vanish on T, in all rounds, and those columns of D follow from the couplings:
///
///     D_a T = −Σ_b A_ab T                                                                                        (3)
///
/// Taken so (Grassmann, Taksar and Heyman 1985) and not as a difference (2), they keep their digits however stiff short
/// elements are beside the whole.
struct ChainRound {
  Index eliminated = 0, left = 0;
  Index stride = 0;                                     // of what belongs to those eliminated
  Index left_stride = 0;                                // of what belongs to those that are left
  Index kept = 0;                                       // places in the numbers: D of those left,
  Index diagonal = 0;                                   // D of those eliminated, then L and 1/d,
  Index before = 0;                                     // A_ja, then Z_a,
  Index behind = 0;                                     // A_jb, then Z_b
  Index right_hand_side = 0, right_hand_side_left = 0;  // places in the work, in units of right-hand sides

  std::vector<std::uint8_t> afloat{};  // whether all are, by lanes of those left, with what goes on both sides of each

  bool is_afloat(Index first_lane) const { return afloat[static_cast<std::size_t>(first_lane / Lanes::count)] != 0; }
  bool eliminates(Index group) const { return left == 0 || group % 2 == 1; }
  /// Where 1/d of row k of those eliminated begin.
  Index diagonal_row(Index row) const { return diagonal + packed(row, row) * stride; }
  Index diagonal_at(Index group, Index entry) const {
    return eliminates(group) ? diagonal + entry * stride + group / 2 : kept + entry * left_stride + group / 2;
  }
};

/// The least width with code of its own that groups of `greatest` unknowns fit in; 0 if there is none.
Index elimination_width(Index greatest);

/// The factors of all rounds, in place; `coupling` is a workspace of B × B times the first stride.
void eliminate_rounds(Index width, const std::vector<ChainRound>& rounds, double* numbers, double* coupling);

/// One or two columns, whose entries lie in turns, in place.
void solve_rounds(Index width, Index columns, const std::vector<ChainRound>& rounds, const double* numbers,
                  double* work);

/// |v|ᵀ |L| |D| |L|ᵀ |v| of one column v, whose place in the work is that of a right-hand side. What is afloat sees v
/// without the motion that it has in common with the group eliminated: only the rest of v meets round-off there.
double weighted_rounds(Index width, const std::vector<ChainRound>& rounds, const double* numbers, double* work);

}  // namespace arcwall
