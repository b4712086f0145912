#include "contact/sliding/pulling_jumps.hpp"

#include <algorithm>
#include <cmath>

#include "contact/sliding/curve_pressure.hpp"

namespace arcwall::sliding {

namespace {

using Span = SlidingContactLayout::Span;
using Segment = SlidingContactLayout::Segment;

// A pressed part at one end of which is a point, with a free span beyond it.
struct Edge {
  std::size_t segment;
  bool first;  // of the part's ends
};

std::optional<Edge> edge_at(const SlidingContactLayout& on, std::size_t point) {
  const Span before = on.span_before(point), behind = on.points()[point].behind;
  if ((before == Span::pressed) == (behind == Span::pressed) || (before != Span::free && behind != Span::free))
    return std::nullopt;
  const bool first = behind == Span::pressed;
  const auto k = static_cast<Index>(point);
  for (std::size_t i = 0; i < on.segments().size(); ++i)
    if (const Segment& part = on.segments()[i];
        part.span == Span::pressed && (first ? part.first_point : part.last_point) == k)
      return Edge{.segment = i, .first = first};
  return std::nullopt;
}

// The elements that are asked for along a strand [length].
double element_of(const SlidingBody& body, Index strand) {
  const double L = body.length(strand);
  return L / body.elements_between(strand, 0.0, L);
}

double length_of(const SlidingSetting& setting, const SlidingState& at, const Segment& part) {
  const auto [from, to] = at.layout.ends(setting.body, part, at.now.s);
  return to - from;
}

}  // namespace

double pull(const SlidingSetting& setting, const MaterialPoint& place, std::size_t obstacle,
            const CurvatureRateJump& jump) {
  return -sign_of(setting.obstacles[obstacle].surface->side()) * setting.body.bending_stiffness(place) * jump.jump;
}

// An arch is up to 1.8 times as long as the part that holds the pull (8.11a), and no shorter than the shortest span.
LengthToHold length_to_hold(const SlidingSetting& setting, const SlidingState& at, std::size_t segment) {
  constexpr double elements = 2.0, least = 0.25;
  const Segment& part = at.layout.segments()[segment];
  const double asked = element_of(setting.body, part.strand);
  const double element = length_of(setting, at, part) / part.elements;
  const double seen = std::clamp(element, least * asked, asked);
  return {.value = elements * seen, .by_element = seen == element ? elements : 0.0};
}

NodeFunction beyond(const Obstacle& wall, const CurvatureRateJump& jump, const Touch& touch, const SlidingState& at) {
  const AxisPlace axis = touch.axis(at);
  const Vec2 place = face(touch.offset, axis), arm = place - axis.position;
  const LinearField far = wall.beyond(jump, place, at.now.lambda);
  return {.value = far.value, .gradient = {far.x, far.z, far.z * arm.x() - far.x * arm.y()}, .rate = far.rate};
}

std::optional<PullingJump> pulling_jump_beside(const SlidingSetting& setting, const SlidingState& at,
                                               std::size_t point) {
  constexpr double reach = 10.0, lies_across = 4.0;  // elements; the other half of the part is that of its other edge
  const Obstacle& wall = *setting.obstacles[at.layout.points()[point].obstacle].surface;
  if (wall.curvature_rate_jumps().empty()) return std::nullopt;
  const auto edge = edge_at(at.layout, point);
  if (!edge) return std::nullopt;
  const Touch touch = touch_of_contact(setting, at.layout, point);
  const double element = element_of(setting.body, touch.strand);
  const AxisPlace axis = touch.axis(at);
  const Vec2 place = face(touch.offset, axis);
  if (!wall.faces(place, at.now.lambda)) return std::nullopt;
  const Vec2 at_rest = wall.seen_at_rest(place, at.now.lambda);
  const Segment& part = at.layout.segments()[edge->segment];
  const CurvePressure on(setting, at, edge->segment);
  const double at_edge = on.pressure(edge->first ? 0 : part.elements);
  const double to_hold = length_to_hold(setting, at, edge->segment).value;
  const double across = std::min(lies_across * element, 0.5 * length_of(setting, at, part));
  const double away = (edge->first ? -1.0 : 1.0) * travel(wall, place, axis.angle, at.now.lambda);
  std::optional<PullingJump> tightest;
  for (const CurvatureRateJump& jump : wall.curvature_rate_jumps()) {
    if ((jump.place - at_rest).norm() > reach * element) continue;
    if (pull(setting, {touch.strand, on.coordinate(0.0)}, touch.obstacle, jump) <= 0.0) continue;
    const NodeFunction here = beyond(wall, jump, touch, at);
    const double distance = -away * here.value - jump.half_width;
    if (distance < -across) continue;
    const double inside = std::max(-distance, 0.0) / on.element();
    const double there = edge->first ? inside : part.elements - inside;
    const double force = pull(setting, {touch.strand, on.coordinate(there)}, touch.obstacle, jump);
    const PullingJump found{
        .at = jump,
        .segment = edge->segment,
        .place = there,
        .distance = {.value = distance, .gradient = -away * here.gradient, .rate = -away * here.rate},
        .held = force / std::max(at_edge, 0.0),
        .left = (inside > 0.0 ? on.pressure_between(there) : at_edge) - force / to_hold};
    if (!tightest || found.room(setting.scales) < tightest->room(setting.scales)) tightest = found;
  }
  return tightest;
}

Row room_gradient(const SlidingSetting& setting, const SlidingState& at, std::size_t point, const PullingJump& jump) {
  const Touch touch = touch_of_contact(setting, at.layout, point);
  const NodeUnknowns node = at.mesh.node_unknowns(touch.strand, touch.position);
  Row row = at.no_slope();
  if (jump.room(setting.scales) == jump.distance.value / setting.scales.length) {
    const double scale = 1.0 / setting.scales.length;
    add_at_node(node, scale * jump.distance.gradient, row.dx);
    row.dlambda = scale * jump.distance.rate;
    return row;
  }
  const CurvePressure on(setting, at, jump.segment);
  const LengthToHold to_hold = length_to_hold(setting, at, jump.segment);
  const double scale = setting.scales.length / setting.scales.force;
  on.add_gradient_between(jump.place, scale, row);
  const double force = pull(setting, {touch.strand, on.coordinate(jump.place)}, touch.obstacle, jump.at);
  double by_element = force * to_hold.by_element / (to_hold.value * to_hold.value);
  if (jump.distance.value < 0.0) {  // the place moves in the part
    const double h = on.element(), toward_last = edge_at(at.layout, point)->first ? 1.0 : -1.0;
    const double by_distance = -toward_last * on.slope_between(jump.place) / h;
    add_at_node(node, scale * by_distance * jump.distance.gradient, row.dx);
    row.dlambda += scale * by_distance * jump.distance.rate;
    by_element -= by_distance * jump.distance.value / h;
  }
  on.add_element_gradient(scale * by_element, row);
  return row;
}

std::optional<double> pushing_jump_beside(const SlidingSetting& setting, const SlidingState& at, std::size_t point,
                                          double reach) {
  const Touch touch = touch_of_contact(setting, at.layout, point);
  const Obstacle& wall = *setting.obstacles[touch.obstacle].surface;
  const AxisPlace axis = touch.axis(at);
  const Vec2 place = face(touch.offset, axis);
  if (!wall.faces(place, at.now.lambda)) return std::nullopt;
  const Vec2 at_rest = wall.seen_at_rest(place, at.now.lambda);
  const double way = travel(wall, place, axis.angle, at.now.lambda);
  std::optional<double> nearest;
  for (const CurvatureRateJump& jump : wall.curvature_rate_jumps()) {
    if (pull(setting, {touch.strand, at.s(static_cast<Index>(point))}, touch.obstacle, jump) >= 0.0 ||
        (jump.place - at_rest).norm() > reach)
      continue;
    const double ahead = -way * beyond(wall, jump, touch, at).value;
    if (!nearest || std::abs(ahead) < std::abs(*nearest)) nearest = ahead;
  }
  return nearest;
}

bool bridges_pulling_jump(const SlidingSetting& setting, const SlidingState& at, std::size_t point) {
  const bool before = at.layout.span_before(point) == Span::pressed;
  if (before == (at.layout.points()[point + 1].behind == Span::pressed)) return false;
  const std::size_t edge = before ? point : point + 1, other = before ? point + 1 : point;
  const auto ahead = pulling_jump_beside(setting, at, edge);
  if (!ahead || ahead->distance.value < 0.0 || ahead->left >= 0.0) return false;
  const Obstacle& wall = *setting.obstacles[at.layout.points()[point].obstacle].surface;
  return beyond(wall, ahead->at, touch_of_contact(setting, at.layout, edge), at).value *
             beyond(wall, ahead->at, touch_of_contact(setting, at.layout, other), at).value <=
         0.0;
}

}  // namespace arcwall::sliding
