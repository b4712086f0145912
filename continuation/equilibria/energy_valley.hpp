#pragma once

#include "core/algebra/factorization.hpp"
#include "core/unilateral_system.hpp"

namespace arcwall {

/// Where a valley of the energy leads.
enum class ValleyEnd {
  leads_away,  ///< the energy decreases along it
  leads_back,  ///< the energy increases along it: a stable branch leaves the branch point
  unclear,     ///< no valley was found: several modes at once
  cut_off,     ///< it took more work than it was given
};

struct Valley {
  ValleyEnd end = ValleyEnd::unclear;
  State state{};  ///< on its floor; beyond the energy barrier if it leads away
};

/// Which state loses its stability.
struct LostState {
  State state{};     ///< near an equilibrium of the system; contact forces may be missing
  Vector towards{};  ///< direction of the motion, by the unknowns of the structure
  enum class Kind { limit_point, branch_point, contact_change } kind = Kind::limit_point;
};

/// Follows the valley of the potential from a state that loses its stability, at fixed λ (docs/theory.md, section 15):
///
///     Π_s = min Π(x)   where x_j = x_j(state) + s v_j / |v|_W
///
/// v is the critical mode, x_j the degree of freedom that it moves most. s grows fourfold from 10⁻⁶ until the holding
/// force ∂Π_s/∂s grows with it as the kind of the state demands. A negative force leads away.
///
/// `factorizations`: that it may make; what is left of them when it ends.
Valley follow_valley(const UnilateralSystem& system, const LostState& lost, const MakeFactorization& make,
                     Index& factorizations);

}  // namespace arcwall
