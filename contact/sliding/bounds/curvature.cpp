#include "contact/sliding/bounds/curvature.hpp"

#include <algorithm>

#include "contact/sliding/bending.hpp"
#include "contact/sliding/curvature_jumps.hpp"
#include "contact/sliding/differences.hpp"
#include "contact/sliding/remeshing.hpp"
#include "contact/sliding/spreading.hpp"

namespace arcwall::sliding {

namespace {

// Curvature of an open point over its gap, both scaled, below which it is given up; the more, the farther it is from
// its wall: a node that no contact needs makes the mesh of a symmetric body unsymmetric.
constexpr double flatness = 0.5, far_off = 0.003;

double allowed_gap(double gap) { return flatness * gap * (1.0 + gap * gap / (far_off * far_off)); }
double allowed_gap_slope(double gap) { return flatness * (1.0 + 3.0 * gap * gap / (far_off * far_off)); }

constexpr double reach = 1e-4;  // of the length scale, beside a jump of the wall's curvature

// What an open point loses of its curvature gap behind a jump of the wall's curvature beside it, as where an arc goes
// over into a line: bit by bit as it comes there.
double loss_beside_jumps(const SlidingSetting& setting, const Touch& touch, const AxisPlace& axis, double lambda) {
  const double length = reach * setting.scales.length;
  const double side = sign_of(setting.obstacles[touch.obstacle].surface->side());
  double most = 0.0;
  for (const double to : {1.0, -1.0})
    if (const auto jump = curvature_jump_beside(setting, touch, axis, to, length, lambda)) {
      const double lost =
          side * (parallel_curvature(touch.offset, jump->behind) - parallel_curvature(touch.offset, jump->here));
      most = std::max(most, lost * (1.0 - jump->distance / length));
    }
  return most;
}

}  // namespace

double CurvatureBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  const double bend = curvature_gap(setting, at, point_) * setting.scales.length;
  if (at.is_closed(point_)) return bend;
  const Touch touch = touch_of_contact(setting, at.layout, point_);
  const double loss = loss_beside_jumps(setting, touch, touch.axis(at), at.now.lambda) * setting.scales.length;
  return bend - loss - allowed_gap(face_gap(setting, touch, at) / setting.scales.length);
}

Row CurvatureBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  Row row = at.no_slope();
  curvature_gap_gradient(setting, at, point_).add_to(row, setting.scales.length, at.index);
  if (at.is_closed(point_)) return row;
  const Touch touch = touch_of_contact(setting, at.layout, point_);
  const NodeFunction gap = touch_gap(setting, touch, at).gap;
  const double by_gap = -allowed_gap_slope(gap.value / setting.scales.length) / setting.scales.length;
  const NodeUnknowns unknowns = at.mesh.node_unknowns(touch.strand, touch.position);
  add_at_node(unknowns, by_gap * gap.gradient, row.dx);
  row.dlambda += by_gap * gap.rate;
  const AxisPlace axis = touch.axis(at);
  if (loss_beside_jumps(setting, touch, axis, at.now.lambda) == 0.0) return row;
  const double step = 1e-2 * reach, length = setting.scales.length;
  const auto loss = [&](const Vec2& by_place, double by_angle, double by_lambda) {
    return length *
           derivative_by_two(
               [&](double d) {
                 const AxisPlace there{.position = axis.position + d * by_place, .angle = axis.angle + d * by_angle};
                 return loss_beside_jumps(setting, touch, there, at.now.lambda + d * by_lambda);
               },
               step);
  };
  add_at_node(unknowns,
              -Eigen::Vector3d(loss(length * Vec2::UnitX(), 0.0, 0.0) / length,
                               loss(length * Vec2::UnitY(), 0.0, 0.0) / length, loss(Vec2::Zero(), 1.0, 0.0)),
              row.dx);
  row.dlambda -= loss(Vec2::Zero(), 0.0, 1.0);
  return row;
}

std::vector<Transition> CurvatureBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                                    const Arrival& arrival) const {
  if (at.is_closed(point_)) return zones_or_arches_from_points(setting, at, arrival);
  return {without_point(setting, at, arrival.forward, point_)};
}

}  // namespace arcwall::sliding
