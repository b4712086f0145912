#pragma once

#include <cmath>
#include <memory>
#include <utility>

#include "contact/obstacle.hpp"

namespace arcwall::test {

/// How λ moves an obstacle as a rigid body: by λ · way, and by the angle λ · turn about a point that goes with it.
struct RigidMotion {
  Vec2 way = Vec2::Zero();    ///< [length]
  double turn = 0.0;          ///< [rad]
  Vec2 about = Vec2::Zero();  ///< at λ = 0 [length]

  bool is_none() const { return way.isZero(0.0) && turn == 0.0; }
};

/// An obstacle that λ moves as a rigid body: what the obstacle at rest says of the position as seen from it,
///
///     q(r, λ) = c + R(−λ α) (r − c − λ w),   f(r, λ) = f₀(q)
class MovingObstacle final : public Obstacle {
 public:
  MovingObstacle(std::shared_ptr<const Obstacle> at_rest, const RigidMotion& motion)
      : at_rest_(std::move(at_rest)), motion_(motion) {}

  Side side() const override { return at_rest_->side(); }

  bool faces(const Vec2& position, double lambda) const override {
    return at_rest_->faces(seen(position, lambda).position, 0.0);
  }

  QuadraticField gap(const Vec2& position, double lambda) const override {
    const Seen at = seen(position, lambda);
    return moved(at_rest_->gap(at.position, 0.0), at);
  }

  LinearField gap_slope(const Vec2& position, double lambda) const override {
    const Seen at = seen(position, lambda);
    return moved(at_rest_->gap_slope(at.position, 0.0), at);
  }

  QuadraticField direction(const Vec2& position, double lambda) const override {
    const Seen at = seen(position, lambda);
    QuadraticField angle = moved(at_rest_->direction(at.position, 0.0), at);
    angle.value += lambda * motion_.turn;
    angle.rate += motion_.turn;
    return angle;
  }

  LinearField curvature(const Vec2& position, double lambda) const override {
    const Seen at = seen(position, lambda);
    return moved(at_rest_->curvature(at.position, 0.0), at);
  }

  double along(const Vec2& position, double lambda) const override {
    return at_rest_->along(seen(position, lambda).position, 0.0);
  }

  const std::vector<double>& knots() const override { return at_rest_->knots(); }

  /// Of a motion without turns.
  std::vector<Vec2> outline(double from, double to, double lambda) const override {
    const Vec2 way = lambda * motion_.way;
    std::vector<Vec2> line = at_rest_->outline(from - way.x(), to - way.x(), 0.0);
    for (Vec2& point : line) point += way;
    return line;
  }

 private:
  using Mat2 = Eigen::Matrix2d;

  // A position as the obstacle at rest sees it, with the derivatives of that by the position and by λ.
  struct Seen {
    Vec2 position;
    Mat2 by_position;  // R(−λ α)
    Vec2 rate;
    Mat2 by_position_rate;
  };

  Seen seen(const Vec2& position, double lambda) const {
    const double angle = -lambda * motion_.turn, c = std::cos(angle), s = std::sin(angle);
    const Mat2 turned{{c, -s}, {s, c}}, turned_by_angle{{-s, -c}, {c, -s}};
    const Vec2 from_centre = position - motion_.about - lambda * motion_.way;
    return {.position = motion_.about + turned * from_centre,
            .by_position = turned,
            .rate = -motion_.turn * turned_by_angle * from_centre - turned * motion_.way,
            .by_position_rate = -motion_.turn * turned_by_angle};
  }

  static LinearField moved(const LinearField& field, const Seen& at) {
    const Vec2 slope(field.x, field.z);
    const Vec2 gradient = at.by_position.transpose() * slope;
    return {.value = field.value, .x = gradient.x(), .z = gradient.y(), .rate = slope.dot(at.rate)};
  }

  static QuadraticField moved(const QuadraticField& field, const Seen& at) {
    const Vec2 slope(field.x, field.z);
    const Mat2 bend{{field.xx, field.xz}, {field.xz, field.zz}};
    const Vec2 gradient = at.by_position.transpose() * slope;
    const Mat2 hessian = at.by_position.transpose() * bend * at.by_position;
    const Vec2 gradient_rate = at.by_position_rate.transpose() * slope + at.by_position.transpose() * (bend * at.rate);
    return {.value = field.value,
            .x = gradient.x(),
            .z = gradient.y(),
            .xx = hessian(0, 0),
            .xz = hessian(0, 1),
            .zz = hessian(1, 1),
            .rate = slope.dot(at.rate),
            .x_rate = gradient_rate.x(),
            .z_rate = gradient_rate.y()};
  }

  std::shared_ptr<const Obstacle> at_rest_;
  RigidMotion motion_;
};

}  // namespace arcwall::test
