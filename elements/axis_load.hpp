#pragma once

#include "elements/distributed_load.hpp"
#include "elements/on_slender_beam.hpp"
#include "elements/reissner_beam.hpp"
#include "elements/slender_beam.hpp"

namespace arcwall {

/// Potential of a dead load that is given along and across the stress-free axis at each place of a stretch, by its
/// length:
///
///     V = −∫ q(S)·(r(S) − R(S)) dS,   q = q₁ t₀(S) + q₂ n₀(S)
///
/// with places r now and R at rest on the cubics of StretchFoundation. Of order 4.
class StretchAxisLoad {
 public:
  /// `load`: along the axis, and across it to the left [force/length].
  StretchAxisLoad(const StretchReference& stretch, const Vec2& load) : stretch_(stretch), load_(load) {}

  /// Places are measured from the stress-free place of the first end, angles are those of the axis' tangent.
  StretchLoad::Response respond(const Vec2& r1, double angle1, const Vec2& r2, double angle2) const;

 private:
  StretchReference stretch_;
  Vec2 load_;
};

/// The same on an element of a classic or elastica beam.
using BeamAxisLoad = OnSlenderBeam<StretchAxisLoad>;

}  // namespace arcwall
