#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/output/shape_pictures.hpp"

/// The data of SVG paths in a picture of a shape: lines, and the signs for forces, supports and springs. Places and
/// ways are in the picture's units, y points down.
namespace arcwall {

/// Units: coordinates are whole numbers of five digits.
inline constexpr double longer_side_of_pictures = 1e5;

/// `M10 20l5-3`: the first point, then the ways from each to the next.
std::string path_data(const std::vector<Vec2>& places);

/// An arrow; empty where it is shorter than a unit.
std::string arrow_data(const Vec2& from, const Vec2& way);

/// A part of a circle about the point, from its right side on, with an arrow's head: three quarters for the greatest,
/// of which the moment is the given part.
std::string moment_data(const Vec2& at, double part);

/// A square where the rotation is held, else a triangle with its tip at the point; a line behind it where it can roll.
std::string support_data(const Vec2& at, const HeldPoint& held);

/// Down and to the left into the ground, or to the other point; a circle where it resists rotation.
std::string spring_data(const Vec2& at, const std::optional<Vec2>& to, const DrawnSpring& spring);

}  // namespace arcwall
