#include "contact/outline.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcwall {

namespace {

constexpr double knot_turn = pi / 18.0;  // of a circle between two of its knots [rad]
constexpr double least_radius = 1e-300;  // where the distance from a centre says nothing about the direction

class HalfPlaneOutline final : public Outline {
 public:
  HalfPlaneOutline(const Vec2& point, const Vec2& normal) : point_(point), tangent_(-perp(normal.normalized())) {}

  OutlineFoot foot(const Vec2& position) const override {
    const Vec2 arm = position - point_;
    return {.distance = perp(tangent_).dot(arm), .tangent = tangent_, .along = tangent_.dot(arm)};
  }
  double length_to(double along) const override { return along; }
  double sharpest_hollow() const override { return 0.0; }

  std::vector<Vec2> points(double reach) const override {
    constexpr int parts = 400;
    std::vector<Vec2> line;
    for (int i = 0; i <= parts; ++i) line.push_back(point_ + reach * (2.0 * i / parts - 1.0) * tangent_);
    return line;
  }

 private:
  Vec2 point_, tangent_;
};

// Outside a circle the outline runs clockwise, inside anticlockwise: the body is to the left.
class CircleOutline final : public Outline {
 public:
  CircleOutline(const Vec2& centre, double radius, Keep keep)
      : centre_(centre), radius_(radius), sign_(keep == Keep::outside ? 1.0 : -1.0) {}

  OutlineFoot foot(const Vec2& position) const override {
    const Vec2 arm = position - centre_;
    const double far = std::max(arm.norm(), least_radius);
    const Vec2 normal = arm.isZero(0.0) ? Vec2(sign_, 0.0) : Vec2(sign_ * arm / far);
    return {.distance = sign_ * (far - radius_),
            .tangent = -perp(normal),
            .curvature = -sign_ / far,
            .along = -sign_ * std::atan2(arm.y(), arm.x())};
  }

  std::vector<double> knots() const override {
    std::vector<double> angles;
    for (double angle = -pi; angle < pi - 0.5 * knot_turn; angle += knot_turn) angles.push_back(angle);
    return angles;
  }
  bool is_smooth() const override { return true; }
  double period() const override { return 2.0 * pi; }
  double length_to(double along) const override { return radius_ * along; }
  double sharpest_hollow() const override { return sign_ < 0.0 ? 1.0 / radius_ : 0.0; }
  std::optional<Vec2> core() const override { return sign_ > 0.0 ? std::optional(centre_) : std::nullopt; }

  std::vector<Vec2> points(double) const override {
    constexpr int parts = 360;
    std::vector<Vec2> line;
    for (int i = 0; i <= parts; ++i) {
      const double angle = -sign_ * 2.0 * pi * i / parts;
      line.push_back(centre_ + radius_ * Vec2(std::cos(angle), std::sin(angle)));
    }
    return line;
  }

 private:
  Vec2 centre_;
  double radius_, sign_;
};

// With n the normal to the left, t the tangent, κ the curvature of the parallel curve at the distance d and κ′ its
// slope: ∇d = n, ∇φ = κ t, ∇κ = κ′ t + κ² n, and ∂t/∂r = κ n tᵀ.
class OutlineObstacle final : public Obstacle {
 public:
  OutlineObstacle(std::shared_ptr<const Outline> outline, double half_height, double retracted)
      : outline_(std::move(outline)),
        half_height_(half_height),
        retracted_(retracted),
        knots_(outline_->knots()),
        jumps_(jumps_of(*outline_, half_height)) {}

  Side side() const override { return Side::below; }
  bool faces(const Vec2& position, double) const override { return !outline_->foot(position).beyond; }

  std::vector<SharpCorner> sharp_corners() const override {
    return half_height_ == 0.0 ? outline_->sharp_corners() : std::vector<SharpCorner>{};
  }

