#pragma once

#include <array>
#include <memory>
#include <vector>

#include "core/types.hpp"
#include "elements/element.hpp"
#include "elements/section.hpp"

namespace arcwall {

/// Along what the quadratic term z² ξ of the Essenburg theory lies.
enum class QuadraticTerm {
  fixed,     ///< the normal of the axis without imperfection, whatever the rotation: z in eq. (15)
  director,  ///< the current director: indifferent to rotations of the whole
};

/// The section of an Essenburg beam at a node: its points are at r + z d + z² q, with the director d and the bulge q
///
///     d = (1 + e) t,   q = ξ n (fixed) or ξ t (director),   t = D turned by φ
///
/// φ is the rotation from the stress-free state, e the relative change of the director's length and ξ [1/length] the
/// quadratic change of thickness. In the axes of a straight member, d = (θx, 1 + θz): φ = atan2(−θx, 1 + θz).
struct EssenburgNode {
  Vec2 D{0.0, 1.0};  ///< stress-free director: unit normal of the axis with imperfection
  Vec2 n{0.0, 1.0};  ///< unit normal of the axis without
  QuadraticTerm quadratic = QuadraticTerm::fixed;

  struct Vectors {
    Vec2 d_change{}, d_phi{}, d_e{}, d_phi_phi{}, d_phi_e{};  ///< d − D and derivatives of d
    Vec2 q{}, q_phi{}, q_xi{}, q_phi_phi{}, q_phi_xi{};       ///< q and its derivatives
  };
  Vectors vectors(double phi, double e, double xi) const;
};

/// A stretch of an Essenburg beam in its stress-free shape: two nodes (order 1) or the ends with a middle node (order
/// 2), in the order in which they lie along the axis.
struct EssenburgReference {
  std::vector<Vec2> nodes{};              ///< positions [length]
  std::vector<EssenburgNode> sections{};  ///< as many

  int order() const { return static_cast<int>(nodes.size()) - 1; }
};

/// Material and section of an Essenburg beam.
struct EssenburgStiffness {
  double E = 0.0;                      ///< Young's modulus [force/length²]
  double nu = 0.0;                     ///< Poisson's ratio
  double shear_correction = 1.0;       ///< factor on the shear stiffness
  std::vector<SectionPoint> points{};  ///< over the height
};

/// Quadrature points and elasticity of an element, and what both of its forms do with them.
struct EssenburgElement {
  static constexpr std::size_t most_nodes = 3;
  static constexpr int vectors_a_node = 3;  ///< u, d − D, q

  /// Deformation gradient on the section's stress-free axes e1 (along) and e3 (across): f1 = e1 + Σ_j c1_j v_j,
  /// f3 = e3 + Σ_j c3_j v_j with the changes v = (u, d − D, q) of each node in turn.
  struct Point {
    double volume = 0.0;
    Vec2 e1{}, e3{};
    std::array<double, vectors_a_node * most_nodes> c1{}, c3{};
  };

  /// Energy of a point and its derivatives in (f1, f3), times the volume.
  struct Response {
    double U = 0.0;
    Vec2 P1{}, P3{};
    Eigen::Matrix2d A11{}, A13{}, A33{};
  };

  EssenburgElement(const EssenburgReference& reference, const EssenburgStiffness& stiffness, int axial_points);

  double C11, C13, G;
  std::vector<EssenburgNode> sections;
  std::vector<Point> points;

 private:
  void add_points(const EssenburgReference& reference, double xi, double weight,
                  const std::vector<SectionPoint>& heights);
};

/// Beam whose thickness changes (Essenburg 1975; eqs. (15) to (17) of Selke and Kikuchi): Green's strain, St
/// Venant-Kirchhoff's law in plane stress across the width, any displacement and rotation.
///
/// Unknowns: u, w, φ, e, ξ of each node along the axis. Positions, directors and bulges are interpolated, which for
/// eq. (15) is the interpolation of its five fields. Shape functions of degree `order`, integrated with `order` Gauss
/// points along the axis so that nothing locks, and with the section's points over the height.
class EssenburgBeam final : public Element {
 public:
  static constexpr int unknowns_a_node = 5;

  /// `axial_points` other than the order shows what it is good for: one more than the order locks.
  EssenburgBeam(const EssenburgReference& reference, const EssenburgStiffness& stiffness, int axial_points)
      : element_(std::make_shared<const EssenburgElement>(reference, stiffness, axial_points)) {}
  EssenburgBeam(const EssenburgReference& reference, const EssenburgStiffness& stiffness)
      : EssenburgBeam(reference, stiffness, reference.order()) {}

  int unknown_count() const override { return unknowns_a_node * static_cast<int>(element_->sections.size()); }
  double evaluate(const double* u, double* f, double* K) const override;
  std::unique_ptr<Element> updated(const double* u) const override;

 private:
  EssenburgElement::Response respond(const EssenburgElement::Point& at, const Vec2& h1, const Vec2& h3,
                                     bool tangent) const;

  std::shared_ptr<const EssenburgElement> element_;
};

}  // namespace arcwall
