#pragma once

#include <array>
#include <vector>

#include "core/state.hpp"

namespace arcwall {

/// Stores the position of a material point and its derivatives by the unknowns it depends on (at most five).
struct PointKinematics {
  static constexpr int max_unknowns = 5;
  template <int Rows>
  using Local = Eigen::Matrix<double, Rows, Eigen::Dynamic, Eigen::ColMajor, Rows, max_unknowns>;
  using LocalSquare =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, max_unknowns, max_unknowns>;

  Vec2 position{};
  Local<2> jacobian{};                     ///< ∂position/∂unknowns
  std::array<LocalSquare, 2> curvature{};  ///< second derivatives of x and of z

  Vec2 rate = Vec2::Zero();  ///< ∂position/∂λ at fixed unknowns: nonzero if supports move the point
  Local<2> jacobian_rate{};  ///< ∂jacobian/∂λ at fixed unknowns
};

/// Stores position and velocity of a material point.
struct PointMotion {
  Vec2 position{}, velocity{};
};

/// Evaluates the position of a possible contact point and its derivatives.
class TrackedPoint {
 public:
  virtual ~TrackedPoint() = default;

  /// Returns indices in x of the unknowns of the position: at most PointKinematics::max_unknowns, all ≥ 0.
  virtual const std::vector<Index>& unknowns() const = 0;

  /// Returns the position [length].
  virtual Vec2 position(const State& state) const = 0;

  /// Returns the position and its derivative along the direction.
  virtual PointMotion motion(const State& state, const Direction& direction) const = 0;

  /// Writes position and derivatives; sizes as unknowns().
  virtual void kinematics(const State& state, PointKinematics& out) const = 0;
};

}  // namespace arcwall
