#pragma once

#include <vector>

namespace arcwall {

/// The force of a spring by its stretch, through given points. Beyond the first and the last point it is constant.
///
/// `smooth`: monotone between two points, with a continuous slope, at an inner point the weighted harmonic mean of the
/// slopes beside it (Fritsch and Butland 1984), or 0 where these differ in sign, as at the first and the last point.
/// `linear`: straight pieces between the points. Where two of them meet the law has a kink.
class SpringLaw {
 public:
  enum class Interpolation { smooth, linear };

  /// `stretch` strictly increasing, at least two, one of them 0 without force; as many forces.
  SpringLaw(std::vector<double> stretch, std::vector<double> force,
            Interpolation interpolation = Interpolation::smooth);

  struct Response {
    double energy = 0.0;  ///< from stretch 0 on
    double force = 0.0, stiffness = 0.0;
  };

  /// At a kink the stiffness is that behind it.
  Response at(double stretch) const;

  /// Where the stiffness of straight pieces jumps, and by how much it is greater behind than before.
  struct Kink {
    double stretch = 0.0, jump = 0.0;
  };

  /// In their order; none of a smooth law.
  std::vector<Kink> kinks() const;

  /// From the first point to the last.
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
