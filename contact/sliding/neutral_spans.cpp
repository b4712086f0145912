#include "contact/sliding/neutral_spans.hpp"

#include <algorithm>
#include <cmath>

#include "contact/sliding/bending.hpp"
#include "contact/sliding/tolerances.hpp"

namespace arcwall::sliding {

namespace {

using NeutralSpan = SlidingContactLayout::NeutralSpan;
using Span = SlidingContactLayout::Span;

std::size_t obstacle_at(const SlidingState& at, Index point) {
  return at.layout.points()[static_cast<std::size_t>(point)].obstacle;
}

// The gap between the axis at a node and an obstacle.
NodeFunction axis_gap(const SlidingSetting& setting, const SlidingState& at, Index strand, Index position,
                      std::size_t obstacle) {
  return touch_gap(setting, {.strand = strand, .position = position, .obstacle = obstacle, .offset = 0.0}, at).gap;
}

// The same where the body lies on the obstacle.
double axis_gap_lying(const SlidingSetting& setting, std::size_t obstacle, Index strand) {
  return std::abs(setting.face_offset(obstacle, strand));
}

// ½ (f − g)
NodeFunction half_difference(const NodeFunction& f, const NodeFunction& g) {
  return {.value = 0.5 * (f.value - g.value),
          .gradient = 0.5 * (f.gradient - g.gradient),
          .hessian = 0.5 * (f.hessian - g.hessian),
          .rate = 0.5 * (f.rate - g.rate),
          .gradient_rate = 0.5 * (f.gradient_rate - g.gradient_rate)};
}

// Whether the axis at a node is parallel to the obstacle of a touch. One is straight wherever this is asked.
bool is_parallel(const SlidingState& at, const Touch& touch, double angle) {
  return std::abs(angle - touch.axis(at).angle) <= exactly_parallel;
}

double element_length(const SlidingState& at, Index strand, Index element) {
  return at.mesh.coordinate(strand, element + 1, at.now.s) - at.mesh.coordinate(strand, element, at.now.s);
}

// The greatest curvature of a strand, by the turn of its elements.
double greatest_curvature(const SlidingState& at, Index strand) {
  double greatest = 0.0;
  for (Index e = 0; e + 1 < at.mesh.nodes(strand); ++e) {
    const double turn = at.mesh.node(strand, e + 1, at.now).angle - at.mesh.node(strand, e, at.now).angle;
    greatest = std::max(greatest, std::abs(turn) / element_length(at, strand, e));
  }
  return greatest;
}

// Whether an end of a touch's strand is clamped, parallel to the obstacle there, and the body has no curvature at it.
bool is_straightened_end(const SlidingSetting& setting, const SlidingState& at, const Touch& touch, bool last) {
  constexpr double straight = 0.1;  // of the greatest curvature in the strand
  const Index strand = touch.strand, nodes = at.mesh.nodes(strand);
  const Index node = last ? nodes - 1 : 0, e = last ? nodes - 2 : 0;
  const NodeUnknowns unknowns = at.mesh.node_unknowns(strand, node);
  if (unknowns[1] >= 0 || unknowns[2] >= 0) return false;
  const NodeFunction gap = axis_gap(setting, at, strand, node, touch.obstacle);
  if (unknowns[0] >= 0 && (gap.gradient[0] != 0.0 || gap.gradient_rate[0] != 0.0)) return false;
  const auto angle = [&](double t) { return at.mesh.inside(strand, e, last ? 1.0 - t : t, at.now).angle; };
  if (!is_parallel(at, touch, angle(0.0))) return false;
  const double curvature = (4.0 * angle(0.5) - 3.0 * angle(0.0) - angle(1.0)) / element_length(at, strand, e);
  return std::abs(curvature) <= straight * greatest_curvature(at, strand);
}

}  // namespace

// Between two obstacles the middle is as far from one as from the other, what lies on them being so far, too.
NodeFunction off_halfway(const SlidingSetting& setting, const SlidingState& at, const NeutralSpan& span) {
  const std::size_t obstacle = at.layout.points()[span.end_point()].obstacle;
  const NodeFunction middle = axis_gap(setting, at, span.strand, span.middle, obstacle);
  NodeFunction off;
  double halfway = axis_gap_lying(setting, obstacle, span.strand);
  if (span.joins_points()) {
    const std::size_t other = obstacle_at(at, span.last_point);
    off = half_difference(middle, axis_gap(setting, at, span.strand, span.middle, other));
    halfway -= axis_gap_lying(setting, other, span.strand);
  } else {
    const NodeFunction end = axis_gap(setting, at, span.strand, span.end, obstacle);
    off = middle;
    off.rate -= 0.5 * end.rate;
    halfway += end.value;
  }
  off.value -= 0.5 * halfway;
  return off;
}

Across distance_across(const SlidingSetting& setting, const SlidingState& at, const NeutralSpan& span) {
  const std::size_t obstacle = at.layout.points()[span.end_point()].obstacle;
  const double lying = axis_gap_lying(setting, obstacle, span.strand);
  if (!span.joins_points()) {
    const NodeFunction end = axis_gap(setting, at, span.strand, span.end, obstacle);
    return {.value = end.value - lying, .rate = end.rate};
  }
  const std::size_t other = obstacle_at(at, span.last_point);
  const NodeFunction near = axis_gap(setting, at, span.strand, span.middle, obstacle),
                     far = axis_gap(setting, at, span.strand, span.middle, other);
  return {.value = near.value + far.value - lying - axis_gap_lying(setting, other, span.strand),
          .rate = near.rate + far.rate};
}

Row grown_apart_gradient(const SlidingState& at, const NeutralSpan& span) {
  Row row = at.no_slope();
  row.dx[at.index.coordinate(span.last_point + 1)] = 1.0;
  row.dx[at.index.coordinate(span.last_point)] = -1.0;
  row.dx[at.index.coordinate(span.first_point)] = -1.0;
  row.dx[at.index.coordinate(span.first_point - 1)] = 1.0;
  return row;
}

double grown_apart(const SlidingState& at, const NeutralSpan& span) {
  const Index first = span.first_point, last = span.last_point;
  const Vector grown = at.now.s - at.layout.origin();
  return (grown[last + 1] - grown[last]) - (grown[first] - grown[first - 1]);
}

bool NeutralSides::any() const {
  const auto holds = [](const std::vector<bool>& sides) {
    return std::find(sides.begin(), sides.end(), true) != sides.end();
  };
  return holds(before) || holds(behind);
}

Index NeutralSides::between_points(const SlidingContactLayout& on) const {
  const auto strand_of = [&](std::size_t k) { return on.mesh().breakpoint(static_cast<Index>(k)).first; };
  Index count = 0;
  for (std::size_t k = 0; k + 1 < behind.size(); ++k) count += behind[k] && strand_of(k) == strand_of(k + 1);
  return count;
}

namespace {

// Whether a point load of a strand lies between two places.
bool is_loaded(const SlidingSetting& setting, Index strand, double from, double to) {
  const std::vector<double>& loads = setting.body.point_loads(strand);
  return std::any_of(loads.begin(), loads.end(), [&](double place) { return from <= place && place <= to; });
}

}  // namespace

NeutralSides spans_made_neutral(const SlidingSetting& setting, const SlidingState& at,
                                const std::vector<std::size_t>& lines, double beside) {
  const auto& points = at.layout.points();
  const auto strand_of = [&](std::size_t k) { return at.mesh.breakpoint(static_cast<Index>(k)).first; };
  const auto is_line = [&](std::size_t k) {
    const bool lies = points[k].behind == Span::flat || at.layout.span_before(k) == Span::flat;
    return (lies || std::find(lines.begin(), lines.end(), k) != lines.end()) && lies_by_itself(setting, at, k);
  };
  NeutralSides sides{.before = std::vector<bool>(points.size()), .behind = std::vector<bool>(points.size())};
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!is_line(k)) continue;
    const Index strand = strand_of(k);
    const Touch touch = touch_of_contact(setting, at.layout, k);
    const double s = at.s(static_cast<Index>(k));
    const bool is_first = k == 0 || strand_of(k - 1) != strand;
    const bool is_last = k + 1 == points.size() || strand_of(k + 1) != strand;
    if (is_first && at.layout.span_before(k) == Span::free && !is_loaded(setting, strand, 0.0, s - beside))
      sides.before[k] = is_straightened_end(setting, at, touch, false);
    const double end = is_last ? setting.body.length(strand) : at.s(static_cast<Index>(k) + 1) - beside;
    if (points[k].behind != Span::free || is_loaded(setting, strand, s + beside, end)) continue;
    if (is_last)
      sides.behind[k] = is_straightened_end(setting, at, touch, true);
    else
      sides.behind[k] = is_line(k + 1) && points[k].obstacle != points[k + 1].obstacle &&
                        is_parallel(at, touch, touch_of_contact(setting, at.layout, k + 1).axis(at).angle);
  }
  return sides;
}

bool is_neutral_from_plane(const SlidingSetting& setting, const SlidingState& at, const FreeEnd& end, double beside) {
  const double L = setting.body.length(end.strand);
  if (at.layout.point_at_end(end.strand, end.last)) return false;
  if (is_loaded(setting, end.strand, end.last ? 0.0 : beside, end.last ? L - beside : L)) return false;
  return lies_by_itself(setting, at, held_axis_at_end(setting, at, end)) &&
         is_straightened_end(setting, at, touch_of_end(setting, at.layout, end), !end.last);
}

}  // namespace arcwall::sliding
