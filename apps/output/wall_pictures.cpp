#include "apps/output/wall_pictures.hpp"

#include <algorithm>
#include <cmath>

#include "apps/output/picture_signs.hpp"

namespace arcwall {

namespace {

using Points = std::vector<Vec2>;

constexpr double thickest_band = 0.025 * longer_side_of_pictures;
constexpr double room = 0.05 * longer_side_of_pictures;  // beyond the picture, so that its border hides the ends

struct Clip {
  Vec2 low, high;

  bool is_inside(const Vec2& point) const {
    return (point.array() >= low.array()).all() && (point.array() <= high.array()).all();
  }
  Points corners() const { return {low, {high.x(), low.y()}, high, {low.x(), high.y()}}; }
};

// The part of a polygon on one side of an upright or level line.
Points half(const Points& polygon, int axis, double bound, double sign) {
  const auto excess = [&](const Vec2& point) { return sign * (point[axis] - bound); };
  Points part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double at_a = excess(a), at_b = excess(b);
    if (at_a <= 0.0) part.push_back(a);
    if ((at_a < 0.0 && at_b > 0.0) || (at_a > 0.0 && at_b < 0.0)) part.emplace_back(a + at_a / (at_a - at_b) * (b - a));
  }
  return part;
}

// Sutherland & Hodgman (1974).
Points clipped(Points polygon, const Clip& clip) {
  for (const int axis : {0, 1}) {
    polygon = half(polygon, axis, clip.high[axis], 1.0);
    polygon = half(polygon, axis, clip.low[axis], -1.0);
  }
  return polygon;
}

// The part of a step that is inside: from which fraction to which; the first is greater where nothing is.
std::pair<double, double> part_inside(const Vec2& from, const Vec2& to, const Clip& clip) {
  double first = 0.0, last = 1.0;
  for (const int axis : {0, 1}) {
    const double way = to[axis] - from[axis];
    const double to_low = clip.low[axis] - from[axis], to_high = clip.high[axis] - from[axis];
    if (way == 0.0) {
      if (to_low > 0.0 || to_high < 0.0) return {1.0, 0.0};
      continue;
    }
    first = std::max(first, std::min(to_low / way, to_high / way));
    last = std::min(last, std::max(to_low / way, to_high / way));
  }
  return {first, last};
}

std::vector<Points> pieces_inside(const Points& line, const Clip& clip) {
  std::vector<Points> pieces;
  bool goes_on = false;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Vec2 &a = line[i - 1], &b = line[i];
    const auto [first, last] = part_inside(a, b, clip);
    if (first > last) {
      goes_on = false;
      continue;
    }
    if (!goes_on) pieces.push_back({a + first * (b - a)});
    pieces.back().emplace_back(a + last * (b - a));
    goes_on = last == 1.0;
  }
  return pieces;
}

// Without points that lie on the straight line between their neighbours.
Points without_straight(const Points& points) {
  Points kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i > 0 && i + 1 < points.size()) {
      const Vec2 before = points[i] - kept.back(), after = points[i + 1] - points[i];
      const bool is_straight =
          std::abs(cross(before, after)) <= 0.5 * (before + after).norm() && before.dot(after) >= 0.0;
      if (is_straight) continue;
    }
    kept.push_back(points[i]);
  }
  return kept;
}

std::string rounded_path(const Points& points) {
  Points places;
  for (const Vec2& point : points) places.emplace_back(point.array().round());
  return path_data(places);
}

std::string area_data(const Points& polygon) { return polygon.size() < 3 ? "" : rounded_path(polygon) + "z"; }

// Positive where the inside is on the right.
double area_on_right(const Points& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) twice += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return 0.5 * twice;
}

