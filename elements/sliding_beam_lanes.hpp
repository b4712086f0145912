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

  /// An end of each: its material coordinate, and its place and the angle of the tangent now.
  struct End {
    Lanes s, x, z, angle;
  };

  /// Derivatives are by x1, z1, angle1, x2, z2, angle2.
  struct Response {
    Lanes force[6];
    Lanes stiffness[36];     ///< the lower triangle, column-major
    Lanes force_rate[2][6];  ///< of the force by the material coordinate of either end
  };
  enum class Wanted { force, stiffness, rates };  ///< each with those before it

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
