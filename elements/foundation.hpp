#pragma once

#include <vector>

#include "elements/distributed_load.hpp"
#include "elements/element.hpp"
#include "elements/on_slender_beam.hpp"
#include "elements/reissner_beam.hpp"
#include "elements/slender_beam.hpp"

namespace arcwall {

/// Potential of linear springs to the ground along a slender beam, k [force/length²] in x and in z:
///
///     V = ½ ∫ (k_x u_x² + k_z u_z²) dS,   u(S) = r(S) − R(S)
///
/// Present places r and stress-free ones R are both the cubic that has the ends' places and tangents, over the chord c
/// and its direction β: r1 + ξ c + c⊥ (N1 (θ1 − β) + N2 (θ2 − β)), N1 = ξ (1 − ξ)², N2 = −ξ² (1 − ξ). Of order 4 in
/// the element's length across the axis, 2 along it.
class StretchFoundation {
 public:
  StretchFoundation(const StretchReference& stretch, const Vec2& stiffness)
      : stretch_(stretch), stiffness_(stiffness) {}

  /// Places are measured from the stress-free place of the first end, angles are those of the axis' tangent.
  StretchLoad::Response respond(const Vec2& r1, double angle1, const Vec2& r2, double angle2) const;

 private:
  StretchReference stretch_;
  Vec2 stiffness_;
};

/// The same on an element of a classic or elastica beam.
using BeamFoundation = OnSlenderBeam<StretchFoundation>;

/// The same on a ReissnerBeam, or on another beam with displacements of the same shape functions.
class ExactFoundation final : public Element {
 public:
  /// Of the unknowns of each node the first two are the displacements.
  ExactFoundation(const ExactBeamReference& reference, const Vec2& stiffness, int unknowns_a_node = 3);

  int unknown_count() const override { return stride_ * static_cast<int>(masses_.rows()); }
  double evaluate(const double* u, double* f, double* K) const override;

 private:
  Matrix masses_;  // ∫ N_a N_b dS [length]
  Vec2 stiffness_;
  int stride_;
};

}  // namespace arcwall
