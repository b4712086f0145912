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

BeyondJump::BeyondJump(const SlidingSetting& setting, const SlidingState& at, const Touch& touch,
                       const CurvatureJump& jump, double to, std::size_t point)
    : setting_(setting), point_(point), sign_(to) {
  const Obstacle& wall = *setting.obstacles[touch.obstacle].surface;
  const Vec2 along = unit_tangent(touch.axis(at).angle);
  const Vec2 behind = jump.place + setting.scales.length * along;
  at_rest_.place = wall.seen_at_rest(jump.place, at.now.lambda);
  at_rest_.tangent = (wall.seen_at_rest(behind, at.now.lambda) - at_rest_.place).normalized();
}

double BeyondJump::value(const State& state) const {
  const SlidingState at(state);
  const Touch touch = touch_of_contact(setting_, at.layout, point_);
  return sign_ * beyond(*setting_.obstacles[touch.obstacle].surface, at_rest_, touch, at).value;
}

Row BeyondJump::gradient(const State& state) const {
  const SlidingState at(state);
  const Touch touch = touch_of_contact(setting_, at.layout, point_);
  const NodeFunction far = beyond(*setting_.obstacles[touch.obstacle].surface, at_rest_, touch, at);
  Row row = at.no_slope();
  add_at_node(at.mesh.node_unknowns(touch.strand, touch.position), sign_ * far.gradient, row.dx);
  row.dlambda = sign_ * far.rate;
  return row;
}

}  // namespace arcwall::sliding
