#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "contact/obstacle.hpp"

namespace arcwall {

/// How λ moves an obstacle as a rigid body: by λ · way, and by the angle λ · turn about a point that goes with it.
struct RigidMotion {
  Vec2 way = Vec2::Zero();        ///< [length]
  double turn = 0.0;              ///< [rad]
  Vec2 about = Vec2::Zero();      ///< at rest [length]
  double gone = 0.0, rate = 1.0;  ///< it is where `gone + rate λ` in place of λ brings it

  bool is_none() const { return way.isZero(0.0) && turn == 0.0; }
  double progress(double lambda) const { return gone + rate * lambda; }

  friend bool operator==(const RigidMotion& a, const RigidMotion& b) {
    return a.way == b.way && a.turn == b.turn && a.about == b.about && a.gone == b.gone && a.rate == b.rate;
  }

  /// Where a point of the body has gone.
  Vec2 moved(const Vec2& at_rest, double lambda) const;
};

/// An obstacle that λ moves as a rigid body: what the obstacle at rest says of the position as seen from it,
///
///     q(r, λ) = c + R(−λ α) (r − c − λ w),   f(r, λ) = f₀(q)
class MovingObstacle final : public Obstacle {
 public:
  MovingObstacle(std::shared_ptr<const Obstacle> at_rest, const RigidMotion& motion)
      : at_rest_(std::move(at_rest)), motion_(motion) {}

  Side side() const override { return at_rest_->side(); }
  bool faces(const Vec2& position, double lambda) const override;
  QuadraticField gap(const Vec2& position, double lambda) const override;
  LinearField gap_slope(const Vec2& position, double lambda) const override;
  QuadraticField direction(const Vec2& position, double lambda) const override;
  LinearField curvature(const Vec2& position, double lambda) const override;
  double curvature_second(const Vec2& position, double lambda) const override;
  double along(const Vec2& position, double lambda) const override;
  QuadraticField arc_length(const Vec2& position, double lambda) const override;
  double round_length() const override { return at_rest_->round_length(); }
  const std::vector<double>& knots() const override { return at_rest_->knots(); }
  bool is_smooth() const override { return at_rest_->is_smooth(); }
  double period() const override { return at_rest_->period(); }
  bool has_other_sides() const override { return at_rest_->has_other_sides(); }
  Vec2 seen_at_rest(const Vec2& position, double lambda) const override { return seen(position, lambda).position; }
  double clearance(const Vec2& position, double lambda) const override {
    return at_rest_->clearance(seen(position, lambda).position, 0.0);
  }
  std::optional<Vec2> core() const override { return at_rest_->core(); }
  std::span<const CurvatureRateJump> curvature_rate_jumps() const override { return at_rest_->curvature_rate_jumps(); }
  LinearField beyond(const CurvatureRateJump& jump, const Vec2& position, double lambda) const override;
  double half_height() const override { return at_rest_->half_height(); }
  double greatest_speed(double reach) const override;

  /// Of a turned obstacle what lies between these values of x at rest, moved along.
  std::vector<Vec2> outline(double from, double to, double lambda) const override;

 private:
  // A position as the obstacle at rest sees it, with the derivatives of that by the position and by λ.
  struct Seen {
    Vec2 position;
    Eigen::Matrix2d by_position;  // R(−λ α)
    Vec2 rate;
    Eigen::Matrix2d by_position_rate;
  };
  Seen seen(const Vec2& position, double lambda) const;
  static LinearField moved(const LinearField& field, const Seen& at);
  static QuadraticField moved(const QuadraticField& field, const Seen& at);

  std::shared_ptr<const Obstacle> at_rest_;
  RigidMotion motion_;
};

}  // namespace arcwall
