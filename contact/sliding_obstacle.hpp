#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "contact/obstacle.hpp"

namespace arcwall {

/// An obstacle that slender members may touch.
struct SlidingObstacle {
  std::string name{};
  std::shared_ptr<const Obstacle> surface{};
  std::shared_ptr<const Obstacle> unmoved{};  ///< the surface where it is written down, before any motion
  bool on_face = true;                        ///< contact of the members' faces, or of their axes
  bool may_stop_rollers = false;        ///< ends that supports hold in z and leave free in x: it is not level all along
  std::vector<std::uint8_t> strands{};  ///< per strand whether it concerns it
  std::vector<double> frictions{};      ///< per strand the coefficient μ of Coulomb friction [-]; empty: none has any
  bool rubs_axis = false;               ///< friction acts on the axis, not on what touches

  /// Of the face that looks at it from the axis, along its normal (upwards) [length].
  double face_offset(double half_height) const { return on_face ? -sign_of(surface->side()) * half_height : 0.0; }

  double friction(Index strand) const { return frictions.empty() ? 0.0 : frictions[static_cast<std::size_t>(strand)]; }
  double rubbing_offset(double half_height) const { return rubs_axis ? 0.0 : face_offset(half_height); }

  bool concerns(Index strand) const { return strands[static_cast<std::size_t>(strand)] != 0; }
};

}  // namespace arcwall