  // ∇∇d = −κ t tᵀ
  QuadraticField gap(const Vec2& position, double lambda) const override {
    const OutlineFoot at = outline_->foot(position);
    const Vec2 n = perp(at.tangent), t = at.tangent;
    return {.value = at.distance - distance_off(lambda),
            .x = n.x(),
            .z = n.y(),
            .xx = -at.curvature * t.x() * t.x(),
            .xz = -at.curvature * t.x() * t.y(),
            .zz = -at.curvature * t.y() * t.y(),
            .rate = -retracted_};
  }

  LinearField gap_slope(const Vec2& position, double lambda) const override {
    const OutlineFoot at = outline_->foot(position);
    if (at.beyond) return {.value = infinity};
    const Vec2 n = perp(at.tangent);
    return {.value = at.distance - distance_off(lambda), .x = n.x(), .z = n.y(), .rate = -retracted_};
  }

  // ∇∇φ = κ′ t tᵀ + κ² (t nᵀ + n tᵀ)
  QuadraticField direction(const Vec2& position, double) const override {
    const OutlineFoot at = outline_->foot(position);
    const Vec2 n = perp(at.tangent), t = at.tangent;
    const double k = at.curvature, slope = at.curvature_slope;
    return {.value = std::atan2(t.y(), t.x()),
            .x = k * t.x(),
            .z = k * t.y(),
            .xx = slope * t.x() * t.x() + 2.0 * k * k * t.x() * n.x(),
            .xz = slope * t.x() * t.y() + k * k * (t.x() * n.y() + n.x() * t.y()),
            .zz = slope * t.y() * t.y() + 2.0 * k * k * t.y() * n.y()};
  }

  // Of the surface, from that of the parallel curve through the position: κ/(1 + κ g), which does not change across the
  // curves. Its rate at a fixed position is −(κ/(1 + κ g))² ∂g/∂λ.
  LinearField curvature(const Vec2& position, double lambda) const override {
    const OutlineFoot at = outline_->foot(position);
    const double shrink = 1.0 / (1.0 + at.curvature * (at.distance - distance_off(lambda)));
    const Vec2 slope = at.curvature_slope * shrink * shrink * at.tangent;
    const double curvature = at.curvature * shrink;
    return {.value = curvature, .x = slope.x(), .z = slope.y(), .rate = curvature * curvature * retracted_};
  }

  double curvature_second(const Vec2& position, double) const override {
    return outline_->foot(position).curvature_second;
  }

  double clearance(const Vec2& position, double lambda) const override {
    const OutlineFoot at = outline_->foot(position);
    const double off = distance_off(lambda);
    return at.beyond ? std::max(at.from_end - off, 0.0) : std::abs(at.distance - off);
  }

  double along(const Vec2& position, double) const override { return outline_->foot(position).along; }

  // σ − h φ, with σ the arc length and φ the direction of the outline, h half the height: the length of the parallel
  // curve. With w = 1/(1 − κ d) for the curvature κ of the outline: ∇σ = w t, ∇w = w² (d ∇κ + κ n), κ w the curvature
  // of the curve through the position.
  QuadraticField arc_length(const Vec2& position, double lambda) const override {
    const OutlineFoot at = outline_->foot(position);
    const Vec2 n = perp(at.tangent), t = at.tangent;
    const double w = 1.0 + at.curvature * at.distance;
    const Vec2 w_slope = at.distance * at.curvature_slope * t + w * at.curvature * n;
    QuadraticField length{.value = outline_->length_to(at.along),
                          .x = w * t.x(),
                          .z = w * t.y(),
                          .xx = t.x() * w_slope.x() + w * at.curvature * n.x() * t.x(),
                          .xz = t.x() * w_slope.y() + w * at.curvature * n.x() * t.y(),
                          .zz = t.y() * w_slope.y() + w * at.curvature * n.y() * t.y()};
    if (half_height_ == 0.0 && retracted_ == 0.0) return length;
    const double off = distance_off(lambda);
    const QuadraticField turned = direction(position, lambda);
    for (double QuadraticField::*part : {&QuadraticField::value, &QuadraticField::x, &QuadraticField::z,
                                         &QuadraticField::xx, &QuadraticField::xz, &QuadraticField::zz})
      length.*part -= off * turned.*part;
    length.rate = -retracted_ * turned.value;
    length.x_rate = -retracted_ * turned.x;
    length.z_rate = -retracted_ * turned.z;
    return length;
  }
  double round_length() const override {
    const double period = outline_->period();
    return period > 0.0 ? outline_->length_to(knots_.front() + period) - outline_->length_to(knots_.front()) : 0.0;
  }

