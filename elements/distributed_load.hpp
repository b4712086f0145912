#pragma once

#include "elements/classic_beam.hpp"
#include "elements/element.hpp"

namespace arcwall {

/// Potential of a dead load q per length of the undeformed axis on a classic beam element:
///
///     V = −h q·[(r1 + r2)/2 + Δr⊥ (φ1 − φ2)/12]
///
/// with node displacements in r, the current chord Δr turned by +90° and end angles φ: the mean position of Hermite's
/// cubic. Unknowns as in ClassicBeam. Measured from the undeformed state.
class BeamDistributedLoad final : public Element {
 public:
  BeamDistributedLoad(const BeamReference& reference, const Vec2& load) : reference_(reference), load_(load) {}

  int unknown_count() const override { return 6; }
  double evaluate(const double* u, double* f, double* K) const override;

 private:
  BeamReference reference_;
  Vec2 load_;  // [force/length]
};

/// The same for a bar: half of the load at each end. Unknowns as in Truss.
class TrussDistributedLoad final : public Element {
 public:
  /// `resultant` = load times the bar's undeformed length [force].
  explicit TrussDistributedLoad(const Vec2& resultant) : resultant_(resultant) {}

  int unknown_count() const override { return 4; }
  double evaluate(const double* u, double* f, double* K) const override;

 private:
  Vec2 resultant_;
};

}  // namespace arcwall
