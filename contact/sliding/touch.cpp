#include "contact/sliding/touch.hpp"

#include <cmath>

namespace arcwall::sliding {

Touch touch_of_contact(const SlidingSetting& setting, const SlidingContactLayout& layout, std::size_t contact) {
  if (contact < layout.points().size()) {
    const auto [strand, position] = layout.mesh().breakpoint(static_cast<Index>(contact));
    const std::size_t obstacle = layout.points()[contact].obstacle;
    return {
        .strand = strand, .position = position, .obstacle = obstacle, .offset = setting.face_offset(obstacle, strand)};
  }
  const FreeEnd& end = setting.free_ends[contact - layout.points().size()];
  return {.strand = end.strand,
          .position = end.position(layout.mesh()),
          .obstacle = end.obstacle,
          .offset = setting.face_offset(end.obstacle, end.strand)};
}

Touch touch_of_node(const SlidingSetting& setting, const SlidingContactLayout::PressedNode& node) {
  return {.strand = node.strand,
          .position = node.position,
          .obstacle = node.obstacle,
          .offset = setting.face_offset(node.obstacle, node.strand)};
}

double travel(const AxisPlace& axis) { return std::cos(axis.angle) >= 0.0 ? 1.0 : -1.0; }

Vec2 face(double offset, const AxisPlace& axis) {
  const Vec2 normal(-std::sin(axis.angle), std::cos(axis.angle));
  return axis.position + (std::cos(axis.angle) >= 0.0 ? offset : -offset) * normal;
}

double face_gap(const SlidingObstacle& obstacle, double offset, const AxisPlace& axis) {
  const Vec2 at = face(offset, axis);
  return obstacle.profile->covers(at.x()) ? surface_gap(*obstacle.profile, obstacle.side, at).value : infinity;
}

double face_gap(const SlidingSetting& setting, const Touch& touch, const SlidingState& at) {
  return face_gap(setting.obstacles[touch.obstacle], touch.offset, touch.axis(at));
}

// The face r + o n(θ) with ∂n/∂θ = −t; the tilt is θ − φ(x of the face), φ the wall's slope.
TouchGap touch_gap(const SlidingObstacle& obstacle, double offset, const AxisPlace& axis) {
  const Vec2 t(std::cos(axis.angle), std::sin(axis.angle)), n(-t.y(), t.x());
  const double o = t.x() >= 0.0 ? offset : -offset;
  const Vec2 face = axis.position + o * n;
  const SurfaceGap g = surface_gap(*obstacle.profile, obstacle.side, face);
  const SurfaceBend wall = surface_bend(*obstacle.profile, face.x());
  const double sway = o * t.x();  // of the face against x, by angle

  TouchGap out;
  out.gap = g.value;
  out.angle = axis.angle - wall.angle;
  out.tilt = std::remainder(out.angle, pi);
  out.gap_gradient << g.x, g.z, -o * (g.x * t.x() + g.z * t.y());
  out.tilt_gradient << -wall.angle_x, 0.0, 1.0 + wall.angle_x * o * t.x();
  out.tilt_hessian.setZero();
  out.tilt_hessian(0, 0) = -wall.angle_xx;
  out.tilt_hessian(0, 2) = out.tilt_hessian(2, 0) = wall.angle_xx * sway;
  out.tilt_hessian(2, 2) = -wall.angle_xx * sway * sway + wall.angle_x * o * n.x();
  out.gap_hessian.setZero();
  out.gap_hessian(0, 0) = g.xx;
  out.gap_hessian(0, 1) = out.gap_hessian(1, 0) = g.xz;
  out.gap_hessian(0, 2) = out.gap_hessian(2, 0) = -o * (g.xx * t.x() + g.xz * t.y());
  out.gap_hessian(1, 2) = out.gap_hessian(2, 1) = -o * g.xz * t.x();
  out.gap_hessian(2, 2) = o * o * (g.xx * t.x() * t.x() + 2.0 * g.xz * t.x() * t.y()) - o * (g.x * n.x() + g.z * n.y());
  return out;
}

TouchGap touch_gap(const SlidingSetting& setting, const Touch& touch, const SlidingState& at) {
  return touch_gap(setting.obstacles[touch.obstacle], touch.offset, touch.axis(at));
}

void add_at_node(const NodeUnknowns& unknowns, const Eigen::Vector3d& values, Eigen::Ref<Vector> to) {
  for (std::size_t i = 0; i < 3; ++i)
    if (unknowns[i] >= 0) to[unknowns[i]] += values[static_cast<Index>(i)];
}

SurfaceBend surface_bend(const Profile& profile, double x) {
  const Height psi = profile.at(x);
  const double w = 1.0 + psi.first * psi.first, root = std::sqrt(w);
  return {.angle = std::atan(psi.first),
          .angle_x = psi.second / w,
          .angle_xx = psi.third / w - 2.0 * psi.first * psi.second * psi.second / (w * w),
          .curvature = psi.second / (w * root),
          .curvature_x = psi.third / (w * root) - 3.0 * psi.first * psi.second * psi.second / (w * w * root)};
}

}  // namespace arcwall::sliding
