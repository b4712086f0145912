#pragma once

#include "contact/sliding/touch.hpp"

namespace arcwall::sliding {

/// How much more the obstacle bends towards the body than the body does at a tracked point, where the body does not lie
/// on the obstacle: > 0 where contact is at a point [1/length]. (8.5) of docs/theory.md.
struct CurvatureGap {
  double value = 0.0;
  Vector dx{}, ds{};
  double dlambda = 0.0;

  /// Adds a multiple to a derivative by all unknowns.
  void add_to(Row& row, double factor, const SlidingUnknowns& index) const;
};
CurvatureGap curvature_gap(const SlidingSetting& setting, const SlidingState& at, std::size_t point);

/// The same at an end of a strand that touches the obstacle tangentially.
CurvatureGap end_curvature_gap(const SlidingSetting& setting, const SlidingState& at, const FreeEnd& end);

/// Curvature of the obstacle at a tracked point [1/length].
double obstacle_curvature(const SlidingSetting& setting, const SlidingState& at, std::size_t point);

/// Force per length that would hold the body on the obstacle at a tracked point; > 0 where the obstacle would press,
/// 0 where that is round-off (8.7).
double holding_pressure(const SlidingSetting& setting, const SlidingState& at, std::size_t point);

/// Whether the body needs no pressure to lie on a straight obstacle behind a tracked point.
bool lies_by_itself(const SlidingSetting& setting, const SlidingState& at, std::size_t point);

/// Of −t at each tracked point by its s: the axis goes on by the stretch along its tangent and turns by its curvature.
/// 0 where the tilt is held: the body lies on the wall or is about to. See Linearization::border_rates.
Vector border_rates(const SlidingSetting& setting, const SlidingState& at);

}  // namespace arcwall::sliding
