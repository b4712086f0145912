#include "contact/sliding/bounds/tail.hpp"

#include "contact/sliding/clamps.hpp"
#include "contact/sliding/placed_bound.hpp"
#include "contact/sliding/remeshing.hpp"
#include "contact/sliding/shrinking.hpp"
#include "contact/sliding/spans.hpp"
#include "contact/sliding/tips.hpp"
#include "contact/sliding/touch.hpp"

namespace arcwall::sliding {

using Span = SlidingContactLayout::Span;

double TailBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  const double s = at.s(static_cast<Index>(point_));
  const double length = last_ ? setting.body.length(strand_) - s : s;
  const double shortest = setting.body.is_on_plane(strand_, last_) ? shortest_span_at_plane(setting, at, point_, last_)
                                                                   : shortest_tail(setting.body, strand_);
  return (length - shortest) / setting.scales.length;
}

Row TailBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  Row row = at.no_slope();
  row.dx[at.index.coordinate(static_cast<Index>(point_))] = (last_ ? -1.0 : 1.0) / setting.scales.length;
  return row;
}

BoundPlace TailBound::place(const SlidingSetting&, const SlidingState& at) const { return place_of_point(at, point_); }

bool TailBound::gathers_at_support(const SlidingSetting& setting, const SlidingState& at) const {
  if (!setting.body.lets_contact_come(strand_, last_)) return true;
  if (is_at_plane(setting, at)) return at.is_closed(point_) && !closes_at_plane(setting, at);
  return setting.body.end_is_held(strand_, last_) && at.layout.span_at_end(strand_, last_) != Span::free;
}

bool TailBound::is_at_plane(const SlidingSetting& setting, const SlidingState& at) const {
  const std::size_t obstacle = at.layout.points()[point_].obstacle;
  return is_tangent_at_plane(setting, at, {.strand = strand_, .last = last_, .obstacle = obstacle});
}

bool TailBound::closes_at_plane(const SlidingSetting& setting, const SlidingState& at) const {
  const Span inner = last_ ? at.layout.span_before(point_) : at.layout.points()[point_].behind;
  return is_at_plane(setting, at) && at.layout.span_at_end(strand_, last_) == Span::free && inner == Span::pressed;
}

std::vector<Transition> TailBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                               const Arrival& arrival) const {
  if (gathers_at_support(setting, at)) return parts_gather_at_clamps(setting, at, arrival);
  if (at.is_closed(point_) && closes_at_plane(setting, at))
    return {zone_joins_at_plane(setting, at, point_, last_),
            unsupported("the free span at a plane of symmetry closes, but no equilibrium without it was found")};
  if (at.layout.points()[point_].is_pinched())
    return {unsupported("the end of a member slides out from between two walls")};
  if (!at.is_closed(point_)) return {without_point(setting, at, arrival.forward, point_)};
  return contacts_come_to_tips(setting, at, arrival);
}

}  // namespace arcwall::sliding
