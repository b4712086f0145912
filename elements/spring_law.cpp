#include "elements/spring_law.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace arcwall {

SpringLaw::SpringLaw(std::vector<double> stretch, std::vector<double> force, Interpolation interpolation)
    : interpolation_(interpolation),
      stretch_(std::move(stretch)),
      force_(std::move(force)),
      slope_(stretch_.size(), 0.0),
      energy_(stretch_.size()) {
  assert(stretch_.size() >= 2 && stretch_.size() == force_.size());
  const std::size_t last = stretch_.size() - 1;
  const auto width = [&](std::size_t i) { return stretch_[i + 1] - stretch_[i]; };
  for (std::size_t i = 1; interpolation_ == Interpolation::smooth && i < last; ++i) {
    const double before = secant(i - 1), behind = secant(i), a = width(i - 1), b = width(i);
    if (before * behind > 0.0) slope_[i] = 3.0 * (a + b) / ((2.0 * b + a) / before + (b + 2.0 * a) / behind);
  }
  for (std::size_t i = 0; i < last; ++i) energy_[i + 1] = energy_[i] + energy_within(i, 1.0);
  const auto rest = std::find(stretch_.begin(), stretch_.end(), 0.0);
  assert(rest != stretch_.end());
  const double at_rest = energy_[static_cast<std::size_t>(rest - stretch_.begin())];
  for (double& energy : energy_) energy -= at_rest;
}

// ∫ of the line, or of Hermite's cubic, from 0 to t, times the width.
double SpringLaw::energy_within(std::size_t i, double t) const {
  const double h = stretch_[i + 1] - stretch_[i], t2 = t * t;
  if (interpolation_ == Interpolation::linear) return h * (force_[i] * t + 0.5 * (force_[i + 1] - force_[i]) * t2);
  const double value1 = t - t2 * t + 0.5 * t2 * t2, value2 = t2 * t - 0.5 * t2 * t2;
  const double slope1 = t2 * (0.5 - 2.0 / 3.0 * t + 0.25 * t2), slope2 = t2 * t * (0.25 * t - 1.0 / 3.0);
  return h * (force_[i] * value1 + force_[i + 1] * value2 + h * (slope_[i] * slope1 + slope_[i + 1] * slope2));
}

SpringLaw::Response SpringLaw::at(double u) const {
  if (u < stretch_.front())
    return {.energy = energy_.front() + force_.front() * (u - stretch_.front()), .force = force_.front()};
  if (u >= stretch_.back())
    return {.energy = energy_.back() + force_.back() * (u - stretch_.back()), .force = force_.back()};
  const auto i = static_cast<std::size_t>(std::upper_bound(stretch_.begin(), stretch_.end(), u) - stretch_.begin()) - 1;
  const double h = stretch_[i + 1] - stretch_[i], t = (u - stretch_[i]) / h, r = 1.0 - t;
  const double rise = secant(i);
  if (interpolation_ == Interpolation::linear)
    return {.energy = energy_[i] + energy_within(i, t), .force = force_[i] * r + force_[i + 1] * t, .stiffness = rise};
  return {.energy = energy_[i] + energy_within(i, t),
          .force = force_[i] * r * r * (1.0 + 2.0 * t) + force_[i + 1] * t * t * (1.0 + 2.0 * r) +
                   h * t * r * (slope_[i] * r - slope_[i + 1] * t),
          .stiffness = 6.0 * t * r * rise + slope_[i] * r * (1.0 - 3.0 * t) + slope_[i + 1] * t * (3.0 * t - 2.0)};
}

std::vector<SpringLaw::Kink> SpringLaw::kinks() const {
  constexpr double same = 1e-12;  // relative difference of two quotients of the same stiffness
  std::vector<Kink> kinks;
  if (interpolation_ == Interpolation::smooth) return kinks;
  double before = 0.0;
  for (std::size_t i = 0; i < stretch_.size(); ++i) {
    const double behind = i + 1 < stretch_.size() ? secant(i) : 0.0;
    if (std::abs(behind - before) > same * std::max(std::abs(behind), std::abs(before)))
      kinks.push_back({.stretch = stretch_[i], .jump = behind - before});
    before = behind;
  }
  return kinks;
}

}  // namespace arcwall
