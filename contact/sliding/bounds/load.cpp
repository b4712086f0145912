#include "contact/sliding/bounds/load.hpp"

#include <algorithm>
#include <cmath>

#include "contact/sliding/bounds/element_size.hpp"
#include "contact/sliding/lifting.hpp"
#include "contact/sliding/neutral_spans.hpp"
#include "contact/sliding/pressed_part.hpp"
#include "contact/sliding/remeshing.hpp"
#include "contact/sliding/spans.hpp"
#include "contact/sliding/tolerances.hpp"

namespace arcwall::sliding {

namespace {

double place_of(const SlidingSetting& setting, Index strand, Index load) {
  return setting.body.point_loads(strand)[static_cast<std::size_t>(load)];
}

// Elements between a load and a point.
double apart(const SlidingSetting& setting, const SlidingState& at, Index strand, Index load, Index point) {
  const double a = place_of(setting, strand, load), b = at.s(point);
  return setting.body.elements_between(strand, std::min(a, b), std::max(a, b));
}

// Elements per length at a point.
double density(const SlidingSetting& setting, const SlidingState& at, Index point) {
  const Index strand = at.mesh.breakpoint(point).first;
  const double step = difference_step_at_place * setting.body.length(strand), S = at.s(point);
  return setting.body.elements_between(strand, S - step, S + step) / (2.0 * step);
}

// `factor` times the derivative of the elements between a load and a point.
Row apart_gradient(const SlidingSetting& setting, const SlidingState& at, Index strand, Index load, Index point,
                   double factor) {
  const double away = at.s(point) - place_of(setting, strand, load);
  Row row = at.no_slope();
  row.dx[at.index.coordinate(point)] = factor * std::copysign(density(setting, at, point), away);
  return row;
}

// The point of the strand nearest a load; −1 where there is none.
Index nearest_point(const SlidingSetting& setting, const SlidingState& at, Index strand, Index load) {
  Index nearest = -1;
  for (Index k = 0; k < at.index.points; ++k)
    if (at.mesh.breakpoint(k).first == strand &&
        (nearest < 0 || apart(setting, at, strand, load, k) < apart(setting, at, strand, load, nearest)))
      nearest = k;
  return nearest;
}

}  // namespace

double LoadAheadBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  return elements_wanted(setting, at, segment_) - nearest_node_of_load;
}

Row LoadAheadBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  return elements_wanted_gradient(setting, at, segment_, 1.0);
}

std::vector<Transition> LoadAheadBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                                    const Arrival& arrival) const {
  return {divided_evenly(setting, at, arrival.forward)};
}

double LoadBehindBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  const Index nearest = nearest_point(setting, at, strand_, load_);
  return nearest < 0 ? no_guard : farthest_load_inside - apart(setting, at, strand_, load_, nearest);
}

Row LoadBehindBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  const Index nearest = nearest_point(setting, at, strand_, load_);
  return nearest < 0 ? at.no_slope() : apart_gradient(setting, at, strand_, load_, nearest, -1.0);
}

BoundPlace LoadBehindBound::place(const SlidingSetting& setting, const SlidingState&) const {
  return {.at = {.strand = strand_, .s = setting.body.point_loads(strand_)[static_cast<std::size_t>(load_)]}};
}

std::vector<Transition> LoadBehindBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                                     const Arrival& arrival) const {
  return {divided_evenly(setting, at, arrival.forward)};
}

