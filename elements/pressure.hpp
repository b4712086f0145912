#pragma once

#include "elements/classic_beam.hpp"
#include "elements/distributed_load.hpp"
#include "elements/element.hpp"
#include "elements/reissner_beam.hpp"

namespace arcwall {

/// Potential of a pressure 1 per length of the deformed axis that acts across this axis, to its right, on a stretch
/// between two places r from a fixed origin, with the angles φ of the tangent there and the chord c:
///
///     V = −½ ∫ r × dr = −½ r1 × r2 + |c|² (φ1 − φ2)/12
///
/// on the cubic that has these ends. Nothing of it depends on the stretch's own length.
StretchLoad::Response pressure_on_stretch(const Vec2& r1, double angle1, const Vec2& r2, double angle2);

/// What the gradient of V lacks of the force on the second end of the stretch, and has too much on the first: parts
/// that cancel where the pressure goes on, see NodalTerms::PressedEnd.
inline Vec2 pressure_at_end(const Vec2& place) { return 0.5 * perp(place); }

/// The same on an element of a classic or elastica beam, whose unknowns it has.
class BeamPressure final : public Element {
 public:
  /// `first`: stress-free place of the first node, from the origin.
  BeamPressure(const BeamReference& reference, const Vec2& first) : reference_(reference), first_(first) {}

  int unknown_count() const override { return 6; }
  double evaluate(const double* u, double* f, double* K) const override;
  void complete_end_forces(const double* u, double lambda, double* f) const override;

 private:
  BeamReference reference_;
  Vec2 first_;
};

/// The same on a ReissnerBeam, or on another beam with displacements of the same shape functions: −½ Σ w_ab r_a × r_b.
class ExactPressure final : public Element {
 public:
  /// Of the unknowns of each node the first two are the displacements.
  ExactPressure(const ExactBeamReference& reference, const Vec2& first, int unknowns_a_node = 3);

  int unknown_count() const override { return stride_ * static_cast<int>(places_.size()); }
  double evaluate(const double* u, double* f, double* K) const override;
  void complete_end_forces(const double* u, double lambda, double* f) const override;

 private:
  struct Pair {
    std::size_t a, b;
    double weight;
  };
  Vec2 place(const double* u, std::size_t node) const;

  std::vector<Vec2> places_;  // stress-free, from the origin
  std::vector<Pair> pairs_;
  int stride_;
};

}  // namespace arcwall
