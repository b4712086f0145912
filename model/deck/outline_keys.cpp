// Obstacles of any outline.
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "core/text.hpp"
#include "model/deck/deck_keys.hpp"

namespace arcwall::deck {

namespace {

constexpr double least_distance = 1e-9;  // between points that follow each other, of the size of the outline

void structure_key(Keys& keys, Keep& keep) { keys.word(optional("structure"), keep, keep_words, "outside or inside"); }

void half_plane_keys(Keys& keys, HalfPlaneOutline& plane) {
  keys.vector("point", plane.point, unit::place, "");
  if (keys.vector("normal", plane.normal, unit::none, "") && plane.normal.x == 0.0 && plane.normal.z == 0.0)
    keys.report("normal", "[0, 0] has no direction", "give the direction in which the structure is, as [0.0, 1.0]");
}

void circle_outline_keys(Keys& keys, CircleOutline& circle) {
  keys.vector("centre", circle.centre, unit::place, "");
  keys.number("radius", circle.radius, unit::length, positive, "");
  structure_key(keys, circle.keep);
}

void ellipse_keys(Keys& keys, EllipseOutline& ellipse) {
  keys.vector("centre", ellipse.centre, unit::place, "");
  if (keys.vector("axes", ellipse.axes, unit::length, "half of its axes") &&
      !(ellipse.axes.x > 0.0 && ellipse.axes.z > 0.0))
    keys.report("axes", "half axes must be greater than 0", "give both, as [2.0, 1.0]");
  keys.number(optional("angle"), ellipse.angle, unit::none, any_number, "of the first axis from the x-axis [rad]");
  structure_key(keys, ellipse.keep);
}

double size_of(const std::vector<Vec2>& points) {
  double size = 0.0;
  for (const Vec2& point : points) size = std::max(size, (point - points.front()).norm());
  return size;
}

std::string text_of_point(const Vec2& point) {
  return "(" + round_trip(point.x()) + ", " + round_trip(point.y()) + ")";
}

bool cross_each_other(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const double of_c = cross(b - a, c - a), of_d = cross(b - a, d - a);
  const double of_a = cross(d - c, a - c), of_b = cross(d - c, b - c);
  return of_c * of_d <= 0.0 && of_a * of_b <= 0.0 && !(of_c == 0.0 && of_d == 0.0);
}

// What is wrong with the points of an outline; the lines between them must not meet but where they join.
struct Fault {
  std::string message, cure;
};

std::optional<Fault> fault_of(const OutlinePoints& outline) {
  const std::vector<Vec2> points = outline.points();
  const std::size_t count = points.size(), lines = outline.closed ? count : count - 1;
  const double size = size_of(points);
  if (outline.closed && count < 3)
    return Fault{.message = std::to_string(count) + " points close nothing", .cure = "give at least 3"};
  for (std::size_t i = 0; i < lines; ++i) {
    const Vec2 &a = points[i], &b = points[(i + 1) % count];
    if ((b - a).norm() > least_distance * size) continue;
    const bool repeats_first = i + 1 == count;
    return Fault{.message = "point " + text_of_point(b) + " follows " + text_of_point(a) +
                            (repeats_first ? " where the outline closes" : ", and they are the same"),
                 .cure = repeats_first ? "leave the last point out: a closed outline returns to its first by itself"
                                       : "remove one of them"};
  }
  for (std::size_t i = 0; i < lines; ++i)
    for (std::size_t j = i + 2; j < lines; ++j) {
      if (outline.closed && i == 0 && j + 1 == lines) continue;
      if (!cross_each_other(points[i], points[i + 1], points[j], points[(j + 1) % count])) continue;
      return Fault{.message = "the line from " + text_of_point(points[i]) + " meets that from " +
                              text_of_point(points[j]) + ": the outline crosses itself",
                   .cure = "give the points in the order in which they follow each other"};
    }
  return std::nullopt;
}

void points_keys(Keys& keys, OutlinePoints& outline, bool smooths) {
  given_points_keys(keys, smooths);
  const bool right = curve_keys(keys, outline.x, outline.z);
  keys.flag(optional("closed"), outline.closed, "last point to first");
  const bool is_closed = keys.lists() || outline.closed;
  if (keys.applies(is_closed, "structure", "belongs to a closed outline: the structure lies to the left of an open one",
                   "remove it, or write closed = true"))
    structure_key(keys, outline.keep);
  if (!right) return;
  if (const auto fault = fault_of(outline)) keys.report("x", fault->message, fault->cure);
}

void check_corners(Keys& keys, const Wall& wall, const PolylineOutline& outline) {
  constexpr double turned_back = pi - 1e-6;  // [rad]
  using Corner = PolylineOutline::Corner;
  const std::vector<Corner> corners = outline.corners();
  if (!wall.corner_radii.empty() && wall.corner_radii.size() != corners.size())
    return keys.report("corner_radius",
                       "has " + std::to_string(wall.corner_radii.size()) + " radii, and the outline has " +
                           std::to_string(corners.size()) + " corners",
                       outline.closed ? "give one for each point" : "give one for each point between the ends");
  const std::vector<double> radii = wall.radii();
  const auto taken = [&](const Corner& corner) { return radii[corner.point] * std::tan(0.5 * std::abs(corner.turn)); };
  const auto name_of = [&](const Corner& corner) {
    return "the corner at " + text_of_point(outline.points()[corner.point]);
  };
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Corner& corner = corners[i];
    const std::string where = name_of(corner);
    if (std::abs(corner.turn) > turned_back)
      return keys.report("outline", where + " turns back on itself", "leave a width between the lines");
    const double radius = radii[corner.point];
    if (radius == 0.0 && corner.is_hollow() && outline.without_sharp_hollows(radii).size() == 1)
      return keys.report("outline",
                         where +
                             " is re-entrant and sharp, and no other one is: a contact in it closes on both lines, "
                             "which is not modelled",
                         "give a corner_radius, or make two walls of it");
    const bool has_next = outline.closed || i + 1 < corners.size();
    const Corner& behind = corners[(i + 1) % corners.size()];
    const double next = has_next ? taken(behind) : 0.0;
    const double first = !outline.closed && i == 0 ? corner.before : infinity;
    if (taken(corner) + next <= corner.behind && taken(corner) <= first) continue;
    const Corner& wide = next > taken(corner) ? behind : corner;
    return keys.report(
        "corner_radius",
        name_of(wide) + " cannot be rounded with " + round_trip(radii[wide.point]) + ": its lines are too short",
        "give a smaller corner_radius");
  }
}

}  // namespace

