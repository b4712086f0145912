#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/types.hpp"

namespace arcwall {

/// A wall in the coordinates of a picture, of which y points down.
struct PlacedWall {
  std::vector<Vec2> line{};
  bool closed = false;           ///< the last point is joined to the first
  std::optional<Vec2> behind{};  ///< unit vector into a solid without end; empty: the solid is on the right of the line
};

/// The data of SVG paths, clipped to the picture and a little more.
struct WallPicture {
  std::string surface{};  ///< an open path
  std::string body{};     ///< filled by the rule `nonzero`: all of the solid, of an open outline a band of it
};

/// `size`: of the picture.
std::vector<WallPicture> wall_pictures(const std::vector<PlacedWall>& walls, const Vec2& size);

}  // namespace arcwall
