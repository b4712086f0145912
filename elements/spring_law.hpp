#pragma once

#include <vector>

namespace arcwall {

/// Interpolates the force of a spring as a function of its elongation. It is constant beyond the first and last point.
///
/// `smooth`: monotone between points, C¹. The slope at an inner point is the weighted harmonic mean of the adjacent
/// slopes (Fritsch and Butland 1984). It is 0 if they differ in sign, and at the first and last point.
/// `linear`: piecewise linear, with kinks.
class SpringLaw {
 public:
  enum class Interpolation { smooth, linear };

  /// `stretch` [length]: at least two, strictly increasing, one of them 0. `force` [force]: same size, 0 at stretch 0.
  SpringLaw(std::vector<double> stretch, std::vector<double> force,
            Interpolation interpolation = Interpolation::smooth);

  struct Response {
    double energy = 0.0;  ///< 0 at stretch 0
    double force = 0.0, stiffness = 0.0;
  };

  /// Returns energy, force and stiffness; at a kink, the stiffness beyond it.
  Response at(double stretch) const;

  /// Stores a kink: its position, and the increase of stiffness across it.
  struct Kink {
    double stretch = 0.0, jump = 0.0;
  };

  /// Returns the kinks by increasing stretch; empty for a smooth law.
  std::vector<Kink> kinks() const;

  /// Returns the distance of the first and the last point.
  double width() const { return stretch_.back() - stretch_.front(); }

  bool operator==(const SpringLaw&) const = default;

 private:
  double energy_within(std::size_t interval, double part) const;  // of an interval, up to a part of its width
  double secant(std::size_t interval) const {
    return (force_[interval + 1] - force_[interval]) / (stretch_[interval + 1] - stretch_[interval]);
  }

  Interpolation interpolation_;
  std::vector<double> stretch_, force_, slope_;
  std::vector<double> energy_;  // at the points
};

}  // namespace arcwall
