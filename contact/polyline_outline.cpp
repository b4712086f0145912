#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "contact/outline.hpp"

namespace arcwall {

namespace {

constexpr double arc_turn = pi / 18.0;  // of an arc between two knots [rad]

// A straight part, from a coordinate along the outline on.
struct Flank {
  double along;
  Vec2 from, tangent;
  double length;
};

// The arc between two flanks, about a centre; of radius 0 at a sharp corner. `first` is the unit vector from the centre
// to its beginning. The coordinate runs with the angle.
struct Rounding {
  double along;
  Vec2 centre, first;
  double radius, turn;  // anticlockwise [rad]
  double per_angle;     // length of the coordinate
};

// Flanks and arcs in turn. The foot is the nearest of those on each part; what lies between the parts' normals at their
// ends is met by one of them to round-off.
class PolylineOutline final : public Outline {
 public:
  PolylineOutline(const std::vector<Vec2>& points, const std::vector<double>& radii, bool is_closed)
      : is_closed_(is_closed) {
    const std::size_t count = points.size(), flanks = is_closed ? count : count - 1;
    std::vector<Vec2> tangents;
    double size = 0.0;
    for (std::size_t i = 0; i < flanks; ++i) {
      const Vec2 side = points[(i + 1) % count] - points[i];
      tangents.push_back(side.normalized());
      size += side.norm();
    }
    const auto turn_at = [&](std::size_t i) {  // at the end of flank i
      const bool is_end = !is_closed && i + 1 == flanks;
      return is_end ? 0.0 : turn_between(tangents[i], tangents[(i + 1) % flanks]);
    };
    const auto taken = [&](std::size_t point, double turn) { return radii[point] * std::tan(0.5 * std::abs(turn)); };
    double along = 0.0;
    for (std::size_t i = 0; i < flanks; ++i) {
      const double before = i > 0 || is_closed ? turn_at((i + flanks - 1) % flanks) : 0.0, behind = turn_at(i);
      const std::size_t next = (i + 1) % count;
      const double length = (points[next] - points[i]).norm() - taken(i, before) - taken(next, behind);
      flanks_.push_back({.along = along,
                         .from = points[i] + taken(i, before) * tangents[i],
                         .tangent = tangents[i],
                         .length = std::max(length, 0.0)});
      along += length;
      if (behind == 0.0) continue;
      const Vec2 left = perp(tangents[i]);
      const Vec2 inward = behind > 0.0 ? left : Vec2(-left);  // to the centre
      const Vec2 end = points[next] - taken(next, behind) * tangents[i];
      const double radius = radii[next];
      const double per_angle = std::max(radius, size / (20.0 * pi));
      roundings_.push_back({.along = along,
                            .centre = end + radius * inward,
                            .first = -inward,
                            .radius = radius,
                            .turn = behind,
                            .per_angle = per_angle});
      along += per_angle * std::abs(behind);
      if (behind > 0.0 && radius > 0.0) sharpest_ = std::max(sharpest_, 1.0 / radius);
    }
    end_ = along;
    if (!is_closed || doubled_area(points) < 0.0) core_ = deepest_place(*this, this->points(0.0));
  }

  OutlineFoot foot(const Vec2& position) const override {
    std::optional<OutlineFoot> nearest;
    const auto take = [&](const OutlineFoot& foot) {
      if (!nearest || std::abs(foot.distance) < std::abs(nearest->distance)) nearest = foot;
    };
    for (const Flank& flank : flanks_)
      if (const auto foot = on_flank(flank, position)) take(*foot);
    for (const Rounding& arc : roundings_)
      if (const auto foot = on_arc(arc, position)) take(*foot);
    if (is_closed_) return *nearest;
    for (const bool last : {false, true}) {
      const double far = (position - end(last)).norm();
      if (!nearest || far < std::abs(nearest->distance)) nearest = beyond(position, last);
    }
    return *nearest;
  }

  std::vector<double> knots() const override {
    std::vector<double> knots;
    for (const Flank& flank : flanks_) {
      knots.push_back(flank.along);
      knots.push_back(flank.along + 0.5 * flank.length);
    }
    for (const Rounding& arc : roundings_) {
      const int parts = std::max(2, static_cast<int>(std::ceil(std::abs(arc.turn) / arc_turn)));
      for (int i = 0; i < parts; ++i) knots.push_back(arc.along + arc.per_angle * std::abs(arc.turn) * i / parts);
    }
    if (!is_closed_) knots.push_back(end_);
    std::sort(knots.begin(), knots.end());
    knots.erase(std::unique(knots.begin(), knots.end()), knots.end());
    return knots;
  }
  double period() const override { return is_closed_ ? end_ : 0.0; }