namespace {

// The end of a part that is nearest a load, and the direction in which it must move to leave the load outside.
struct NearestEnd {
  Index point;
  double outwards;
};

NearestEnd nearest_end(const SlidingState& at, const SlidingContactLayout::Segment& part, double load) {
  const Index first = part.first_point, last = part.last_point;
  if (first < 0) return {.point = last, .outwards = -1.0};
  if (last < 0) return {.point = first, .outwards = 1.0};
  return at.s(first) - load > load - at.s(last) ? NearestEnd{.point = first, .outwards = 1.0}
                                                : NearestEnd{.point = last, .outwards = -1.0};
}

// How far outside a part a load is, in elements, and the derivative.
double outside(const SlidingSetting& setting, const SlidingState& at, const PartLoad& load) {
  const SlidingContactLayout::Segment& part = at.layout.segments()[load.segment];
  const double place = place_of(setting, load);
  const auto [end, outwards] = nearest_end(at, part, place);
  return std::copysign(apart(setting, at, part.strand, load.load, end), outwards * (at.s(end) - place));
}

Row outside_gradient(const SlidingSetting& setting, const SlidingState& at, const PartLoad& load, double factor) {
  const SlidingContactLayout::Segment& part = at.layout.segments()[load.segment];
  const auto [end, outwards] = nearest_end(at, part, place_of(setting, load));
  Row row = at.no_slope();
  row.dx[at.index.coordinate(end)] = factor * outwards * density(setting, at, end);
  return row;
}

// A flat part becomes a pressed one, which hands loads on.
void press(const SlidingContactLayout::Segment& part, LayoutEdit& edit) {
  using Span = SlidingContactLayout::Span;
  if (part.span == Span::pressed) return;
  const std::size_t point = part.end_point();
  (part.first_point >= 0 ? edit.points[point].behind : edit.points[point].before) = Span::pressed;
  int& elements = part.first_point >= 0 ? edit.elements_behind(point) : edit.elements_before(point);
  elements = std::max(elements, fewest_pressed(true));
}

// The spans beside a part are neutral where no load acts on them any more.
void make_neutral_beside(const SlidingSetting& setting, const SlidingState& at,
                         const SlidingContactLayout::Segment& part, LayoutEdit& edit) {
  std::vector<std::size_t> ends;
  for (const Index point : {part.first_point, part.last_point})
    if (point >= 0) ends.push_back(static_cast<std::size_t>(point));
  const NeutralSides neutral = spans_made_neutral(setting, at, ends, shortest_span(setting.body, part.strand));
  for (std::size_t k = 0; k < edit.points.size(); ++k) {
    if (neutral.before[k]) edit.points[k].neutral_before = true;
    if (neutral.behind[k]) edit.points[k].neutral_behind = true;
  }
}

// The load of a part acts on the span beside it: that is neutral no longer.
void make_loaded_beside(const SlidingState& at, const SlidingContactLayout::Segment& part, double load,
                        LayoutEdit& edit) {
  const bool before = nearest_end(at, part, load).point == part.first_point;
  const auto end = static_cast<std::size_t>(before ? part.first_point : part.last_point);
  if (!before)
    edit.points[end].neutral_behind = false;
  else if (end > 0 && edit.strands[end - 1] == edit.strands[end])
    edit.points[end - 1].neutral_behind = false;
  else
    edit.points[end].neutral_before = false;
}

// The same state, in which a part hands a load on or does not.
Transition handed_on(const SlidingSetting& setting, const SlidingState& at, const Direction& forward,
                     const PartLoad& load, bool is_handed_on) {
  const SlidingContactLayout::Segment& part = at.layout.segments()[load.segment];
  return remeshed(setting, at, forward, [&](LayoutEdit& edit, const SlidingState&) {
    edit.handed_on[static_cast<std::size_t>(load.strand)][static_cast<std::size_t>(load.load)] = is_handed_on;
    if (is_handed_on) {
      press(part, edit);
      make_neutral_beside(setting, at, part, edit);
    } else {
      make_loaded_beside(at, part, place_of(setting, load), edit);
    }
  });
}

// A load of zero does not pull.
double scaled_push(const SlidingSetting& setting, const SlidingState& at, const PartLoad& load) {
  return push(setting, at, load) / setting.scales.force + zero_force;
}

}  // namespace

double LoadBesidePartBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  return outside(setting, at, load_);
}

Row LoadBesidePartBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  return outside_gradient(setting, at, load_, 1.0);
}

std::vector<Transition> LoadBesidePartBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                                         const Arrival& arrival) const {
  if (scaled_push(setting, at, load_) < 0.0)
    return {unsupported("a contact zone reached a point load that pulls the member off the wall")};
  return {handed_on(setting, at, arrival.forward, load_, true)};
}

double LoadInPartBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  return edge_behind_load - outside(setting, at, load_);
}

Row LoadInPartBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  return outside_gradient(setting, at, load_, -1.0);
}

std::vector<Transition> LoadInPartBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                                     const Arrival& arrival) const {
  return {handed_on(setting, at, arrival.forward, load_, false)};
}

double LoadPressesBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  return scaled_push(setting, at, load_);
}

Row LoadPressesBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  Row row = push_gradient(setting, at, load_);
  row.dx /= setting.scales.force;
  row.dlambda /= setting.scales.force;
  return row;
}

std::vector<Transition> LoadPressesBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                                      const Arrival& arrival) const {
  return load_lifts_off(setting, at, load_, arrival);
}

}  // namespace arcwall::sliding
