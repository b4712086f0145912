#pragma once

#include <array>
#include <vector>

namespace arcwall {

/// The C² cubic through given points, without a knot at the second and the last but one ("not a knot"); a parabola
/// through three points, a line through two.
class CubicSpline {
 public:
  /// `t` strictly increasing, at least two, as many as `v`.
  CubicSpline(std::vector<double> t, std::vector<double> v);

  double first() const { return t_.front(); }
  double last() const { return t_.back(); }
  const std::vector<double>& knots() const { return t_; }

  /// Value and first three derivatives; outside [first, last] the end polynomials go on.
  std::array<double, 4> at(double t) const;

 private:
  std::vector<double> t_, v_, second_;  // knots, values, second derivatives at the knots
};

}  // namespace arcwall
