#pragma once

#include <array>
#include <utility>

#include "elements/distributed_load.hpp"
#include "elements/element.hpp"
#include "elements/foundation_law.hpp"
#include "elements/reissner_beam.hpp"
#include "elements/slender_beam.hpp"

namespace arcwall {

/// Potential of springs to the ground along a slender beam, k [force/length²] in x and in z where they are linear:
///
///     V = ½ ∫ (k_x u_x² + k_z u_z²) dS,   u(S) = r(S) − R(S)
///
/// and ∫ ∫ F(u) du dS of springs with a law.
///
/// Present places r and stress-free ones R are both on the CubicAxis of the ends. Of order 4 in the element's length
/// across the axis, 2 along it.
class StretchFoundation {
 public:
  StretchFoundation(const StretchReference& stretch, FoundationLaw law);

  /// Places are measured from the stress-free place of the first end, angles are those of the axis' tangent.
  StretchLoad::Response respond(const Vec2& r1, double angle1, const Vec2& r2, double angle2) const;

  /// The energy alone, and force and stiffness where these are not null.
  double evaluate(const Vec2& r1, double angle1, const Vec2& r2, double angle2, StretchLoad::Vector6* force,
                  StretchLoad::Matrix6* stiffness) const;

 private:
  struct Place {
    double xi = 0.0, length = 0.0;                              // of the axis that it stands for
    Vec2 at_rest = Vec2::Zero();                                // R
    std::array<Vec2, 2> rest_rate{Vec2::Zero(), Vec2::Zero()};  // of R by S1 and S2
  };

  std::array<Place, 3> places_{};
  std::array<double, 2> growth_{};  // of the stretch's length by S1 and S2, by its length
  FoundationLaw law_;
};

/// The same on an element of a classic or elastica beam, whose unknowns it has: displacements and rotations of its
/// ends.
class BeamFoundation final : public Element {
 public:
  BeamFoundation(const StretchReference& stretch, FoundationLaw law);

  int unknown_count() const override { return 6; }
  double evaluate(const double* u, double* f, double* K) const override;

 private:
  StretchFoundation along_;
  Vec2 chord_;  // stress-free
  std::array<double, 2> angles_;
};

/// The same on a ReissnerBeam, or on another beam with displacements of the same shape functions.
class ExactFoundation final : public Element {
 public:
  /// Of the unknowns of each node the first two are the displacements.
  ExactFoundation(const ExactBeamReference& reference, FoundationLaw law, int unknowns_a_node = 3);

  int unknown_count() const override { return stride_ * nodes_; }
  double evaluate(const double* u, double* f, double* K) const override;

 private:
  static constexpr int most_nodes = 3;
  struct Place {
    std::array<double, most_nodes> shape{};  // N of the nodes
    double length = 0.0;                     // of the axis that it stands for
  };

  std::array<Place, 3> places_{};
  FoundationLaw law_;
  int nodes_, stride_;
};

}  // namespace arcwall
