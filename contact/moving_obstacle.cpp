#include "contact/moving_obstacle.hpp"

#include <cmath>

namespace arcwall {

Vec2 RigidMotion::moved(const Vec2& at_rest, double lambda) const {
  const double far = progress(lambda), c = std::cos(far * turn), s = std::sin(far * turn);
  const Vec2 arm = at_rest - about;
  return about + far * way + Vec2(c * arm.x() - s * arm.y(), s * arm.x() + c * arm.y());
}

bool MovingObstacle::faces(const Vec2& position, double lambda) const {
  return at_rest_->faces(seen(position, lambda).position, 0.0);
}

QuadraticField MovingObstacle::gap(const Vec2& position, double lambda) const {
  const Seen at = seen(position, lambda);
  return moved(at_rest_->gap(at.position, 0.0), at);
}

LinearField MovingObstacle::gap_slope(const Vec2& position, double lambda) const {
  const Seen at = seen(position, lambda);
  return moved(at_rest_->gap_slope(at.position, 0.0), at);
}

QuadraticField MovingObstacle::direction(const Vec2& position, double lambda) const {
  const Seen at = seen(position, lambda);
  QuadraticField angle = moved(at_rest_->direction(at.position, 0.0), at);
  angle.value += motion_.progress(lambda) * motion_.turn;
  angle.rate += motion_.rate * motion_.turn;
  return angle;
}

QuadraticField MovingObstacle::arc_length(const Vec2& position, double lambda) const {
  const Seen at = seen(position, lambda);
  return moved(at_rest_->arc_length(at.position, 0.0), at);
}

LinearField MovingObstacle::curvature(const Vec2& position, double lambda) const {
  const Seen at = seen(position, lambda);
  return moved(at_rest_->curvature(at.position, 0.0), at);
}

double MovingObstacle::curvature_second(const Vec2& position, double lambda) const {
  return at_rest_->curvature_second(seen(position, lambda).position, 0.0);
}

LinearField MovingObstacle::beyond(const CurvatureRateJump& jump, const Vec2& position, double lambda) const {
  const Seen at = seen(position, lambda);
  return moved(at_rest_->beyond(jump, at.position, 0.0), at);
}

double MovingObstacle::along(const Vec2& position, double lambda) const {
  return at_rest_->along(seen(position, lambda).position, 0.0);
}

double MovingObstacle::greatest_speed(double reach) const {
  return std::abs(motion_.rate) * (motion_.way.norm() + std::abs(motion_.turn) * reach);
}

std::vector<Vec2> MovingObstacle::outline(double from, double to, double lambda) const {
  const double way = motion_.turn == 0.0 ? motion_.progress(lambda) * motion_.way.x() : 0.0;
  std::vector<Vec2> line = at_rest_->outline(from - way, to - way, 0.0);
  for (Vec2& point : line) point = motion_.moved(point, lambda);
  return line;
}

MovingObstacle::Seen MovingObstacle::seen(const Vec2& position, double lambda) const {
  const double far = motion_.progress(lambda), turn_rate = motion_.rate * motion_.turn;
  const double angle = -far * motion_.turn, c = std::cos(angle), s = std::sin(angle);
  const Eigen::Matrix2d turned{{c, -s}, {s, c}}, turned_by_angle{{-s, -c}, {c, -s}};
  const Vec2 from_centre = position - motion_.about - far * motion_.way;
  return {.position = motion_.about + turned * from_centre,
          .by_position = turned,
          .rate = -turn_rate * turned_by_angle * from_centre - motion_.rate * turned * motion_.way,
          .by_position_rate = -turn_rate * turned_by_angle};
}

LinearField MovingObstacle::moved(const LinearField& field, const Seen& at) {
  const Vec2 slope(field.x, field.z);
  const Vec2 gradient = at.by_position.transpose() * slope;
  return {.value = field.value, .x = gradient.x(), .z = gradient.y(), .rate = slope.dot(at.rate)};
}

QuadraticField MovingObstacle::moved(const QuadraticField& field, const Seen& at) {
  const Vec2 slope(field.x, field.z);
  const Eigen::Matrix2d bend{{field.xx, field.xz}, {field.xz, field.zz}};
  const Vec2 gradient = at.by_position.transpose() * slope;
  const Eigen::Matrix2d hessian = at.by_position.transpose() * bend * at.by_position;
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

}  // namespace arcwall
