#include "elements/cubic_axis.hpp"

#include <cmath>
#include <utility>

#include "elements/chord_frame.hpp"

namespace arcwall {

CubicAxis::CubicAxis(const Vec2& r1, double angle1, const Vec2& r2, double angle2)
    : first_(r1), chord_(r2 - r1), across_(perp(chord_)), square_(chord_.squaredNorm()) {
  const double beta = std::atan2(chord_.y(), chord_.x());
  turn1_ = within_half_a_turn(angle1 - beta);
  turn2_ = within_half_a_turn(angle2 - beta);
}

// With H = N1 (θ1 − β) + N2 (θ2 − β) and ∂β/∂c = c⊥/|c|²,
//
//   ∂r/∂c = ξ + H ∂c⊥/∂c − (N1 + N2) c⊥ c⊥ᵀ/|c|²,   ∂r/∂θ_i = N_i c⊥                                (1)
CubicAxis::Place CubicAxis::at(double xi) const {
  const Shapes N(xi);
  const double H = N.first * turn1_ + N.second * turn2_;
  Eigen::Matrix2d by_chord;
  by_chord << xi, -H, H, xi;
  by_chord -= N.sum() / square_ * across_ * across_.transpose();
  Place place{.position = first_ + xi * chord_ + H * across_};
  place.gradient.leftCols<2>() = Eigen::Matrix2d::Identity() - by_chord;
  place.gradient.col(2) = N.first * across_;
  place.gradient.middleCols<2>(3) = by_chord;
  place.gradient.col(5) = N.second * across_;
  return place;
}

// --- sums -----------------------------------------------------------------------------------------------------------

// With c = r2 − r1 the derivative by r1 is that at fixed c less that by c.
CubicAxis::Vector6 CubicAxis::Sum::gradient() const {
  Vector6 out;
  out << by_first_ - by_chord_, axis_.across_.dot(turned_[0]), by_chord_, axis_.across_.dot(turned_[1]);
  return out;
}

// Second derivatives of the places belong to Σ N_i q, as add_second() below has them of one.
CubicAxis::Matrix6 CubicAxis::Sum::hessian() const {
  const Vec2& a = axis_.across_;
  const Vec2 q = turned_[0] + turned_[1];
  const auto across = [](const Vec2& of) { return Vec2(of.y(), -of.x()); };
  const Eigen::Matrix2d cc = chord_chord_ + axis_.second_by_chord(q);
  const Eigen::Matrix2d mixed = k_chord_ - cc;  // by r1 at fixed c, and c, less that by c twice
  Matrix6 out;
  out.block<2, 2>(0, 0) = cc - k_chord_ - k_chord_.transpose();
  out(0, 0) += k_.x();
  out(1, 1) += k_.y();
  out.block<2, 2>(0, 3) = mixed;
  out.block<2, 2>(3, 0) = mixed.transpose();
  out.block<2, 2>(3, 3) = cc;
  for (const std::size_t i : {0u, 1u}) {
    const Index angle = i == 0 ? 2 : 5;
    const Vec2 by_chord = chord_turn_[i] + across(turned_[i]), by_first = k_turn_[i].cwiseProduct(a) - by_chord;
    out.block<2, 1>(0, angle) = by_first;
    out.block<2, 1>(3, angle) = by_chord;
    out.block<1, 2>(angle, 0) = by_first.transpose();
    out.block<1, 2>(angle, 3) = by_chord.transpose();
  }
  const auto turns = [&](std::size_t i) {
    return a.x() * a.x() * turn_turn_[i].x() + a.y() * a.y() * turn_turn_[i].y();
  };
  out(2, 2) = turns(0);
  out(2, 5) = out(5, 2) = turns(1);
  out(5, 5) = turns(2);
  return out;
}

// The derivative of (1), with p = q·∂c⊥/∂c and c⊥ᵀ ∂c⊥/∂c = cᵀ:
//
//   ∂²(q·r)/∂c² = −(N1 + N2)/|c|² [p c⊥ᵀ + c⊥ pᵀ + (q·c⊥) (c⊥ ∂/∂c + …)],   ∂²(q·r)/∂c∂θ_i = N_i p
Eigen::Matrix2d CubicAxis::second_by_chord(const Vec2& q) const {
  const Vec2 p(q.y(), -q.x());
  const double along = chord_.x(), up = chord_.y(), push = q.dot(across_) / square_;
  Eigen::Matrix2d cc = p * across_.transpose() + across_ * p.transpose(), turned;
  turned << 2.0 * along * up, up * up - along * along, up * up - along * along, -2.0 * along * up;
  cc += push * turned;
  return cc / -square_;
}

void CubicAxis::add_second(double xi, const Vec2& q, Matrix6& to) const {
  const Shapes N(xi);
  const Vec2 p(q.y(), -q.x());
  const Eigen::Matrix2d cc = N.sum() * second_by_chord(q);
  const auto add = [&](Index i, Index j, double sign) { to.block<2, 2>(i, j) += sign * cc; };
  add(0, 0, 1.0);
  add(3, 3, 1.0);
  add(0, 3, -1.0);
  add(3, 0, -1.0);
  for (const auto& [angle, shape] : {std::pair(Index{2}, N.first), std::pair(Index{5}, N.second)})
    for (const auto& [end, sign] : {std::pair(Index{0}, -1.0), std::pair(Index{3}, 1.0)}) {
      to.block<2, 1>(end, angle) += sign * shape * p;
      to.block<1, 2>(angle, end) += sign * shape * p.transpose();
    }
}

}  // namespace arcwall
