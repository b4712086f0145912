#pragma once

#include <array>
#include <memory>

#include "core/types.hpp"
#include "elements/classic_beam_energy.hpp"
#include "elements/element.hpp"
#include "elements/slender_beam.hpp"

namespace arcwall {

/// A stretch of a beam between two nodes in its stress-free shape.
struct BeamReference {
  Vec2 chord{};         ///< from the first node to the second [length]
  double length = 0.0;  ///< of the axis between them, ≥ |chord| [length]
  double slope1 = 0.0;  ///< angle of the axis at the first node against the chord [rad]
  double slope2 = 0.0;  ///< the same at the second
};

/// Euler-Bernoulli beam of any displacement and rotation: u linear, w cubic against the current chord.
///
/// Unknowns: u1, w1, θ1, u2, w2, θ2. Forces follow from total natural deformations, so they do not depend on the path;
/// converges with order 4 to the extensible elastica, initially curved members included (docs/theory.md, section 2).
class ClassicBeam final : public Element, public SlenderBeam {
 public:
  /// Between fixed material points: `force_rate` is zero.
  ClassicBeam(const BeamReference& reference, double EA, double EI);

  /// Between points that may slide. Angles inside do not matter.
  ClassicBeam(const StretchReference& stretch, double EA, double EI);

  int unknown_count() const override { return 6; }
  double evaluate(const double* u, double* f, double* K) const override;

  /// As Selke and Kikuchi have it; u = 0.
  std::unique_ptr<Element> updated(const double* u) const override;

  void respond(const BeamEnds& ends, bool with_rates, BeamResponse& out) const override;

  /// The angle is quadratic along the axis; order 4 between the ends.
  BeamPlace place(const BeamEnds& ends, double xi) const override;

  const ClassicBeamMaterial<double>& material() const { return material_; }

 private:
  RestChord rest() const;

  ClassicBeamMaterial<double> material_;
  double EA_, EI_;
  std::array<ClassicBeamRate<double>, 2> rates_;
};

}  // namespace arcwall
