#pragma once

namespace arcwall::verify {

/// What the rounding of a spline's knots adds to the cubics on both sides of a knot behind which the third derivative
/// is greater by 1 (7.4c of docs/theory.md): to the value, the slope and the second derivative.
struct RoundedKnot {
  double value = 0.0, slope = 0.0, second = 0.0;
};

/// `from_knot`: of the place. `shorter`: of the intervals beside the knot.
RoundedKnot rounded_knot(double from_knot, double shorter);

}  // namespace arcwall::verify
