#pragma once

#include <array>
#include <memory>

#include "core/types.hpp"
#include "elements/axis.hpp"
#include "elements/section.hpp"

namespace arcwall {

/// A stretch of a member's stress-free axis between two material coordinates S1 < S2 (arc length of the axis without
/// imperfection), with derivatives: index 0 by S1, 1 by S2.
struct StretchReference {
  static constexpr int samples = 4;  ///< angles at 0, ⅓, ⅔ and 1 of its length

  double length = 0.0;                   ///< of the axis between them, imperfection included [length]
  Vec2 chord = Vec2::Zero();             ///< from the first end to the second [length]
  std::array<double, samples> angles{};  ///< of the axis' tangent, continuous [rad]
  std::array<double, 2> ends{};          ///< S1 and S2
  std::array<double, 2> length_rate{};
  std::array<Vec2, 2> chord_rate{Vec2::Zero(), Vec2::Zero()};
  std::array<std::array<double, samples>, 2> angle_rate{};
  std::array<double, 2> end_rate{1.0, 1.0};  ///< of S1 and of S2
};

/// How the section of a slender beam varies along its axis.
struct StretchTaper {
  std::shared_ptr<const SectionTaper> sizes{};
  double length = 0.0;      ///< of the axis, from S = 0 [length]
  double A = 0.0, I = 0.0;  ///< of the section that has the stiffnesses EA and EI of the beam

  /// Returns EA and EI of that section over those at S, as `softness`, and the inverse, as `stiffness`.
  double softness(double S) const { return A / sizes->at(S / length).A; }
  double stiffness(double S) const { return sizes->at(S / length).I / I; }
  /// Returns their derivatives by S.
  double softness_rate(double S) const {
    const double here = sizes->at(S / length).A;
    return -A * sizes->at(S / length, 1).A / (length * here * here);
  }
  double stiffness_rate(double S) const { return sizes->at(S / length, 1).I / (length * I); }
};

/// The stretch between two points of a member's stress-free shape. Angles inside that are left out are NaN.
StretchReference stretch_reference(const ImperfectAxis& shape, double from, double to,
                                   DividedPart::Inside inside = DividedPart::Inside::wanted);

/// Where the two ends of a beam element are: all that its energy depends on.
struct BeamEnds {
  Vec2 chord = Vec2::Zero();          ///< from the first end to the second, now [length]
  double angle1 = 0.0, angle2 = 0.0;  ///< of the axis' tangent at the ends, now; any winding number [rad]
};

/// Energy of a beam element and its derivatives in q = (chord.x, chord.y, angle1, angle2).
struct BeamResponse {
  double energy = 0.0;
  Eigen::Vector4d force = Eigen::Vector4d::Zero();      ///< ∂U/∂q
  Eigen::Matrix4d stiffness = Eigen::Matrix4d::Zero();  ///< ∂²U/∂q²
  /// ∂force/∂S1 and ∂force/∂S2 at fixed q.
  std::array<Eigen::Vector4d, 2> force_rate{Eigen::Vector4d::Zero(), Eigen::Vector4d::Zero()};
};

/// From derivatives by q to those by (x1, z1, angle1, x2, z2, angle2) of the ends.
inline Eigen::Matrix<double, 6, 1> at_ends(const Eigen::Vector4d& by_q) {
  Eigen::Matrix<double, 6, 1> f;
  f << -by_q[0], -by_q[1], by_q[2], by_q[0], by_q[1], by_q[3];
  return f;
}
inline Eigen::Matrix<double, 6, 6> at_ends(const Eigen::Matrix4d& by_q) {
  Eigen::Matrix<double, 4, 6> T = Eigen::Matrix<double, 4, 6>::Zero();
  T(0, 0) = T(1, 1) = -1.0;
  T(0, 3) = T(1, 4) = T(2, 2) = T(3, 5) = 1.0;
  return T.transpose() * by_q * T;
}

/// A place inside an element.
struct BeamPlace {
  Vec2 offset = Vec2::Zero();  ///< from the first end [length]
  double angle = 0.0;          ///< of the tangent, with the winding number of angle1 [rad]
  Eigen::Matrix<double, 2, 4> offset_gradient = Eigen::Matrix<double, 2, 4>::Zero();  ///< by q
  Eigen::RowVector4d angle_gradient = Eigen::RowVector4d::Zero();                     ///< by q
};

/// Unshearable beam between two material points, by where they are: the form in which the points may slide along the
/// member.
class SlenderBeam {
 public:
  virtual ~SlenderBeam() = default;

  /// Energy, force and stiffness; `force_rate` too if asked for.
  virtual void respond(const BeamEnds& ends, bool with_rates, BeamResponse& out) const = 0;

  /// The place at a fraction ξ ∈ [0, 1] of the stretch's length, consistent with the ends at 0 and 1. It is the
  /// fraction of S2 − S1 as well where there is no imperfection.
  virtual BeamPlace place(const BeamEnds& ends, double xi) const = 0;
};

}  // namespace arcwall
