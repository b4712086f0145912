#pragma once

#include <algorithm>
#include <cmath>

#include "contact/sliding/setting.hpp"
#include "contact/sliding/touch.hpp"
#include "contact/sliding/unknowns.hpp"

namespace arcwall::sliding {

/// The pressure with which a curved obstacle holds a pressed part on itself, by (8.7) of docs/theory.md with what the
/// stretch of the axis adds: known from where the part lies, its axial force and its loads, not from differences of its
/// nodes' forces. Not in it is what acts at single places: point loads, and jumps of the rate of the curvature.
///
/// The places of the part are its first end, its nodes and its last end, 0 … elements. A view: `at` must outlive it.
class CurvePressure {
 public:
  CurvePressure(const SlidingSetting& setting, const SlidingState& at, std::size_t segment);

  /// At a place; > 0 where the obstacle presses [force per length].
  double pressure(Index place) const;

  /// Its derivative along the direction in which the state moves.
  double rate(Index place, const SlidingMotion& motion) const;

  /// Adds a multiple of its derivatives by all unknowns and by λ.
  void add_gradient(Index place, double factor, Row& row) const;

  /// Between two places, linear from one to the other.
  double pressure_between(double place) const;
  void add_gradient_between(double place, double factor, Row& row) const;  ///< at a place that stays
  double slope_between(double place) const;                                ///< by the place

  /// The material coordinate of a place, also of one between two [length].
  double coordinate(double place) const { return from_ + place * element(); }

  /// The length of the part's elements.
  double element() const { return (to_ - from_) / part_.elements; }

  /// Adds a multiple of that length's derivatives.
  void add_element_gradient(double factor, Row& row) const;

  /// The node at a place, and its face.
  Touch touch(Index place) const;

 private:
  // The first of the two places beside one between them.
  Index before(double place) const {
    return std::clamp(static_cast<Index>(std::floor(place)), Index{0}, Index{part_.elements} - 1);
  }
  Index position(Index place) const { return first_position_ + place; }
  // The stretch, of the elements of the part beside a place the mean.
  double stretch(Index place) const;
  AxisStrainGradient stretch_gradient(Index place) const;

  const SlidingSetting& setting_;
  const SlidingState& at_;
  std::size_t segment_;
  const SlidingContactLayout::Segment& part_;
  std::size_t obstacle_;
  Index first_position_;
  double from_ = 0.0, to_ = 0.0;
};

}  // namespace arcwall::sliding