  // Of arcs the coordinate runs faster or slower than the length.
  double length_to(double along) const override {
    double length = along;
    for (const Rounding& arc : roundings_)
      length -= (arc.per_angle - arc.radius) * std::clamp((along - arc.along) / arc.per_angle, 0.0, std::abs(arc.turn));
    return length;
  }

  std::vector<SharpCorner> sharp_corners() const override {
    std::vector<SharpCorner> corners;
    for (const Rounding& arc : roundings_) {
      if (arc.radius > 0.0) continue;
      const Vec2 behind = std::cos(arc.turn) * arc.first + std::sin(arc.turn) * perp(arc.first);
      corners.push_back({.place = arc.centre, .before = -perp(arc.first), .behind = -perp(behind)});
    }
    return corners;
  }

  double sharpest_hollow() const override { return sharpest_; }
  std::optional<Vec2> core() const override { return core_; }

  std::vector<Vec2> points(double) const override {
    constexpr int parts = 20;
    std::vector<Vec2> line;
    auto arc = roundings_.begin();
    for (const Flank& flank : flanks_) {
      for (int i = 0; i <= parts; ++i) line.push_back(flank.from + flank.tangent * (flank.length * i / parts));
      if (arc == roundings_.end() || arc->along < flank.along) continue;
      const double end_of_flank = flank.along + flank.length;
      if (std::abs(arc->along - end_of_flank) > 1e-9 * end_) continue;
      for (int i = 1; i < parts; ++i) {
        const double angle = arc->turn * i / parts;
        line.push_back(arc->centre + arc->radius * (std::cos(angle) * arc->first + std::sin(angle) * perp(arc->first)));
      }
      ++arc;
    }
    if (is_closed_) line.push_back(line.front());
    return line;
  }

 private:
  static constexpr double round_off = 1e-12;  // of lengths along the outline, and of angles

  std::optional<OutlineFoot> on_flank(const Flank& flank, const Vec2& position) const {
    const Vec2 arm = position - flank.from;
    const double ahead = flank.tangent.dot(arm);
    if (ahead < -round_off * end_ || ahead > flank.length + round_off * end_) return std::nullopt;
    return OutlineFoot{
        .distance = perp(flank.tangent).dot(arm), .tangent = flank.tangent, .along = flank.along + ahead};
  }

  static std::optional<OutlineFoot> on_arc(const Rounding& arc, const Vec2& position) {
    const Vec2 arm = position - arc.centre;
    const double far = arm.norm(), sign = arc.turn > 0.0 ? 1.0 : -1.0;
    if (far == 0.0) return std::nullopt;
    const double ahead = sign * turn_between(arc.first, arm);
    if (ahead < -round_off || ahead > std::abs(arc.turn) + round_off) return std::nullopt;
    const Vec2 outward = arm / far;
    return OutlineFoot{.distance = -sign * (far - arc.radius),
                       .tangent = sign * perp(outward),
                       .curvature = sign / far,
                       .along = arc.along + arc.per_angle * ahead};
  }

  Vec2 end(bool last) const {
    const Flank& flank = last ? flanks_.back() : flanks_.front();
    return flank.from + (last ? flank.length : 0.0) * flank.tangent;
  }

  OutlineFoot beyond(const Vec2& position, bool last) const {
    const Flank& flank = last ? flanks_.back() : flanks_.front();
    const Vec2 arm = position - end(last);
    const double ahead = flank.tangent.dot(arm);
    return {.distance = perp(flank.tangent).dot(arm),
            .tangent = flank.tangent,
            .along = (last ? end_ : 0.0) + ahead,
            .beyond = true,
            .from_end = arm.norm()};
  }

  bool is_closed_;
  std::vector<Flank> flanks_{};
  std::vector<Rounding> roundings_{};
  double end_ = 0.0, sharpest_ = 0.0;
  std::optional<Vec2> core_{};
};

}  // namespace

std::unique_ptr<Outline> polyline_outline(std::vector<Vec2> points, double corner_radius) {
  const std::vector<double> radii(points.size(), corner_radius);
  return polyline_outline(std::move(points), radii);
}

std::unique_ptr<Outline> closed_polyline_outline(std::vector<Vec2> points, double corner_radius, Keep keep) {
  const std::vector<double> radii(points.size(), corner_radius);
  return closed_polyline_outline(std::move(points), radii, keep);
}

std::unique_ptr<Outline> polyline_outline(std::vector<Vec2> points, std::vector<double> radii) {
  return std::make_unique<PolylineOutline>(points, radii, false);
}

std::unique_ptr<Outline> closed_polyline_outline(std::vector<Vec2> points, std::vector<double> radii, Keep keep) {
  if ((doubled_area(points) > 0.0) == (keep == Keep::outside)) {
    std::reverse(points.begin(), points.end());
    std::reverse(radii.begin(), radii.end());
  }
  return std::make_unique<PolylineOutline>(points, radii, true);
}

}  // namespace arcwall
