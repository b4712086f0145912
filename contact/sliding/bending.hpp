#pragma once

#include <optional>

#include "contact/sliding/touch.hpp"

namespace arcwall::sliding {

/// How much more the obstacle bends towards the body than the body does at a tracked point, where the body does not lie
/// on the obstacle: > 0 where contact is at a point [1/length]. (8.5) of docs/theory.md. Of an open point the obstacle
/// as it is seen from there: where this vanishes the least gap that it follows is no least one any more.
double curvature_gap(const SlidingSetting& setting, const SlidingState& at, std::size_t point);

/// The same of any touch, by what the body has on one side of it.
double gap_of_curvatures(const SlidingSetting& setting, const SlidingState& at, const Touch& touch,
                         const AxisStrain& strain);

/// The same at an end of a strand that touches the obstacle tangentially.
double end_curvature_gap(const SlidingSetting& setting, const SlidingState& at, const FreeEnd& end);

/// By how much a contact at an end that touches tangentially slides when the axis tilts there, by the tilt: 1/|κ − Λ_f
/// κ_w| times Λ_f of (8.8) [length]. 0 where the body bends with the obstacle, or more.
double slide_by_tilt(const SlidingSetting& setting, const SlidingState& at, const FreeEnd& end);

/// The curvature of the curve on which the axis lies whose face, by `offset` along the normal, lies on a wall.
constexpr double parallel_curvature(double offset, double of_wall) { return of_wall / (1.0 + offset * of_wall); }

/// These with their derivatives.
struct CurvatureGap {
  double value = 0.0;
  Vector dx{}, ds{};
  double dlambda = 0.0;

  /// Adds a multiple to a derivative by all unknowns.
  void add_to(Row& row, double factor, const SlidingUnknowns& index) const;
};
CurvatureGap curvature_gap_gradient(const SlidingSetting& setting, const SlidingState& at, std::size_t point);
CurvatureGap gap_of_curvatures_gradient(const SlidingSetting& setting, const SlidingState& at, const Touch& touch,
                                        const AxisStrainGradient& strain);
CurvatureGap end_curvature_gap_gradient(const SlidingSetting& setting, const SlidingState& at, const FreeEnd& end);

/// Curvature of the obstacle at a touch, or at a tracked point [1/length].
double obstacle_curvature(const SlidingSetting& setting, const SlidingState& at, const Touch& touch);
double obstacle_curvature(const SlidingSetting& setting, const SlidingState& at, std::size_t point);

/// Whether the obstacle is straight beside a touch, or a tracked point, and up to `ahead` of it along the body.
bool obstacle_is_straight(const SlidingSetting& setting, const SlidingState& at, const Touch& touch,
                          double ahead = 0.0);
bool obstacle_is_straight(const SlidingSetting& setting, const SlidingState& at, std::size_t point, double ahead = 0.0);

/// The axis at a tracked point or at an end of a strand, from where it is held straight along a straight obstacle.
struct HeldAxis {
  Touch touch;
  std::optional<Index> point;  ///< empty: it is an end
  double s;                    ///< material coordinate of the place [length]
  Vec2 position;               ///< of the place
  double angle;                ///< of the axis [rad]
  double travel;               ///< 1 where the axis runs with the obstacle's surface, −1 where it runs against it
  double stretch;              ///< of the axis
  double lambda;
};
HeldAxis held_axis(const SlidingSetting& setting, const SlidingState& at, std::size_t point);

/// The same at an end of a strand.
HeldAxis held_axis_at_end(const SlidingSetting& setting, const SlidingState& at, const FreeEnd& end);

/// The same of a part that is pressed on a straight obstacle: at a point at one of its ends, if it has one.
HeldAxis held_axis(const SlidingSetting& setting, const SlidingState& at, const SlidingContactLayout::Segment& part);

/// Force per length with which a straight obstacle holds the axis straight, `ahead` of the point along the body; > 0
/// where it presses (8.7).
double required_pressure_on_straight_wall(const SlidingSetting& setting, const HeldAxis& held, double ahead);

/// The force by which a straight obstacle holds the axis straight up to an end: its natural curvature presses the end
/// on the obstacle where > 0 [force]; and its derivatives by the unknowns and λ.
double bent_onto_end(const SlidingSetting& setting, const HeldAxis& held, bool last);
Row bent_onto_end_gradient(const SlidingSetting& setting, const SlidingState& at, const HeldAxis& held, bool last);

/// Whether that is zero at this λ and all others, but for round-off of what it is elsewhere along the strand: as at an
/// end where the load falls to nothing. There it is no bound.
bool pressure_vanishes_for_all_lambda(const SlidingSetting& setting, const HeldAxis& held, double ahead);

/// Its derivative along the body, at a point that stays.
double required_pressure_slope_on_straight_wall(const SlidingSetting& setting, const HeldAxis& held, double ahead);

/// Its derivatives by all unknowns and by λ, at a place that stays the same of the body.
Row straight_pressure_gradient(const SlidingSetting& setting, const SlidingState& at, const HeldAxis& held,
                               double ahead);

/// Force per length that would hold the axis on its obstacle so far `ahead` along the body; > 0 where the obstacle
/// would press (8.7). Exact beside a straight obstacle.
double required_pressure(const SlidingSetting& setting, const HeldAxis& held, double ahead);

/// The same where the body is parallel to the obstacle or is to become so, 0 where it is round-off.
double required_pressure_above_roundoff(const SlidingSetting& setting, const SlidingState& at, const HeldAxis& held);
double required_pressure_above_roundoff(const SlidingSetting& setting, const SlidingState& at, std::size_t point);

/// The derivative by λ of the pressure with which a straight obstacle holds the body straight at a tracked point: that
/// of what acts along the body.
double required_pressure_rate_above_roundoff(const SlidingSetting& setting, const SlidingState& at,
                                             const HeldAxis& held);
double required_pressure_rate_above_roundoff(const SlidingSetting& setting, const SlidingState& at, std::size_t point);

/// Whether the body needs no pressure to lie on a straight obstacle beside a place, at this λ and at others.
bool lies_by_itself(const SlidingSetting& setting, const SlidingState& at, const HeldAxis& held);
bool lies_by_itself(const SlidingSetting& setting, const SlidingState& at, std::size_t point);

/// Of −t at each tracked point by its s: the axis goes on by the stretch along its tangent and turns by its curvature.
/// 0 where the tilt is held: the body lies on the wall or is about to. See Linearization::border_rates.
Vector border_rates(const SlidingSetting& setting, const SlidingState& at);

/// Whether a part about a point that lies on a wall by itself needs no elements: nothing but its axial force, which is
/// one number, and the moment that holds it straight, are in it. Two edges that stick at one place would leave the
/// force open.
bool lies_without_elements(const SlidingSetting& setting, const SlidingState& at, std::size_t point);

}  // namespace arcwall::sliding
