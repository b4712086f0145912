#include "contact/sliding/bounds/free_end.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "contact/sliding/remeshing.hpp"
#include "contact/sliding/tips.hpp"
#include "contact/sliding/tolerances.hpp"
#include "contact/sliding/touch.hpp"

namespace arcwall::sliding {

namespace {

constexpr double nearly_upright = 0.02;  // cosine: beyond 0 the section's other corner touches, and nothing is smooth

// The contact of an end of a strand to which it is nearest to lying down, seen from that end.
std::optional<FreeEnd> touching_end(const SlidingSetting& setting, const SlidingState& at, const StrandEnd& of) {
  const auto nearest = end_nearest_to_lying_down(setting, at, of);
  if (!nearest) return std::nullopt;
  return setting.free_ends[*nearest].seen_from(of);
}

}  // namespace

double sine_from_end(const SlidingSetting& setting, const SlidingState& at, const FreeEnd& end) {
  return outward(setting.obstacles[end.obstacle].surface->side(), end.last) *
         std::sin(touch_gap(setting, touch_of_end(setting, at.layout, end), at).angle);
}

Row sine_from_end_gradient(const SlidingSetting& setting, const SlidingState& at, const FreeEnd& end) {
  const Touch touch = touch_of_end(setting, at.layout, end);
  const TouchGap gap = touch_gap(setting, touch, at);
  const double by_tilt = outward(setting.obstacles[end.obstacle].surface->side(), end.last) * std::cos(gap.angle);
  Row row = at.no_slope();
  add_at_node(at.mesh.node_unknowns(touch.strand, touch.position), by_tilt * gap.tilt.gradient, row.dx);
  row.dlambda = by_tilt * gap.tilt.rate;
  return row;
}

std::optional<std::size_t> end_nearest_to_lying_down(const SlidingSetting& setting, const SlidingState& at,
                                                     const StrandEnd& of) {
  if (at.layout.span_at_end(of.strand, of.last) != SlidingContactLayout::Span::free) return std::nullopt;
  const std::size_t points = at.layout.points().size();
  std::optional<std::size_t> nearest;
  double least = 0.0;
  for (std::size_t j = 0; j < setting.free_ends.size(); ++j) {
    if (!at.is_closed(points + j) || !setting.free_ends[j].is_of(of)) continue;
    if (is_tangent_at_plane(setting, at, setting.free_ends[j].seen_from(of))) continue;
    const double sine = sine_from_end(setting, at, setting.free_ends[j].seen_from(of));
    if (nearest && sine >= least) continue;
    nearest = j;
    least = sine;
  }
  return nearest;
}

// Of an end that does not touch, the gap is watched, too.
double LiesDownBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  const auto touching = touching_end(setting, at, end());
  return touching ? sine_from_end(setting, at, *touching) : no_guard_for_long;
}

Row LiesDownBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  const auto touching = touching_end(setting, at, end());
  return touching ? sine_from_end_gradient(setting, at, *touching) : at.no_slope();
}

std::vector<Transition> LiesDownBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                                   const Arrival& arrival) const {
  return tips_lie_down(setting, at, arrival);
}

double UprightBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  const auto touching = touching_end(setting, at, {.strand = strand_, .last = last_});
  if (!touching || touching->travel == 0.0 || !touching->joined.empty()) return no_guard;
  const Touch touch = touch_of_end(setting, at.layout, *touching);
  if (touch.offset == 0.0) return no_guard;
  return touching->travel * std::cos(touch.axis(at).angle) - nearly_upright;
}

Row UprightBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  Row row = at.no_slope();
  const auto touching = touching_end(setting, at, {.strand = strand_, .last = last_});
  if (!touching || !touching->joined.empty()) return row;
  const Touch touch = touch_of_end(setting, at.layout, *touching);
  if (touch.offset == 0.0) return row;
  const double turned = -touching->travel * std::sin(touch.axis(at).angle);
  add_at_node(at.mesh.node_unknowns(touch.strand, touch.position), {0.0, 0.0, turned}, row.dx);
  row.dlambda = turned * at.mesh.node_rate(touch.strand, touch.position)[2];
  return row;
}

std::vector<Transition> UprightBound::transitions(const SlidingSetting&, const SlidingState&, const Arrival&) const {
  return {unsupported(
      "the free end of a member is perpendicular to the wall: the other corner of its section would touch")};
}

}  // namespace arcwall::sliding
