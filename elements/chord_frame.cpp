#include "elements/chord_frame.hpp"

#include <boost/math/quadrature/gauss.hpp>

namespace arcwall {

namespace {

using FrameGauss = boost::math::quadrature::gauss<double, 7>;

// A vector in the frame of the chord with its gradient by (l, b, σ).
struct Path {
  Vec2 value = Vec2::Zero();
  Eigen::Matrix<double, 2, 3> gradient = Eigen::Matrix<double, 2, 3>::Zero();
};

struct Angle {
  double value;
  Eigen::RowVector3d gradient;
};

Angle angle_at(const BentAxis& axis, double x) {
  Eigen::Matrix<double, 1, BentAxis::terms> powers;
  powers[0] = 1.0;
  for (Index k = 1; k < BentAxis::terms; ++k) powers[k] = powers[k - 1] * x;
  return {.value = powers * axis.angle, .gradient = powers * axis.angle_gradient};
}

// h (1 + N/EA) t at ξ, N = n·t.
Path tangent(const BentAxis& axis, double xi) {
  const Angle angle = angle_at(axis, xi - 0.5);
  const Vec2 t(std::cos(angle.value), std::sin(angle.value));
  const double EA = axis.EA_at(xi);
  const double strain = axis.force.dot(t) / EA, strain_rate = axis.force.dot(perp(t)) / EA;
  return {.value = axis.length * (1.0 + strain) * t,
          .gradient = axis.length * (((1.0 + strain) * perp(t) + strain_rate * t) * angle.gradient +
                                     t * (t.transpose() * axis.force_gradient) / EA)};
}

// ∫ of it from 0 to ξ.
Path path_to(const BentAxis& axis, double xi) {
  Path path;
  const auto add = [&](double node, double weight) {
    const Path here = tangent(axis, 0.5 * xi * (1.0 + node));
    path.value += 0.5 * xi * weight * here.value;
    path.gradient += 0.5 * xi * weight * here.gradient;
  };
  for (std::size_t i = 0; i < FrameGauss::abscissa().size(); ++i) {
    const double node = FrameGauss::abscissa()[i], weight = FrameGauss::weights()[i];
    add(node, weight);
    if (node != 0.0) add(-node, weight);
  }
  return path;
}

}  // namespace

Eigen::Matrix<double, 3, 4> chord_gradient(const ChordMotion& at) {
  const double c = at.x / at.length, s = at.y / at.length, k = 6.0 / at.length;
  Eigen::Matrix<double, 3, 4> gradient;
  gradient << c, s, 0.0, 0.0,  //
      0.0, 0.0, -1.0, 1.0,     //
      k * s, -k * c, 3.0, 3.0;
  return gradient;
}

void respond_along(const ChordMotion& at, const ChordSlopes& U, const ChordCurvatures& V, BeamResponse& out) {
  const double l = at.length;
  const Eigen::Matrix<double, 3, 4> D = chord_gradient(at);
  Eigen::Matrix3d W;
  W << V.ll, V.lb, V.ls, V.lb, V.bb, V.bs, V.ls, V.bs, V.ss;
  const Vec2 r(at.x / l, at.y / l), z = perp(r);
  out.force = D.transpose() * Eigen::Vector3d(U.l, U.b, U.s);
  out.stiffness = D.transpose() * W * D;
  out.stiffness.topLeftCorner<2, 2>() +=
      U.l / l * z * z.transpose() + 6.0 * U.s / (l * l) * (r * z.transpose() + z * r.transpose());
}

RestChord rest_chord(const StretchReference& stretch) {
  const double direction = std::atan2(stretch.chord.y(), stretch.chord.x());
  const auto against_chord = [&](double angle) { return std::remainder(angle - direction, 2.0 * pi); };
  return {.chord = stretch.chord,
          .length = stretch.chord.norm(),
          .slope1 = against_chord(stretch.angles.front()),
          .slope2 = against_chord(stretch.angles.back())};
}

std::array<RestChord, 2> rest_chord_rate(const StretchReference& stretch) {
  const Vec2 &r = stretch.chord, z = perp(r);
  std::array<RestChord, 2> rates;
  for (std::size_t i = 0; i < 2; ++i) {
    const Vec2& rate = stretch.chord_rate[i];
    const double direction_rate = z.dot(rate) / r.squaredNorm();
    rates[i] = {.chord = rate,
                .length = r.dot(rate) / r.norm(),
                .slope1 = stretch.angle_rate[i].front() - direction_rate,
                .slope2 = stretch.angle_rate[i].back() - direction_rate};
  }
  return rates;
}

// The path from the first end, and a share of what quadrature and the element's own approximations leave open at the
// second, so that both ends are met:
//
//   o(ξ) = p(ξ) + ξ (l e_x − p(1)),   offset = Q(β) o                                                    (3)
BeamPlace place_on(const BentAxis& axis, const ChordMotion& at, double angle1, double xi) {
  const Path here = path_to(axis, xi), end = path_to(axis, 1.0);
  const Angle angle = angle_at(axis, xi - 0.5), first = angle_at(axis, -0.5);
  Path o{.value = here.value + xi * (Vec2(at.length, 0.0) - end.value), .gradient = here.gradient - xi * end.gradient};
  o.gradient(0, 0) += xi;

  const double c = at.x / at.length, s = at.y / at.length;
  Eigen::Matrix2d Q;
  Q << c, -s, s, c;
  const Eigen::RowVector4d direction_gradient(-s / at.length, c / at.length, 0.0, 0.0);
  const Eigen::Matrix<double, 3, 4> D = chord_gradient(at);
  const Vec2 offset = Q * o.value;
  return {.offset = offset,
          .angle = angle1 + (angle.value - first.value),
          .offset_gradient = perp(offset) * direction_gradient + Q * o.gradient * D,
          .angle_gradient = direction_gradient + angle.gradient * D};
}

}  // namespace arcwall
