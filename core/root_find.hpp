#pragma once

#include <functional>
#include <optional>

namespace arcwall {

/// A bracketed zero of a scalar function.
struct Root {
  double at = 0.0;          ///< the argument of the least |value| seen
  double half_width = 0.0;  ///< of the interval that still holds the zero
};

/// A zero of f in [a, b] by Alefeld, Potra and Shi's algorithm 748, given values fa and fb of opposite sign. f may fail
/// (return nothing); then so does the search. Ends when the bracket is narrower than `tolerance`.
std::optional<Root> bracketed_root(const std::function<std::optional<double>(double)>& f, double a, double fa, double b,
                                   double fb, double tolerance, int max_evaluations = 60);

/// The least zero of the cubic in (0, 1] that has values v0, v1 and slopes d0, d1 at 0 and 1; a zero at 0 itself does
/// not count, one at 1 does when the sign changes there or v1 is zero. Empty if there is none.
std::optional<double> first_cubic_zero(double v0, double d0, double v1, double d1);

/// Where that cubic turns in (0, 1), its slopes at 0 and 1 of opposite signs; else empty.
std::optional<double> cubic_turn(double v0, double d0, double v1, double d1);

/// The least value of that cubic on [0, 1].
double least_cubic_value(double v0, double d0, double v1, double d1);

}  // namespace arcwall
