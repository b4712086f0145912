#pragma once

#include <vector>

#include "contact/candidate.hpp"
#include "core/linearization.hpp"

namespace arcwall {

/// A constraint f = 0 of a contact, and its force t along ∇f. The force is an unknown, or one with a spring beside it.
struct ConstraintForce {
  const std::vector<Index>& unknowns;  ///< of the point whose place f is of
  Index row = 0;                       ///< of the multiplier in x and of the constraint in F
  double t = 0.0;                      ///< [force]
  double stiffness = 0.0;              ///< r of t = p − r f [force/length]
  double compliance = 0.0;             ///< c of −f − c p = 0 [length/force]
};

/// Adds −t ∇f.
void add_force(const ConstraintForce& force, const Gap& f, Eigen::Ref<Vector> F);

/// Adds the same to F, with its derivatives, and writes the constraint's row of K, whose value is `value`. K has the
/// pattern.
void add_force(const ConstraintForce& force, const Gap& f, double value, Linearization& out);

}  // namespace arcwall
