#pragma once

#include <array>
#include <memory>
#include <vector>

#include "core/types.hpp"
#include "elements/compliant_wall.hpp"
#include "elements/element.hpp"
#include "elements/essenburg_beam.hpp"

namespace arcwall {

/// The part of an element that is pressed: between fractions of it.
struct PressedPart {
  double from = 0.0, to = 1.0;
};

/// Pressure of a compliant wall on an element of a beam:
///
///     V = ∫ W(p) ds,   p = −g where the gap g of the axis or of a face is negative
///
/// over the stress-free axis. The edges of contact inside the element are solved for, and Gauss's rule of eight points
/// is applied between them and the kinks of W, so that V is as smooth as the gap: W and W′ vanish at edges.
class WallPressure final : public DrivenElement {
 public:
  /// A node of the element: what touches there is at the place + o d + o² q of its section.
  struct Node {
    Vec2 place = Vec2::Zero();  ///< stress-free, of the axis [length]
    EssenburgNode section{};    ///< whose unknowns e and ξ are there if the stride is 5
    double offset = 0.0;        ///< o [length]
    double angle = 0.0;         ///< slender: stress-free, of the line that touches [rad]
    double kept_off = 0.0;      ///< subtracted from the wall's gap [length]
    double arc = 0.0;           ///< arc length of the axis from the first node [length]
  };
  enum class Shape {
    cubic,     ///< CubicAxis through two nodes, whose sections turn with it
    lagrange,  ///< polynomials through two or three nodes
  };

  /// `stride`: unknowns of a node, 3 or 5 with the displacements first and the rotation third.
  WallPressure(Shape shape, std::vector<Node> nodes, int stride, std::shared_ptr<const WallGap> wall,
               std::shared_ptr<const PressureLaw> law);

  int unknown_count() const override { return stride_ * static_cast<int>(nodes_.size()); }
  double evaluate_at(const double* u, double lambda, double* f, double* K, double* f_lambda) const override;

  /// The place that touches, at a fraction of the element.
  Vec2 place(const double* u, double fraction) const;

  /// The length of stress-free axis per fraction there [length].
  double length_rate(double fraction) const;

  /// The gap at a fraction [length].
  double gap(const double* u, double lambda, double fraction) const;

  /// The fraction at which the gap is least, and its value; infinite where the wall has no surface.
  struct LeastGap {
    double fraction = 0.0, value = infinity;
  };
  LeastGap least_gap(const double* u, double lambda) const;

  /// The derivatives of the gap at a fraction by the unknowns, unknown_count() entries, and by λ.
  struct GapGradient {
    std::array<double, max_unknowns> by_unknowns{};
    double rate = 0.0;
  };
  GapGradient gap_gradient(const double* u, double lambda, double fraction) const;

  /// The pressed parts, in order.
  std::vector<PressedPart> pressed(const double* u, double lambda) const;

  /// What the wall exerts on the element: force along x and z, moment about a point, and their derivatives by the
  /// unknowns and by λ.
  struct Resultant {
    std::array<double, 3> value{}, rate{};
    std::array<std::array<double, max_unknowns>, 3> by_unknowns{};
  };
  Resultant resultant(const double* u, double lambda, const Vec2& about) const;

  /// What a pressed part bears: force across the wall, the fraction at its centre, the length of axis, the sum of its
  /// forces as a vector.
  struct PartForce {
    double force = 0.0, centre = 0.0, length = 0.0;
    Vec2 vector = Vec2::Zero();
  };
  PartForce force_of(const double* u, double lambda, const PressedPart& part) const;

  /// The pressure at a fraction [force/length].
  double pressure(const double* u, double lambda, double fraction) const;

  /// Whether a pressed part ends where the wall has no surface: there forces jump.
  bool leaves_surface(const double* u, double lambda) const;

 private:
  class Curve;
  struct GaussPoint;
  template <class Visit>
  void for_each_gauss_point(const Curve& curve, double lambda, const PressedPart& part, const Visit& visit) const;

  Shape shape_;
  std::vector<Node> nodes_;
  int stride_;
  std::shared_ptr<const WallGap> wall_;
  std::shared_ptr<const PressureLaw> law_;
};

}  // namespace arcwall
