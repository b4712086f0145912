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
  bool on_face = true;                  ///< contact of the members' faces, or of their axes
  bool stands_across = false;           ///< the way of ends that supports hold in z and leave free in x: they touch it
  std::vector<std::uint8_t> strands{};  ///< per strand whether it concerns it

  bool concerns(Index strand) const { return strands[static_cast<std::size_t>(strand)] != 0; }
};

}  // namespace arcwall
