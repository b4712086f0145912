#include "contact/sliding/curvature_jumps.hpp"

#include "contact/passing.hpp"
#include "contact/sliding/pulling_jumps.hpp"
#include "core/unit_tangent.hpp"

namespace arcwall::sliding {

std::optional<CurvatureJump> curvature_jump_beside(const SlidingSetting& setting, const Touch& touch,
                                                   const AxisPlace& axis, double to, double reach, double lambda) {
  constexpr int digits = 40;  // binary, of the place
  const Obstacle& wall = *setting.obstacles[touch.obstacle].surface;
  const Vec2 here = face(touch.offset, axis), way = to * reach * unit_tangent(axis.angle);
  if (wall.is_smooth() || !wall.faces(here, lambda) || !wall.faces(here + way, lambda)) return std::nullopt;
  const auto curvature = [&](double far) { return wall.curvature(here + far * way, lambda).value; };
  const double near = curvature(0.0), behind = curvature(1.0);
  if (!curvature_jumps(near, behind)) return std::nullopt;
  double from = 0.0, beyond = 1.0;
  for (int i = 0; i < digits; ++i) {
    const double middle = 0.5 * (from + beyond);
    (curvature_jumps(near, curvature(middle)) ? beyond : from) = middle;
  }
  if (!curvature_jumps(curvature(from), curvature(beyond))) return std::nullopt;  // it changes fast, but smoothly
  return CurvatureJump{.distance = from * reach, .here = near, .behind = behind, .place = here + beyond * way};
}

WallKink kink_at(const SlidingSetting& setting, const SlidingState& at, const Touch& touch, const CurvatureJump& jump,
                 double to) {
  const Obstacle& wall = *setting.obstacles[touch.obstacle].surface;
  const Vec2 along = unit_tangent(touch.axis(at).angle);
  const Vec2 behind = jump.place + setting.scales.length * along;
  WallKink kink{.sense = to};
  kink.at.place = wall.seen_at_rest(jump.place, at.now.lambda);
  kink.at.tangent = (wall.seen_at_rest(behind, at.now.lambda) - kink.at.place).normalized();
  return kink;
}

double PastKink::value(const State& state) const {
  const SlidingState at(state);
  const Touch touch = touch_of_contact(setting_, at.layout, contact_);
  return kink_.sense * beyond(*setting_.obstacles[touch.obstacle].surface, kink_.at, touch, at).value;
}

Row PastKink::gradient(const State& state) const {
  const SlidingState at(state);
  const Touch touch = touch_of_contact(setting_, at.layout, contact_);
  const NodeFunction far = beyond(*setting_.obstacles[touch.obstacle].surface, kink_.at, touch, at);
  Row row = at.no_slope();
  add_at_node(at.mesh.node_unknowns(touch.strand, touch.position), kink_.sense * far.gradient, row.dx);
  row.dlambda = kink_.sense * far.rate;
  return row;
}

}  // namespace arcwall::sliding