void given_points_keys(Keys& keys, bool smooths) {
  if (keys.writes()) return;
  std::string points;
  std::optional<double> smoothing;
  keys.text(optional("points", "none"), points, "for `x` and `z`");
  if (smooths) keys.number(optional("smoothing", "none"), smoothing, unit::length, positive, "tolerance");
}

void outline_keys(Keys& keys, Wall& wall) {
  keys.part("outline", wall.outline, [&](Outline& outline) {
    keys.table(
        optional("outline", "none"), Form::dotted,
        [&](Keys& of) {
          const Option<HalfPlaneOutline> half_plane{
              "half-plane", "solid on one side of a straight line; the normal points to the structure",
              [&](HalfPlaneOutline& plane) { half_plane_keys(of, plane); }};
          const Option<CircleOutline> circle{"circle", "",
                                             [&](CircleOutline& round) { circle_outline_keys(of, round); }};
          const Option<PolylineOutline> polyline{"polyline",
                                                 "straight from point to point. The structure lies to the left of the "
                                                 "polyline; `structure` selects the side of a closed one",
                                                 [&](PolylineOutline& line) { points_keys(of, line, false); }};
          const Option<EllipseOutline> ellipse{"ellipse", "`axes`: half of each",
                                               [&](EllipseOutline& oval) { ellipse_keys(of, oval); }};
          const Option<CurveOutline> curve{
              "curve",
              "the interpolating cubic by chord length, smooth where it closes; the structure as for a polyline",
              [&](CurveOutline& line) { points_keys(of, line, true); }};
          of.one_of("type", outline, "outline", half_plane, circle, polyline, ellipse, curve);
        },
        "instead of `side` and `profile`: one of the following outlines in the plane");
  });
  const bool is_polyline = keys.lists() || (wall.outline && std::holds_alternative<PolylineOutline>(*wall.outline));
  if (!keys.applies(is_polyline, "corner_radius", "belongs to an outline of type polyline", "remove it")) return;
  const bool is_list = !keys.lists() && (keys.reads() ? keys.holds_array("corner_radius") : !wall.corner_radii.empty());
  const bool right = is_list ? keys.numbers(optional("corner_radius"), wall.corner_radii, unit::length, "")
                             : keys.number(optional("corner_radius"), wall.corner_radius, unit::length, not_negative,
                                           "radius of rounded corners of a polyline, or an array with one per corner; "
                                           "0: sharp");
  if (right && std::any_of(wall.corner_radii.begin(), wall.corner_radii.end(), [](double r) { return r < 0.0; }))
    return keys.report("corner_radius", "must be at least 0", "give radii that are not negative");
  if (!right && keys.has("corner_radius")) return;
  if (!keys.reads()) return;
  const auto& outline = std::get<PolylineOutline>(*wall.outline);
  if (outline.x.size() >= 2 && outline.z.size() == outline.x.size() && !fault_of(outline))
    check_corners(keys, wall, outline);
}

}  // namespace arcwall::deck
