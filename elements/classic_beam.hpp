#pragma once

#include <array>
#include <memory>

#include "core/types.hpp"
#include "elements/element.hpp"
#include "elements/slender_beam.hpp"

namespace arcwall {

struct RestChord;

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

  /// Between points that may slide.
  ClassicBeam(const StretchReference& stretch, double EA, double EI);

  int unknown_count() const override { return 6; }
  double evaluate(const double* u, double* f, double* K) const override;

  /// As Selke and Kikuchi have it; u = 0.
  std::unique_ptr<Element> updated(const double* u) const override;

  void respond(const BeamEnds& ends, bool with_rates, BeamResponse& out) const override;

  /// The angle is quadratic along the axis; order 4 between the ends.
  BeamPlace place(const BeamEnds& ends, double xi) const override;

 private:
  struct Deformation;
  RestChord rest() const;
  Deformation deform(double length, double stretch, double d1, double d2) const;

  Vec2 chord_;           // stress-free
  double chord_length_;  // its length l₀
  double length_;        // h, of the stress-free axis
  double b_, s_, c_;     // stress-free bend t2 − t1, skew 3 (t1 + t2) and variation of curvature
  double shortening_;    // h/l₀ − 1
  double EA_, EI_;

  // Of the stress-free state by a material coordinate; `axial` is that of l₀ (1 + p₀).
  struct Rate {
    double length = 0.0, axial = 0.0, b = 0.0, s = 0.0, c = 0.0;
  };
  std::array<Rate, 2> rates_;
};

}  // namespace arcwall