  const std::vector<double>& knots() const override { return knots_; }
  bool is_smooth() const override { return outline_->is_smooth(); }
  double period() const override { return outline_->period(); }
  bool has_other_sides() const override { return !knots_.empty(); }
  std::optional<Vec2> core() const override { return outline_->core(); }
  double half_height() const override { return half_height_; }
  double greatest_speed(double) const override { return retracted_; }

  std::span<const CurvatureRateJump> curvature_rate_jumps() const override { return jumps_; }

  std::vector<Vec2> outline(double from, double to, double) const override {
    const Vec2 middle(0.5 * (from + to), 0.0);
    return outline_->points(2.0 * (to - from) + std::abs(outline_->foot(middle).along));
  }

 private:
  // How far the surface is from the outline.
  double distance_off(double lambda) const { return half_height_ + (lambda - 1.0) * retracted_; }

  // Of the parallel curve, whose curvature is κ/(1 − κ h) and whose length is 1 − κ h times as long.
  static std::vector<CurvatureRateJump> jumps_of(const Outline& outline, double half_height) {
    std::vector<CurvatureRateJump> jumps = outline.curvature_rate_jumps();
    for (CurvatureRateJump& jump : jumps) {
      const double shrink = 1.0 - outline.foot(jump.place).curvature * half_height;
      jump.place += half_height * perp(jump.tangent);
      jump.jump /= shrink * shrink * shrink;
      jump.half_width *= shrink;
    }
    return jumps;
  }

  std::shared_ptr<const Outline> outline_;
  double half_height_, retracted_;
  std::vector<double> knots_;
  std::vector<CurvatureRateJump> jumps_;
};

}  // namespace

std::shared_ptr<const Obstacle> obstacle(std::shared_ptr<const Outline> outline, double half_height, double retracted) {
  return std::make_shared<OutlineObstacle>(std::move(outline), half_height, retracted);
}

std::unique_ptr<Outline> half_plane_outline(const Vec2& point, const Vec2& normal) {
  return std::make_unique<HalfPlaneOutline>(point, normal);
}
std::unique_ptr<Outline> circle_outline(const Vec2& centre, double radius, Keep keep) {
  return std::make_unique<CircleOutline>(centre, radius, keep);
}

// From each line along the normal into the obstacle, by steps that double while the line is still the nearest.
std::optional<Vec2> deepest_place(const Outline& outline, const std::vector<Vec2>& line) {
  std::optional<Vec2> deepest;
  double depth = 0.0, length = 0.0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) length += (line[i + 1] - line[i]).norm();
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec2 side = line[i + 1] - line[i];
    if (side.isZero(0.0)) continue;
    const Vec2 from = 0.5 * (line[i] + line[i + 1]), inward = -perp(side.normalized());
    for (double step = 0.5 * side.norm(); step <= length; step *= 2.0) {
      const Vec2 place = from + step * inward;
      const OutlineFoot foot = outline.foot(place);
      const double here = -foot.distance;
      if (foot.beyond || here < 0.5 * step) break;
      if (here <= depth) continue;
      depth = here;
      deepest = place;
    }
  }
  return deepest;
}

double doubled_area(const std::vector<Vec2>& polygon) {
  double area = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i] - polygon[0], b = polygon[(i + 1) % polygon.size()] - polygon[0];
    area += cross(a, b);
  }
  return area;
}

}  // namespace arcwall
