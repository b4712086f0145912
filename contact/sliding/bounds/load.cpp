#include "contact/sliding/bounds/load.hpp"

#include <algorithm>
#include <cmath>

#include "contact/sliding/bounds/element_size.hpp"
#include "contact/sliding/remeshing.hpp"
#include "contact/sliding/spans.hpp"

namespace arcwall::sliding {

namespace {

constexpr double no_point_near = 1.0;  // of a load on whose strand there is none

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
  const double step = 1e-6 * setting.body.length(strand), S = at.s(point);
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

// Loads are settled wherever a layout is made anew.
std::vector<Transition> settled(const SlidingSetting& setting, const SlidingState& at, const Direction& forward) {
  return {remeshed(setting, at, forward, [](LayoutEdit&, const SlidingState&) {})};
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
  return settled(setting, at, arrival.forward);
}

double LoadBehindBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  const Index nearest = nearest_point(setting, at, strand_, load_);
  return nearest < 0 ? no_point_near : farthest_load_inside - apart(setting, at, strand_, load_, nearest);
}

Row LoadBehindBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  const Index nearest = nearest_point(setting, at, strand_, load_);
  return nearest < 0 ? at.no_slope() : apart_gradient(setting, at, strand_, load_, nearest, -1.0);
}

std::vector<Transition> LoadBehindBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                                     const Arrival& arrival) const {
  return settled(setting, at, arrival.forward);
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

}  // namespace

double LoadBesidePartBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  const SlidingContactLayout::Segment& part = at.layout.segments()[segment_];
  const double load = place_of(setting, part.strand, load_);
  const auto [end, outwards] = nearest_end(at, part, load);
  return std::copysign(apart(setting, at, part.strand, load_, end), outwards * (at.s(end) - load));
}

Row LoadBesidePartBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  const SlidingContactLayout::Segment& part = at.layout.segments()[segment_];
  const auto [end, outwards] = nearest_end(at, part, place_of(setting, part.strand, load_));
  Row row = at.no_slope();
  row.dx[at.index.coordinate(end)] = outwards * density(setting, at, end);
  return row;
}

std::vector<Transition> LoadBesidePartBound::transitions(const SlidingSetting&, const SlidingState&,
                                                         const Arrival&) const {
  return {unsupported("a part that lies on a wall reached a point load")};
}

}  // namespace arcwall::sliding
