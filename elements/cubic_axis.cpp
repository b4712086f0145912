#include "elements/cubic_axis.hpp"

#include <cmath>
#include <utility>

#include "elements/chord_frame.hpp"

namespace arcwall {

namespace {

// Of the turns of the ends against the chord.
struct Shapes {
  double first, second;
  explicit Shapes(double xi) : first(xi * (1.0 - xi) * (1.0 - xi)), second(-xi * xi * (1.0 - xi)) {}
  double sum() const { return first + second; }
};

}  // namespace

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

// The derivative of (1), with p = q·∂c⊥/∂c and c⊥ᵀ ∂c⊥/∂c = cᵀ:
//
//   ∂²(q·r)/∂c² = −(N1 + N2)/|c|² [p c⊥ᵀ + c⊥ pᵀ + (q·c⊥) (c⊥ ∂/∂c + …)],   ∂²(q·r)/∂c∂θ_i = N_i p
void CubicAxis::add_second(double xi, const Vec2& q, Matrix6& to) const {
  const Shapes N(xi);
  const Vec2 p(q.y(), -q.x());
  const double along = chord_.x(), up = chord_.y(), push = q.dot(across_) / square_;
  Eigen::Matrix2d cc = p * across_.transpose() + across_ * p.transpose(), turned;
  turned << 2.0 * along * up, up * up - along * along, up * up - along * along, -2.0 * along * up;
  cc += push * turned;
  cc *= -N.sum() / square_;
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
