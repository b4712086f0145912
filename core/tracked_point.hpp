#pragma once

#include <array>
#include <vector>

#include "core/state.hpp"

namespace arcwall {

/// Position of a body point and its derivatives in the unknowns it depends on (at most five).
struct PointKinematics {
  static constexpr int max_unknowns = 5;
  template <int Rows>
  using Local = Eigen::Matrix<double, Rows, Eigen::Dynamic, Eigen::ColMajor, Rows, max_unknowns>;
  using LocalSquare =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, max_unknowns, max_unknowns>;

  Vec2 position{};
  Local<2> jacobian{};                     ///< ∂position/∂unknowns
  std::array<LocalSquare, 2> curvature{};  ///< second derivatives of x and of z

  Vec2 rate = Vec2::Zero();  ///< of the position by λ at fixed unknowns: not 0 where supports move the point
  Local<2> jacobian_rate{};  ///< of the jacobian by λ, likewise
};

/// Where a body point is and how it moves.
struct PointMotion {
  Vec2 position{}, velocity{};
};

/// A point of the body that may touch an obstacle: where it is and how it moves with the unknowns.
class TrackedPoint {
 public:
  virtual ~TrackedPoint() = default;

  /// Indices in x of the unknowns the position depends on; at most PointKinematics::max_unknowns, none negative.
  virtual const std::vector<Index>& unknowns() const = 0;

  virtual Vec2 position(const State& state) const = 0;

  /// The velocity is that along the direction.
  virtual PointMotion motion(const State& state, const Direction& direction) const = 0;

  /// Sizes follow unknowns().
  virtual void kinematics(const State& state, PointKinematics& out) const = 0;
};

}  // namespace arcwall
