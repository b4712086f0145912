#pragma once

#include <array>
#include <vector>

namespace arcwall {

/// The C² cubic through given points, without a knot at the second and the last but one ("not a knot"); a parabola
/// through three points, a line through two.
class CubicSpline {
 public:
  /// `t` strictly increasing, at least two, as many as `v`. `rounding`: over this part of the shorter interval beside a
  /// knot the third derivative goes over from one cubic to the next; farther off they are as they were. 0: it jumps.
  CubicSpline(std::vector<double> t, std::vector<double> v, double rounding = 0.0);

  double first() const { return t_.front(); }
  double last() const { return t_.back(); }
  const std::vector<double>& knots() const { return t_; }

  /// Value and first three derivatives; outside [first, last] the end polynomials go on.
  std::array<double, 4> at(double t) const;

  /// Up to which distance from a knot the third derivative goes over; 0 where it does not or jumps.
  double half_width(std::size_t knot) const;

  /// By how much the third derivative is greater behind a knot than before it; 0 at the first and the last one.
  double third_derivative_jump(std::size_t knot) const;

 private:
  std::array<double, 4> cubic_at(std::size_t interval, double t) const;

  std::vector<double> t_, v_, second_;  // knots, values, second derivatives at the knots
  double rounding_;
};

}  // namespace arcwall
