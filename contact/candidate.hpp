#pragma once

#include <memory>

#include "contact/contact_point.hpp"
#include "contact/profile.hpp"
#include "core/tracked_point.hpp"

namespace arcwall {

/// A gap with its derivatives in the tracked point's unknowns (sizes as in PointKinematics).
struct Gap {
  double value = 0.0;
  Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, PointKinematics::max_unknowns, 1> gradient{};
  PointKinematics::LocalSquare hessian{};
};

/// A body point and an obstacle that it must not enter. The gap is that of surface_gap(), where the point is.
class Candidate {
 public:
  Candidate(std::unique_ptr<TrackedPoint> point, std::shared_ptr<const Profile> wall, Side side, ContactLabel label)
      : point_(std::move(point)), wall_(std::move(wall)), side_(side), label_(std::move(label)) {}

  const TrackedPoint& point() const { return *point_; }
  const ContactLabel& label() const { return label_; }

  /// Whether there is a surface at the point's x.
  bool faces_wall(const State& state) const { return wall_->covers(point_->position(state).x()); }

  /// The gap [length]; infinite where there is no surface.
  double gap(const State& state) const;

  /// Gap, gradient and Hessian; only where faces_wall().
  void gap(const State& state, Gap& out) const;

  /// Rate of the gap along a direction; 0 where there is no surface.
  double gap_rate(const State& state, const Direction& direction) const;

  /// The unit vector along which the obstacle presses; only where faces_wall().
  Vec2 normal(const State& state) const { return surface_normal(*wall_, side_, point_->position(state)); }

 private:
  std::unique_ptr<TrackedPoint> point_;
  std::shared_ptr<const Profile> wall_;
  Side side_;
  ContactLabel label_;
};

}  // namespace arcwall
