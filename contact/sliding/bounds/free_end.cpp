#include "contact/sliding/bounds/free_end.hpp"

#include <cmath>
#include <optional>

#include "contact/sliding/remeshing.hpp"
#include "contact/sliding/tips.hpp"
#include "contact/sliding/touch.hpp"

namespace arcwall::sliding {

namespace {

constexpr double out_of_reach = 1.0;     // value of the bounds of an end that does not touch
constexpr double nearly_upright = 0.02;  // cosine: beyond 0 the section's other corner touches, and nothing is smooth

// A free end that touches an obstacle.
struct TouchingEnd {
  const FreeEnd& end;
  Touch touch;
};

// The contact of an end of a strand that is closed, if one is and the body does not lie on the obstacle beside it.
std::optional<TouchingEnd> touching_end(const SlidingSetting& setting, const SlidingState& at, Index strand,
                                        bool last) {
  if (at.layout.span_at_end(strand, last) != SlidingContactLayout::Span::free) return std::nullopt;
  const std::size_t points = at.layout.points().size();
  for (std::size_t j = 0; j < setting.free_ends.size(); ++j) {
    const FreeEnd& end = setting.free_ends[j];
    if (!at.is_closed(points + j)) continue;
    Touch touch = touch_of_contact(setting, at.layout, points + j);
    if (end.strand == strand && end.last == last) return TouchingEnd{.end = end, .touch = touch};
    if (setting.body.same_end_before(strand, last) != std::pair(end.strand, end.last)) continue;
    touch.strand = strand;
    touch.position = FreeEnd{.strand = strand, .last = last}.position(at.mesh);
    return TouchingEnd{.end = end, .touch = touch};
  }
  return std::nullopt;
}

}  // namespace

double LiesDownBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  const auto touching = touching_end(setting, at, strand_, last_);
  if (!touching) return out_of_reach;
  return outward(setting.obstacles[touching->end.obstacle].surface->side(), last_) *
         std::sin(touch_gap(setting, touching->touch, at).angle);
}

Row LiesDownBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  Row row = at.no_slope();
  const auto touching = touching_end(setting, at, strand_, last_);
  if (!touching) return row;
  const TouchGap gap = touch_gap(setting, touching->touch, at);
  const double by_tilt =
      outward(setting.obstacles[touching->end.obstacle].surface->side(), last_) * std::cos(gap.angle);
  add_at_node(at.mesh.node_unknowns(touching->touch.strand, touching->touch.position), by_tilt * gap.tilt.gradient,
              row.dx);
  row.dlambda = by_tilt * gap.tilt.rate;
  return row;
}

std::vector<Transition> LiesDownBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                                   const Arrival& arrival) const {
  return tips_lie_down(setting, at, arrival.tolerance);
}

double UprightBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  const auto touching = touching_end(setting, at, strand_, last_);
  if (!touching || touching->touch.offset == 0.0 || touching->end.travel == 0.0) return out_of_reach;
  if (touching->end.strand != strand_) return out_of_reach;  // the bound of that strand says it
  return touching->end.travel * std::cos(touching->touch.axis(at).angle) - nearly_upright;
}

Row UprightBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  Row row = at.no_slope();
  const auto touching = touching_end(setting, at, strand_, last_);
  if (!touching || touching->touch.offset == 0.0 || touching->end.strand != strand_) return row;
  const double turned = -touching->end.travel * std::sin(touching->touch.axis(at).angle);
  add_at_node(at.mesh.node_unknowns(touching->touch.strand, touching->touch.position), {0.0, 0.0, turned}, row.dx);
  row.dlambda = turned * at.mesh.node_rate(touching->touch.strand, touching->touch.position)[2];
  return row;
}

std::vector<Transition> UprightBound::transitions(const SlidingSetting&, const SlidingState&, const Arrival&) const {
  return {unsupported("the free end of a member stands upright against a wall: its other corner would touch")};
}

}  // namespace arcwall::sliding
