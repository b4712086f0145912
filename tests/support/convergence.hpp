#pragma once

#include <functional>
#include <vector>

namespace arcwall::test {

/// Values over four meshes, each with elements half as long as the one before: coarsest · 1, 2, 4, 8 elements.
std::vector<double> on_four_meshes(int coarsest, const std::function<double(int elements)>& value);

/// Errors on such meshes fall with this power of the element length: within 0.2 over all meshes, and between the finest
/// two. Errors below `noise` are round-off and left out; at least two must remain.
void expect_order(const std::vector<double>& errors, double order, double noise = 0.0);

/// The limit of values whose errors go with h^order, h^(order+2), …: Richardson's extrapolation, repeated (Romberg).
double extrapolated(std::vector<double> values, double order);

/// What the values of one quantity on such meshes shall show.
struct Expectation {
  double exact = 0.0;
  double order = 4.0;
  double limit_error = 1e-7;  ///< of the extrapolated value, as a part of `exact`
};

/// Both: the errors have the order, and the values extrapolate to the exact one.
void expect_convergence(const std::vector<double>& values, const Expectation& expected);

/// The value at s = 0 of a smooth function of s from its values at s, s/2 and s/4; error of order s³.
double at_zero(const std::function<double(double s)>& value, double s);

}  // namespace arcwall::test
