#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "contact/contact_point.hpp"
#include "contact/obstacle.hpp"
#include "core/tracked_point.hpp"

namespace arcwall {

/// A gap with its derivatives by the tracked point's unknowns (sizes as in PointKinematics), and the rates of the gap
/// and of its gradient by λ at fixed unknowns: obstacles may move, and so may supports on which the point hangs.
struct Gap {
  using Gradient = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, PointKinematics::max_unknowns, 1>;

  double value = 0.0;
  Gradient gradient{};
  PointKinematics::LocalSquare hessian{};
  double rate = 0.0;
  Gradient gradient_rate{};
};

/// A body point and an obstacle that it must not enter. The gap is that of the obstacle where the point is.
class Candidate {
 public:
  Candidate(std::unique_ptr<TrackedPoint> point, std::shared_ptr<const Obstacle> obstacle, ContactLabel label)
      : point_(std::move(point)), obstacle_(std::move(obstacle)), label_(std::move(label)) {}

  const TrackedPoint& point() const { return *point_; }
  const Obstacle& obstacle() const { return *obstacle_; }
  const ContactLabel& label() const { return label_; }

  /// Whether the obstacle has a surface that faces the point.
  bool faces_wall(const State& state) const { return obstacle_->faces(point_->position(state), state.lambda); }

  /// The gap [length]; infinite where there is no surface.
  double gap(const State& state) const;

  /// Gap and derivatives; only where faces_wall().
  void gap(const State& state, Gap& out) const;

  /// The arc length along the obstacle's tangent, which has the body to its left, of the place nearest to where
  /// friction acts, and its derivatives by that point's unknowns; only where faces_wall(). Of a closed obstacle the
  /// round that is nearest to `near` [length].
  void place(const State& state, double near, Gap& out) const;

  /// The field of that arc length about a position that the obstacle faces.
  QuadraticField place_field(const Vec2& position, double lambda) const;

  /// The unit tangent of the obstacle with the body to its left, where friction acts; only where the gap vanishes.
  Vec2 tangent(const State& state) const;

  /// The coefficient of Coulomb friction μ ≥ 0.
  double friction() const { return friction_; }

  /// `at`: the point at which friction acts, and whose place() counts; null: the tracked point.
  void set_friction(double coefficient, std::unique_ptr<TrackedPoint> at = nullptr) {
    friction_ = coefficient;
    rubbing_point_ = std::move(at);
  }

  /// The point at which friction acts.
  const TrackedPoint& rubbing_point() const { return rubbing_point_ ? *rubbing_point_ : *point_; }

  /// Rate of the gap along a direction; 0 where there is no surface.
  double gap_rate(const State& state, const Direction& direction) const;

  /// The number of the candidate of the same point whose gap is minus this one's wherever the point is: the obstacles
  /// of both hold it from two sides without clearance. Empty where there is none.
  std::optional<Index> opposite() const { return opposite_; }
  void set_opposite(Index other) { opposite_ = other; }

  /// The unit vector along which the obstacle presses; only where faces_wall().
  Vec2 normal(const State& state) const { return obstacle_->normal(point_->position(state), state.lambda); }

 private:
  std::unique_ptr<TrackedPoint> point_, rubbing_point_{};
  std::shared_ptr<const Obstacle> obstacle_;
  ContactLabel label_;
  std::optional<Index> opposite_{};
  double friction_ = 0.0;
};

}  // namespace arcwall
