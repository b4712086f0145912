#pragma once

#include <vector>

namespace arcwall {

/// The force of a spring by its stretch, through given points: monotone between two of them, with a continuous slope,
/// at an inner point the weighted harmonic mean of the slopes beside it (Fritsch and Butland 1984), or 0 where these
/// differ in sign. Beyond the first and the last point, where the slope is 0, it is constant.
class SpringLaw {
 public:
  /// `stretch` strictly increasing, at least two, one of them 0 without force; as many forces.
  SpringLaw(std::vector<double> stretch, std::vector<double> force);

  struct Response {
    double energy = 0.0;  ///< from stretch 0 on
    double force = 0.0, stiffness = 0.0;
  };
  Response at(double stretch) const;

  bool operator==(const SpringLaw&) const = default;

 private:
  double energy_within(std::size_t interval, double part) const;  // of an interval, up to a part of its width

  std::vector<double> stretch_, force_, slope_;
  std::vector<double> energy_;  // at the points
};

}  // namespace arcwall
