#include "contact/sliding/bounds/element_size.hpp"

#include <algorithm>
#include <cmath>

#include "contact/sliding/remeshing.hpp"
#include "contact/sliding/spans.hpp"
#include "contact/sliding/tolerances.hpp"

namespace arcwall::sliding {

namespace {

int elements_of(const SlidingState& at, std::size_t segment) { return at.layout.segments()[segment].elements; }

// Whether a point at an end of a segment waits for its first touch.
bool ends_at_waiting(const SlidingState& at, std::size_t segment) {
  const auto waits = [&](Index point) {
    const auto k = static_cast<std::size_t>(point);
    return point >= 0 && at.layout.points()[k].waits() && !at.is_closed(k);
  };
  const SlidingContactLayout::Segment& part = at.layout.segments()[segment];
  return waits(part.first_point) || waits(part.last_point);
}

}  // namespace

double elements_wanted(const SlidingSetting& setting, const SlidingState& at, std::size_t segment) {
  const SlidingContactLayout::Segment& part = at.layout.segments()[segment];
  const auto [from, to] = at.layout.ends(setting.body, part, at.now.s);
  return setting.body.elements_between(part.strand, from, to);
}

Row elements_wanted_gradient(const SlidingSetting& setting, const SlidingState& at, std::size_t segment,
                             double factor) {
  const SlidingContactLayout::Segment& part = at.layout.segments()[segment];
  const auto [from, to] = at.layout.ends(setting.body, part, at.now.s);
  const double step = difference_step_at_place * setting.body.length(part.strand);
  const auto density = [&](double S) {
    return setting.body.elements_between(part.strand, S - step, S + step) / (2.0 * step) * factor;
  };
  Row row = at.no_slope();
  if (part.first_point >= 0) row.dx[at.index.coordinate(part.first_point)] = -density(from);
  if (part.last_point >= 0) row.dx[at.index.coordinate(part.last_point)] = density(to);
  return row;
}

double CoarseBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  return coarsest - elements_wanted(setting, at, segment_) / elements_of(at, segment_);
}

Row CoarseBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  return elements_wanted_gradient(setting, at, segment_, -1.0 / elements_of(at, segment_));
}

std::vector<Transition> CoarseBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                                 const Arrival& arrival) const {
  if (ends_at_waiting(at, segment_)) return {divided_beside_waiting(setting, at, arrival.forward)};
  return {with_elements(setting, at, arrival.forward, segment_, 2 * elements_of(at, segment_))};
}

bool FineBound::is_needed(const SlidingBody& body, const SlidingContactLayout& on,
                          const SlidingContactLayout::Segment& segment) {
  const auto [from, to] = on.ends(body, segment, on.origin());
  return segment.elements > 1 && body.elements_between(segment.strand, from, to) > 1.2 * finest * segment.elements;
}

double FineBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  return elements_wanted(setting, at, segment_) / elements_of(at, segment_) - finest;
}

Row FineBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  return elements_wanted_gradient(setting, at, segment_, 1.0 / elements_of(at, segment_));
}

std::vector<Transition> FineBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                               const Arrival& arrival) const {
  if (ends_at_waiting(at, segment_)) return {divided_beside_waiting(setting, at, arrival.forward)};
  return {with_elements(setting, at, arrival.forward, segment_, (elements_of(at, segment_) + 1) / 2)};
}

namespace {

// As a layout begins.
ComparedPart compared_at_first(const SlidingBody& body, const SlidingContactLayout& on, std::size_t segment) {
  const SlidingContactLayout::Segment& part = on.segments()[segment];
  const auto [from, to] = on.ends(body, part, on.origin());
  return {.span = part.span, .asked = body.elements_between(part.strand, from, to)};
}

}  // namespace

bool UnlikeBound::is_needed(const SlidingBody& body, const SlidingContactLayout& on, std::size_t longer,
                            std::size_t shorter) {
  if (on.segments()[longer].elements == on.segments()[shorter].elements) return false;
  const ComparedPart a = compared_at_first(body, on, longer), b = compared_at_first(body, on, shorter);
  return a.may_be_like(b) && a.asked > b.asked;
}

// Where contacts have changed they may be of about one length already.
UnlikeBound::UnlikeBound(const SlidingBody& body, const SlidingContactLayout& on, std::size_t longer,
                         std::size_t shorter)
    : longer_(longer),
      shorter_(shorter),
      ratio_(std::min(
          alike, std::sqrt(compared_at_first(body, on, longer).asked / compared_at_first(body, on, shorter).asked))) {}

double UnlikeBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  return (elements_wanted(setting, at, longer_) - ratio_ * elements_wanted(setting, at, shorter_)) /
         elements_of(at, longer_);
}

Row UnlikeBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  const double elements = elements_of(at, longer_);
  Row row = elements_wanted_gradient(setting, at, longer_, 1.0 / elements);
  row.dx += elements_wanted_gradient(setting, at, shorter_, -ratio_ / elements).dx;
  return row;
}

BoundPlace UnlikeBound::place(const SlidingSetting& setting, const SlidingState& at) const {
  return place_of_segment(setting, at, longer_);
}

std::vector<Transition> UnlikeBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                                 const Arrival& arrival) const {
  const bool waits = ends_at_waiting(at, longer_) || ends_at_waiting(at, shorter_);
  return {waits ? divided_beside_waiting(setting, at, arrival.forward) : divided_evenly(setting, at, arrival.forward)};
}

}  // namespace arcwall::sliding
