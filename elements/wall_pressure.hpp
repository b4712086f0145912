#pragma once

#include <array>
#include <memory>
#include <utility>
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
///
/// Friction is no potential: rubbed() tells what it depends on.
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

  /// Friction acts on the line of another one with the same nodes; empty: on what touches.
  void set_rubbing_line(std::unique_ptr<const WallPressure> line) { rubbing_ = std::move(line); }

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

  /// Material points at which friction acts: the ends of the element, where ends of members touch, and so many in all
  /// at equal distances. Each stands for the part of the element that is nearest to it.
  static constexpr std::size_t rubbing_points = 5;
  static constexpr double rubbing_point(std::size_t point) { return double(point) / double(rubbing_points - 1); }

  /// That part of the element.
  static PressedPart nearest_to(std::size_t point);

  /// What friction depends on at such a point: the force across the wall on its part of the element, and its place
  /// along the wall [force, length], with their derivatives by the unknowns and by λ.
  struct Rubbed {
    bool faces_wall = false;  ///< else there is no place
    double length = 0.0;      ///< of the stress-free axis
    double force = 0.0, force_rate = 0.0;
    double place = 0.0, place_rate = 0.0;
    std::array<double, max_unknowns> force_by{}, place_by{};
  };
  std::array<Rubbed, rubbing_points> rubbed(const double* u, double lambda) const;

  /// Adds `factor` times the second derivatives of the place of a point by the unknowns, in the lower triangle of K,
  /// and by these and λ.
  void add_second_of_place(const double* u, double lambda, std::size_t point, double factor, double* K,
                           double* f_lambda) const;

  /// What a friction force T along the wall exerts at a point, T given with its derivatives.
  struct ForceAlong {
    double value = 0.0, rate = 0.0;
    std::array<double, max_unknowns> by_unknowns{};
  };
  Resultant friction_resultant(const double* u, double lambda, std::size_t point, const ForceAlong& T,
                               const Vec2& about) const;

  /// The unit tangent of the wall at a point.
  Vec2 tangent(const double* u, double lambda, std::size_t point) const;

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
  std::unique_ptr<const WallPressure> rubbing_{};
};

}  // namespace arcwall