// A solid without end: from its surface on.
std::string endless_body(const PlacedWall& wall, const Clip& clip) {
  const double far = 4.0 * (clip.high - clip.low).norm();
  Points polygon = wall.line;
  for (auto point = wall.line.rbegin(); point != wall.line.rend(); ++point)
    polygon.emplace_back(*point + far * *wall.behind);
  return area_data(without_straight(clipped(std::move(polygon), clip)));
}

// A disc, or all but a hole: there the border of the picture runs the other way round.
std::string closed_body(const PlacedWall& wall, const Clip& clip) {
  const std::string inside = area_data(clipped(wall.line, clip));
  return area_on_right(wall.line) > 0.0 ? inside : area_data(clip.corners()) + inside;
}

// Points at most so far apart, with those of the line among them.
Points finely(const Points& line, double most) {
  Points fine{line.front()};
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Vec2 way = line[i] - line[i - 1];
    const double parts = std::max(std::ceil(way.norm() / most), 1.0);
    for (double part = 1.0; part <= parts; part += 1.0) fine.emplace_back(line[i - 1] + part / parts * way);
  }
  return fine;
}

// How far a ray goes before it meets a line; infinity if it does not.
double distance_along(const Vec2& from, const Vec2& direction, const Points& line) {
  constexpr double apart = 1.0;  // a unit of the picture: `from` may lie on the line itself
  double least = infinity;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Vec2 way = line[i] - line[i - 1], to = line[i - 1] - from;
    const double determinant = cross(direction, way);
    if (determinant == 0.0) continue;
    const double distance = cross(to, way) / determinant, part = cross(to, direction) / determinant;
    if (distance > apart && part >= 0.0 && part <= 1.0) least = std::min(least, distance);
  }
  return least;
}

// A band along an open outline: of a thin solid half of it belongs to each side. `lines`: of all open outlines.
std::string band(const Points& line, const std::vector<Points>& lines) {
  const Points fine = finely(line, 0.5 * thickest_band);
  Points polygon = fine;
  for (std::size_t i = fine.size(); i-- > 0;) {
    const Vec2 before = i > 0 ? (fine[i] - fine[i - 1]).normalized() : Vec2::Zero();
    const Vec2 after = i + 1 < fine.size() ? (fine[i + 1] - fine[i]).normalized() : Vec2::Zero();
    const Vec2 along = before + after;
    if (along.norm() < 1e-9) continue;
    const Vec2 right = perp(along.normalized());
    double depth = thickest_band;
    for (const Points& other : lines) depth = std::min(depth, 0.5 * distance_along(fine[i], right, other));
    polygon.emplace_back(fine[i] + depth * right);
  }
  return area_data(without_straight(polygon));
}

std::string open_body(const PlacedWall& wall, const std::vector<Points>& lines, const Clip& clip) {
  std::string data;
  for (const Points& piece : pieces_inside(wall.line, clip)) data += band(piece, lines);
  return data;
}

std::string surface_data(const PlacedWall& wall, const Clip& clip) {
  Points line = wall.line;
  if (wall.closed && !line.empty()) line.push_back(line.front());
  std::string data;
  for (const Points& piece : pieces_inside(line, clip)) data += rounded_path(piece);
  return data;
}

}  // namespace

std::vector<WallPicture> wall_pictures(const std::vector<PlacedWall>& walls, const Vec2& size) {
  const Clip clip{.low = Vec2::Constant(-room), .high = size + Vec2::Constant(room)};
  std::vector<Points> lines;
  for (const PlacedWall& wall : walls)
    if (!wall.closed && !wall.behind) lines.push_back(wall.line);
  std::vector<WallPicture> pictures;
  for (const PlacedWall& wall : walls) {
    const std::string body = wall.line.size() < 2 ? ""
                             : wall.closed        ? closed_body(wall, clip)
                             : wall.behind        ? endless_body(wall, clip)
                                                  : open_body(wall, lines, clip);
    pictures.push_back({.surface = surface_data(wall, clip), .body = body});
  }
  return pictures;
}

}  // namespace arcwall
