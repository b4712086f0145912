#include "contact/sliding/bounds/straight_end.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "contact/sliding/lying.hpp"
#include "contact/sliding/remeshing.hpp"
#include "contact/sliding/tolerances.hpp"
#include "contact/sliding/touch.hpp"

namespace arcwall::sliding {

namespace {

// The end of a strand on its obstacle: its face and that in the strand's middle, the direction out of the strand, and
// the sense of the obstacle's coordinate that way.
struct EndOnObstacle {
  const Obstacle& surface;
  Touch touch;
  Vec2 place, middle, outward;
  double sense;
  double lambda;

  EndOnObstacle(const SlidingSetting& setting, const SlidingState& at, Index strand, bool last)
      : surface(*setting.obstacles[at.layout.lies_on(strand).value()].surface),
        touch(touch_of_end(setting, at.layout,
                           {.strand = strand, .last = last, .obstacle = at.layout.lies_on(strand).value()})),
        lambda(at.now.lambda) {
    const AxisPlace axis = touch.axis(at);
    place = face(touch.offset, axis);
    Touch inside = touch;
    inside.position = at.mesh.nodes(strand) / 2;
    middle = face(touch.offset, inside.axis(at));
    outward = (last ? 1.0 : -1.0) * Vec2(std::cos(axis.angle), std::sin(axis.angle));
    sense = (last ? 1.0 : -1.0) * travel(surface, place, axis.angle, lambda);
  }

  // Whether the obstacle goes on in line so far ahead: behind a sharp corner it is straight, too.
  bool goes_on_at(double ahead) const {
    const Vec2 there = middle + ahead * outward;
    return is_flush_at(surface, there, lambda) &&
           std::abs(surface.gap_slope(there, lambda).value) <=
               nearly_parallel * ahead + std::abs(surface.gap_slope(middle, lambda).value);
  }

  // The coordinate at which the straight stretch ends; on it the coordinate is a length.
  double end_of_stretch() const {
    const double here = surface.along(middle, lambda);
    std::vector<double> ahead;
    for (const double knot : surface.knots())
      if (const double distance = sense * (knot - here); distance > 0.0) ahead.push_back(distance);
    std::sort(ahead.begin(), ahead.end());
    double reached = 0.0;
    for (const double next : ahead) {
      if (!std::isfinite(next) || !goes_on_at(0.5 * (reached + next))) break;
      reached = next;
    }
    return here + sense * reached;
  }
};

}  // namespace

double StraightEndBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  const EndOnObstacle end(setting, at, strand_, last_);
  if (end.surface.knots().empty()) return no_guard;
  const double room = end.sense * (end.end_of_stretch() - end.surface.along(end.place, end.lambda));
  return room / setting.scales.length - touching_on_path;
}

Row StraightEndBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  Row row = at.no_slope();
  const EndOnObstacle end(setting, at, strand_, last_);
  if (end.surface.knots().empty()) return row;
  const double angle = end.surface.direction(end.place, end.lambda).value;
  const Vec2 by_place = -end.sense / setting.scales.length * Vec2(std::cos(angle), std::sin(angle));
  const double step = difference_step_at_place, lambda = end.lambda;
  const double by_lambda =
      (end.surface.along(end.place, lambda + step) - end.surface.along(end.place, lambda - step)) / (2.0 * step);
  add_at_node(at.mesh.node_unknowns(end.touch.strand, end.touch.position), {by_place.x(), by_place.y(), 0.0}, row.dx);
  const Eigen::Vector3d rate = at.mesh.node_rate(end.touch.strand, end.touch.position);
  row.dlambda = by_place.dot(rate.head<2>()) - end.sense * by_lambda / setting.scales.length;
  return row;
}

std::vector<Transition> StraightEndBound::transitions(const SlidingSetting&, const SlidingState&,
                                                      const Arrival&) const {
  return {unsupported("a member that rests on a wall along its whole length reached a bend or the end of the wall")};
}

}  // namespace arcwall::sliding
