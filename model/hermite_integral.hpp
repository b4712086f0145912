#pragma once

#include <array>
#include <utility>

namespace arcwall {

/// Hermite's cubic on [0, 1].
struct HermiteCubic {
  double from, from_rate, to, to_rate;

  double value(double u) const {
    const double v = 1.0 - u;
    return v * v * ((1.0 + 2.0 * u) * from + u * from_rate) + u * u * ((1.0 + 2.0 * v) * to - v * to_rate);
  }
  double slope(double u) const {
    const double v = 1.0 - u;
    return 6.0 * u * v * (to - from) + v * (1.0 - 3.0 * u) * from_rate + u * (1.0 - 3.0 * v) * to_rate;
  }
};

/// Gauss's points and weights on [0, 1], exact up to degree 5: a cubic and the slope of one.
inline constexpr std::array<std::pair<double, double>, 3> gauss_of_cubics{
    {{0.5 - 0.3872983346207417, 5.0 / 18.0}, {0.5, 8.0 / 18.0}, {0.5 + 0.3872983346207417, 5.0 / 18.0}}};

/// ∫ f dw
inline double integral(const HermiteCubic& f, const HermiteCubic& w) {
  double sum = 0.0;
  for (const auto& [u, weight] : gauss_of_cubics) sum += weight * f.value(u) * w.slope(u);
  return sum;
}

}  // namespace arcwall
