#include "contact/sliding/touch.hpp"
#include "contact/sliding/tolerances.hpp"

#include <algorithm>
#include <cmath>

namespace arcwall::sliding {

namespace {

// A function of the place of the face, r + o n(θ), by the node: with the tangent t, ∂n/∂θ = −t and ∂²n/∂θ² = −n.
NodeFunction at_face(const QuadraticField& f, double offset, const AxisPlace& axis) {
  const Vec2 t(std::cos(axis.angle), std::sin(axis.angle)), n(-t.y(), t.x());
  const double o = t.x() >= 0.0 ? offset : -offset;
  NodeFunction out{.value = f.value, .rate = f.rate};
  out.gradient << f.x, f.z, -o * (f.x * t.x() + f.z * t.y());
  out.gradient_rate << f.x_rate, f.z_rate, -o * (f.x_rate * t.x() + f.z_rate * t.y());
  out.hessian(0, 0) = f.xx;
  out.hessian(1, 1) = f.zz;
  out.hessian(0, 1) = out.hessian(1, 0) = f.xz;
  out.hessian(0, 2) = out.hessian(2, 0) = -o * (f.xx * t.x() + f.xz * t.y());
  out.hessian(1, 2) = out.hessian(2, 1) = -o * (f.xz * t.x() + f.zz * t.y());
  out.hessian(2, 2) = o * o * (f.xx * t.x() * t.x() + 2.0 * f.xz * t.x() * t.y() + f.zz * t.y() * t.y()) -
                      o * (f.x * n.x() + f.z * n.y());
  return out;
}

NodeFunction opposite(const NodeFunction& f) {
  return {.value = -f.value,
          .gradient = -f.gradient,
          .hessian = -f.hessian,
          .rate = -f.rate,
          .gradient_rate = -f.gradient_rate};
}

// A support may move the node with λ: `rate` is that of its x, z and rotation at fixed unknowns.
void add_motion_of_node(const Eigen::Vector3d& rate, NodeFunction& f) {
  f.rate += f.gradient.dot(rate);
  f.gradient_rate += f.hessian * rate;
}

}  // namespace

Touch touch_of_contact(const SlidingSetting& setting, const SlidingContactLayout& layout, std::size_t contact) {
  if (contact < layout.points().size()) {
    const auto [strand, position] = layout.mesh().breakpoint(static_cast<Index>(contact));
    const std::size_t obstacle = layout.points()[contact].obstacle;
    return {
        .strand = strand, .position = position, .obstacle = obstacle, .offset = setting.face_offset(obstacle, strand)};
  }
  return touch_of_end(setting, layout, setting.free_ends[contact - layout.points().size()]);
}

Touch touch_of_end(const SlidingSetting& setting, const SlidingContactLayout& layout, const FreeEnd& end) {
  return {.strand = end.strand,
          .position = end.position(layout.mesh()),
          .obstacle = end.obstacle,
          .offset = setting.face_offset(end.obstacle, end.strand)};
}

bool lies_flat(const SlidingSetting& setting, const SlidingContactLayout& layout, std::size_t contact) {
  if (contact < layout.points().size()) return false;
  const FreeEnd& end = setting.free_ends[contact - layout.points().size()];
  const auto point = layout.point_at_end(end.strand, end.last);
  return point && layout.points()[*point].obstacle == end.obstacle &&
         layout.span_at_end(end.strand, end.last) == SlidingContactLayout::Span::flat;
}

bool is_inside_zone(const SlidingSetting& setting, const SlidingContactLayout& layout, std::size_t contact) {
  if (contact < layout.points().size()) return false;
  const FreeEnd& end = setting.free_ends[contact - layout.points().size()];
  if (!setting.body.is_on_plane(end.strand, end.last)) return false;
  const auto is_pressed = [&](const StrandEnd& of) { return layout.pressed_up_to(of) == end.obstacle; };
  return is_pressed({.strand = end.strand, .last = end.last}) ||
         std::any_of(end.joined.begin(), end.joined.end(), is_pressed);
}

bool is_tangent_at_plane(const SlidingSetting& setting, const SlidingState& at, const FreeEnd& end) {
  if (!setting.body.is_on_plane(end.strand, end.last)) return false;
  const Touch touch = touch_of_end(setting, at.layout, end);
  return std::isfinite(face_gap(setting, touch, at)) &&
         std::abs(touch_gap(setting, touch, at).tilt.value) <= exactly_parallel;
}

Touch touch_of_node(const SlidingSetting& setting, const SlidingContactLayout::PressedNode& node) {
  return {.strand = node.strand,
          .position = node.position,
          .obstacle = node.obstacle,
          .offset = setting.face_offset(node.obstacle, node.strand)};
}

Touch touch_of_tip(const SlidingSetting& setting, const SlidingContactLayout::PressedTip& tip) {
  return {.strand = tip.strand,
          .position = tip.position,
          .obstacle = tip.obstacle,
          .offset = setting.face_offset(tip.obstacle, tip.strand)};
}

double travel(const Obstacle& surface, const Vec2& place, double angle, double lambda) {
  return std::cos(angle - surface.direction(place, lambda).value) >= 0.0 ? 1.0 : -1.0;
}

Vec2 face(double offset, const AxisPlace& axis) {
  const Vec2 normal(-std::sin(axis.angle), std::cos(axis.angle));
  return axis.position + (std::cos(axis.angle) >= 0.0 ? offset : -offset) * normal;
}

double face_gap(const SlidingObstacle& obstacle, double offset, const AxisPlace& axis, double lambda) {
  return obstacle.surface->gap_slope(face(offset, axis), lambda).value;
}

double face_gap(const SlidingSetting& setting, const Touch& touch, const SlidingState& at) {
  return face_gap(setting.obstacles[touch.obstacle], touch.offset, touch.axis(at), at.now.lambda);
}

// The tilt is θ − φ(face, λ), φ the direction of the obstacle's surface.
TouchGap touch_gap(const SlidingSetting& setting, const Touch& touch, const SlidingState& at) {
  const AxisPlace axis = touch.axis(at);
  const Obstacle& surface = *setting.obstacles[touch.obstacle].surface;
  const Vec2 place = face(touch.offset, axis);
  const QuadraticField gap = surface.gap(place, at.now.lambda), direction = surface.direction(place, at.now.lambda);
  TouchGap out{.gap = at_face(gap, touch.offset, axis),
               .tilt = opposite(at_face(direction, touch.offset, axis)),
               .angle = axis.angle - direction.value};
  out.tilt.value = std::remainder(out.angle, pi);
  out.tilt.gradient[2] += 1.0;
  const Eigen::Vector3d rate = at.mesh.node_rate(touch.strand, touch.position);
  for (NodeFunction* f : {&out.gap, &out.tilt}) add_motion_of_node(rate, *f);
  return out;
}

NodeFunction touched_place(const SlidingSetting& setting, const Touch& touch, const SlidingState& at, double near) {
  const AxisPlace axis = touch.axis(at);
  const SlidingObstacle& obstacle = setting.obstacles[touch.obstacle];
  const double offset = obstacle.rubbing_offset(setting.body.half_height(touch.strand));
  NodeFunction place = at_face(obstacle.surface->arc_length(face(offset, axis), at.now.lambda), offset, axis);
  if (sign_of(obstacle.surface->side()) < 0.0) place = opposite(place);
  if (const double round = obstacle.surface->round_length(); round > 0.0)
    place.value += round * std::round((near - place.value) / round);
  add_motion_of_node(at.mesh.node_rate(touch.strand, touch.position), place);
  return place;
}

void add_at_node(const NodeUnknowns& unknowns, const Eigen::Vector3d& values, Eigen::Ref<Vector> to) {
  for (std::size_t i = 0; i < 3; ++i)
    if (unknowns[i] >= 0) to[unknowns[i]] += values[static_cast<Index>(i)];
}

}  // namespace arcwall::sliding
