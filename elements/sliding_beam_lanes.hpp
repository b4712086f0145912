#pragma once

#include <vector>

#include "core/lanes.hpp"
#include "elements/axis.hpp"

namespace arcwall {

/// Classic beams between places of a straight axis with sine deviations, four side by side: what ClassicBeam::respond()
/// gives for stretch_reference(), to round-off.
class SlidingBeamLanes {
 public:
  /// `shape.is_straight()` must hold.
  SlidingBeamLanes(const ImperfectAxis& shape, double EA, double EI);

  /// The stress-free axis at four material coordinates: the deviation y and its derivatives, the angle of the tangent,
  /// v = √(1 + y′²) and its derivatives.
  struct Rest {
    Lanes s, deviation, slope, bend, angle, speed, speed_first, speed_second, speed_third;
  };
  Rest rest_at(const Lanes& s) const;

  /// At the last three places of some and the first of others.
  static Rest next_of(const Rest& these, const Rest& others);

  /// An end of each: where it lies at rest, and its place and the angle of the tangent now.
  struct End {
    Rest rest;
    Lanes x, z, angle;
  };

  /// Derivatives are by x1, z1, angle1, x2, z2, angle2.
  struct Response {
    Lanes energy;
    Lanes force[6];
    Lanes stiffness[36];     ///< the lower triangle, column-major
    Lanes force_rate[2][6];  ///< of the force by the material coordinate of either end
  };
  enum class Wanted { energy, force, stiffness, rates };  ///< each with those before it

  void respond(const End& first, const End& second, Wanted wanted, Response& out) const;

  /// height · sin(number · s)
  struct Wave {
    double number, height;
  };
  struct Properties {
    std::vector<Wave> waves{};
    double greatest_number = 0.0;  ///< of the waves
    double EA, EI;
  };

 private:
  Properties properties_;
};

}  // namespace arcwall
