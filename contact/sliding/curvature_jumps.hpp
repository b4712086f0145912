#pragma once

#include <optional>

#include "contact/sliding/touch.hpp"
#include "core/observable.hpp"

namespace arcwall::sliding {

/// A place beside a touch where the curvature of its wall jumps, as where an arc goes over into a line.
struct CurvatureJump {
  double distance = 0.0;            ///< along the axis [length]
  double here = 0.0, behind = 0.0;  ///< curvature of the wall at the touch and beyond the place [1/length]
  Vec2 place = Vec2::Zero();        ///< of the wall
};

/// Looks for one within a reach, in the direction of the axis (`to` = 1) or against it (−1). Empty where there is none,
/// and on walls that end there.
std::optional<CurvatureJump> curvature_jump_beside(const SlidingSetting& setting, const Touch& touch,
                                                   const AxisPlace& axis, double to, double reach, double lambda);

/// How far a tracked point is beyond such a place, along the body or against it [length].
class BeyondJump final : public Observable {
 public:
  /// `touch`: one beside the place, at a state, from which the body comes to it with the axis (`to` = 1) or against it.
  /// `point`: the tracked point of the states that it is asked about.
  BeyondJump(const SlidingSetting& setting, const SlidingState& at, const Touch& touch, const CurvatureJump& jump,
             double to, std::size_t point);
  double value(const State& state) const override;
  Row gradient(const State& state) const override;

 private:
  const SlidingSetting& setting_;
  std::size_t point_;
  CurvatureRateJump at_rest_{};
  double sign_;
};

}  // namespace arcwall::sliding
