#include "contact/sliding/pulling_jumps.hpp"

#include <algorithm>
#include <cmath>

#include "contact/sliding/part_loads.hpp"

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

// The pressure of the wall on the two nodes next to the edge, less what loads add to it; 0 where it would pull.
double pressure_beside(const SlidingSetting& setting, const SlidingState& at, const Edge& edge) {
  const Segment& part = at.layout.segments()[edge.segment];
  const auto& pressed = at.layout.pressed_nodes();
  const auto of_part = [&](const auto& node) { return node.segment == edge.segment; };
  const auto begin = std::find_if(pressed.begin(), pressed.end(), of_part) - pressed.begin();
  const Vector loads = forces_of_loads(setting, at, edge.segment);
  const Index nodes = loads.size(), seen = std::min(nodes, Index{2});
  double sum = 0.0;
  for (Index j = 0; j < seen; ++j) {
    const Index node = edge.first ? j : nodes - 1 - j;
    sum += at.pressed_force(static_cast<std::size_t>(begin + node)) - loads[node];
  }
  const double element = length_of(setting, at, part) / part.elements;
  return seen == 0 ? 0.0 : std::max(sum / (double(seen) * element), 0.0);
}

// How far the place of a touch is beyond a jump.
NodeFunction beyond(const Obstacle& wall, const CurvatureRateJump& jump, const Touch& touch, const SlidingState& at) {
  const AxisPlace axis = touch.axis(at);
  const Vec2 place = face(touch.offset, axis), arm = place - axis.position;
  const LinearField far = wall.beyond(jump, place, at.now.lambda);
  return {.value = far.value, .gradient = {far.x, far.z, far.z * arm.x() - far.x * arm.y()}, .rate = far.rate};
}

}  // namespace

std::optional<PullingJump> pulling_jump_ahead(const SlidingSetting& setting, const SlidingState& at,
                                              std::size_t point) {
  constexpr double shown = 2.0;                      // elements over whose pressure it has to pull to be seen
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
  const double pressure = pressure_beside(setting, at, *edge);
  const double length = length_of(setting, at, at.layout.segments()[edge->segment]);
  const double across = std::min(lies_across * element, 0.5 * length);
  const double away = (edge->first ? -1.0 : 1.0) * travel(wall, place, axis.angle, at.now.lambda);
  std::optional<PullingJump> nearest;
  for (const CurvatureRateJump& jump : wall.curvature_rate_jumps()) {
    if ((jump.place - at_rest).norm() > reach * element) continue;
    const double pull = -sign_of(wall.side()) * setting.body.bending_stiffness(touch.strand) * jump.jump;
    if (!(pull > shown * element * pressure)) continue;
    const NodeFunction here = beyond(wall, jump, touch, at);
    const double distance = -away * here.value - jump.half_width;
    if (distance < -across || (nearest && nearest->distance.value <= distance)) continue;
    nearest = {.at = jump,
               .distance = {.value = distance, .gradient = -away * here.gradient, .rate = -away * here.rate},
               .held = pull / pressure};
  }
  return nearest;
}

bool bridges_pulling_jump(const SlidingSetting& setting, const SlidingState& at, std::size_t point) {
  const bool before = at.layout.span_before(point) == Span::pressed;
  if (before == (at.layout.points()[point + 1].behind == Span::pressed)) return false;
  const std::size_t edge = before ? point : point + 1, other = before ? point + 1 : point;
  const auto ahead = pulling_jump_ahead(setting, at, edge);
  if (!ahead || ahead->distance.value < 0.0) return false;
  const Obstacle& wall = *setting.obstacles[at.layout.points()[point].obstacle].surface;
  return beyond(wall, ahead->at, touch_of_contact(setting, at.layout, edge), at).value *
             beyond(wall, ahead->at, touch_of_contact(setting, at.layout, other), at).value <=
         0.0;
}

}  // namespace arcwall::sliding
