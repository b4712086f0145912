#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/ground_term.hpp"
#include "core/state.hpp"

namespace arcwall {

/// The place on an obstacle that a contact with friction is held at, where contact moves along the body as well: as it
/// rolls without slip, the place moves by `stretch` times its material coordinate.
struct RollingPlace {
  Index place = 0, coordinate = 0;  ///< columns of the border
  double stretch = 1.0;
};

/// The equations F(x, λ) = 0 at one state, with their derivatives. Reused from state to state: while the active set
/// stays the same, the pattern of K does, and only values are written.
///
/// ∂F/∂x is symmetric but for a border of a few unknowns s that stand last in x, with as many last equations. Each s_k
/// belongs to an unknown y_k of K (a moment that holds the body where it slides), which its equation may ask to vanish:
///
///     ∂F/∂x = [ K  B ]
///             [   C  ]
///
/// Equations without a border may have another part N that is not symmetric, ∂F/∂x = K + N, where places slip that
/// elastic friction holds (PathHistory). K is then what it is while they stick.
struct Linearization {
  Vector F{};                              ///< residual, internal minus external
  SparseMatrix K{};                        ///< the symmetric part: its lower triangle alone is stored
  SparseMatrix N{};                        ///< the other part, with entries where both triangles of K have some; of no
                                           ///< size where nothing slips
  SparseMatrix work_lost{};                ///< with N: a symmetric matrix, its lower triangle: a motion in which some
                                           ///< of what slips sticks takes no more of K + N's work than its form
  Matrix B{};                              ///< columns of the border; none for most systems
  LongRows C{};                            ///< rows of the border, by x and s
  std::vector<Index> holding{};            ///< y_k, one a column of B
  Vector border_rates{};                   ///< one a column of B: the rate by s_k of the equation that y_k enforces, if
                                           ///< the body slid and y_k did not hold it; 0 where it is truly held.
                                           ///< Stability is counted with the others let go (SlidingStabilityOperator)
  std::vector<bool> energetic{};           ///< one a column of B: whether its equation is that the energy is stationary
                                           ///< in s_k, but for discretisation: its row of C is then its column of B,
                                           ///< what nothing holds is s_k itself, and y_k says nothing. Empty: none is
  Vector slip_senses{};                    ///< one a column of B: where s_k is the place that a contact with friction
                                           ///< is held at, and its equation the law of slip, the sense of the slip, 1
                                           ///< or −1, else 0. Empty: no contact slips
  std::vector<RollingPlace> rolling{};     ///< of contacts with friction that move along the body
  Vector F_lambda{};                       ///< ∂F/∂λ
  std::vector<bool> translation_free{};    ///< nodes on which no force arises where everything moves parallel, but for
                                           ///< ground terms, by unknowns of K: true for the displacement in x of such
                                           ///< a node, behind which stands that in z. Solutions then know this to the
                                           ///< last digit, which K's rounded entries do not. May be empty
  std::vector<GroundTerm> ground{};        ///< what of K's entries joins translation-free nodes to the ground; written
                                           ///< with K in each linearization
  std::optional<ActiveSet> pattern_of{};   ///< the active set whose pattern K has; empty: not laid out yet
  std::unique_ptr<Linearization> inner{};  ///< workspace of a system that wraps another

  /// False where the equations have a border or an unsymmetric part.
  bool is_symmetric() const { return B.cols() == 0 && N.nonZeros() == 0; }
};

}  // namespace arcwall
