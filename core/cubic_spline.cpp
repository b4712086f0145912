#include "core/cubic_spline.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/types.hpp"

namespace arcwall {

// Second derivatives m_i of the spline on intervals h_i with slopes s_i = (v_{i+1} − v_i)/h_i:
//
//   h_{i−1} m_{i−1} + 2 (h_{i−1} + h_i) m_i + h_i m_{i+1} = 6 (s_i − s_{i−1})            inner knots          (1)
//   h_1 m_0 − (h_0 + h_1) m_1 + h_0 m_2 = 0, likewise at the other end                   not a knot           (2)
CubicSpline::CubicSpline(std::vector<double> t, std::vector<double> v, double rounding)
    : t_(std::move(t)), v_(std::move(v)), second_(t_.size(), 0.0), rounding_(rounding) {
  assert(t_.size() == v_.size() && t_.size() >= 2);
  const auto n = static_cast<Index>(t_.size());
  if (n == 2) return;
  const auto h = [&](Index i) { return t_[static_cast<std::size_t>(i + 1)] - t_[static_cast<std::size_t>(i)]; };
  const auto slope = [&](Index i) {
    return (v_[static_cast<std::size_t>(i + 1)] - v_[static_cast<std::size_t>(i)]) / h(i);
  };
  if (n == 3) {
    std::fill(second_.begin(), second_.end(), 2.0 * (slope(1) - slope(0)) / (h(0) + h(1)));
    return;
  }
  // (1) with m_0 and m_{n−1} of (2) has a dominant diagonal: elimination needs no pivots.
  const double first = h(0) / h(1), last = h(n - 2) / h(n - 3);
  std::vector<double> above(t_.size()), m(t_.size());
  for (Index i = 1; i + 1 < n; ++i) {
    const auto row = static_cast<std::size_t>(i);
    double below = h(i - 1), diagonal = 2.0 * (h(i - 1) + h(i)), beyond = h(i);
    if (i == 1) {
      diagonal += first * (h(0) + h(1));
      beyond -= first * h(0);
    }
    if (i == n - 2) {
      diagonal += last * (h(n - 3) + h(n - 2));
      below -= last * h(n - 2);
    }
    const double pivot = diagonal - below * above[row - 1];
    m[row] = (6.0 * (slope(i) - slope(i - 1)) - below * m[row - 1]) / pivot;
    above[row] = beyond / pivot;
  }
  for (std::size_t i = t_.size() - 3; i >= 1; --i) m[i] -= above[i] * m[i + 1];
  m.front() = (1.0 + first) * m[1] - first * m[2];
  m.back() = (1.0 + last) * m[t_.size() - 2] - last * m[t_.size() - 3];
  second_ = std::move(m);
}

namespace {

// What is added to a cubic in −1 ≤ ξ ≤ 1 beside a knot behind which the third derivative is greater by 1, in units of
// the half width w: the value in w³, and its derivatives. Of the odd polynomials of degree three that take the third
// derivative from one side to the other this one leaves value, slope and second derivative on both sides as they are:
//
//   f‴ = ½ + (9 ξ − 5 ξ³)/8                                                                                      (3)
std::array<double, 4> rounded(double xi) {
  const double x2 = xi * xi;
  return {(((9.0 - x2) * x2 + 16.0 * xi + 9.0) * x2 - 1.0) / 192.0, xi * (3.0 + xi * (8.0 + xi * (6.0 - x2))) / 32.0,
          (3.0 + xi * (16.0 + xi * (18.0 - 5.0 * x2))) / 32.0, 0.5 + xi * (9.0 - 5.0 * x2) / 8.0};
}

}  // namespace

std::array<double, 4> CubicSpline::cubic_at(std::size_t i, double t) const {
  const double h = t_[i + 1] - t_[i], d = t - t_[i];
  const double third = (second_[i + 1] - second_[i]) / h;
  const double slope = (v_[i + 1] - v_[i]) / h - h * (2.0 * second_[i] + second_[i + 1]) / 6.0;
  return {v_[i] + d * (slope + d * (0.5 * second_[i] + d * third / 6.0)), slope + d * (second_[i] + 0.5 * d * third),
          second_[i] + d * third, third};
}

double CubicSpline::half_width(std::size_t knot) const {
  if (knot == 0 || knot + 1 == t_.size()) return 0.0;
  return rounding_ * std::min(t_[knot] - t_[knot - 1], t_[knot + 1] - t_[knot]);
}

double CubicSpline::third_derivative_jump(std::size_t knot) const {
  if (knot == 0 || knot + 1 == t_.size()) return 0.0;
  return cubic_at(knot, t_[knot])[3] - cubic_at(knot - 1, t_[knot])[3];
}

std::array<double, 4> CubicSpline::at(double t) const {
  const auto above = std::upper_bound(t_.begin() + 1, t_.end() - 1, t);
  const auto i = static_cast<std::size_t>(above - t_.begin()) - 1;
  const std::size_t knot = t - t_[i] < t_[i + 1] - t ? i : i + 1;
  if (rounding_ == 0.0 || knot == 0 || knot + 1 == t_.size()) return cubic_at(i, t);
  const double w = half_width(knot), xi = (t - t_[knot]) / w;
  if (std::abs(xi) >= 1.0) return cubic_at(i, t);
  std::array<double, 4> at = cubic_at(knot - 1, t);
  const double jump = cubic_at(knot, t)[3] - at[3];
  const std::array<double, 4> added = rounded(xi);
  double scale = jump;  // of the derivative
  for (std::size_t k = 4; k-- > 0; scale *= w) at[k] += scale * added[k];
  return at;
}

}  // namespace arcwall
