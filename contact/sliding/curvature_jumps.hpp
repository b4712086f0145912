#pragma once

#include <optional>

#include "contact/sliding/touch.hpp"
#include "contact/wall_kink.hpp"
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

/// Returns the same as a kink that a contact passes which moves with the axis (`to` = 1) or against it. `touch`: one
/// beside the place, at a state.
WallKink kink_at(const SlidingSetting& setting, const SlidingState& at, const Touch& touch, const CurvatureJump& jump,
                 double to);

/// How far a contact is past a kink of its wall [length].
class PastKink final : public Observable {
 public:
  /// `contact`: its number in the active set of the states that the quantity is asked about.
  PastKink(const SlidingSetting& setting, std::size_t contact, const WallKink& kink)
      : setting_(setting), contact_(contact), kink_(kink) {}
  double value(const State& state) const override;
  Row gradient(const State& state) const override;

 private:
  const SlidingSetting& setting_;
  std::size_t contact_;
  WallKink kink_;
};

}  // namespace arcwall::sliding
