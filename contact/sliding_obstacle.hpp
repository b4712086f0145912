#pragma once

#include <algorithm>
#include <array>
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
  std::vector<std::array<double, 2>> end_frictions{};  ///< likewise of its first and of its last end
  bool rubs_axis = false;                              ///< friction acts on the axis, not on what touches

  /// Of the face that looks at it from the axis, along its normal (upwards) [length].
  double face_offset(double half_height) const { return on_face ? -sign_of(surface->side()) * half_height : 0.0; }

  double friction(Index strand) const { return frictions.empty() ? 0.0 : frictions[static_cast<std::size_t>(strand)]; }
  double friction_at_end(Index strand, bool last) const {
    return end_frictions.empty() ? 0.0 : end_frictions[static_cast<std::size_t>(strand)][last ? 1 : 0];
  }
  bool is_rough() const {
    const auto rough = [](double friction) { return friction > 0.0; };
    return std::any_of(frictions.begin(), frictions.end(), rough) ||
           std::any_of(end_frictions.begin(), end_frictions.end(),
                       [&](const auto& of) { return rough(of[0]) || rough(of[1]); });
  }
  double rubbing_offset(double half_height) const { return rubs_axis ? 0.0 : face_offset(half_height); }

  bool concerns(Index strand) const { return strands[static_cast<std::size_t>(strand)] != 0; }
};

}  // namespace arcwall
