#include "contact/sliding/bounds/neutral.hpp"

#include <array>

#include "contact/sliding/bending.hpp"
#include "contact/sliding/neutral_spans.hpp"
#include "contact/sliding/placed_bound.hpp"
#include "contact/sliding/remeshing.hpp"

namespace arcwall::sliding {

namespace {

using NeutralSpan = SlidingContactLayout::NeutralSpan;

constexpr double most_bent = 0.1;    // curvature at its ends, of the greatest inside
constexpr double most_force = 1e-6;  // that holds its middle, scaled

const NeutralSpan& span_of(const SlidingState& at, std::size_t number) { return at.layout.neutral_spans()[number]; }

// Where a span begins and ends.
std::pair<double, double> ends_of(const SlidingSetting& setting, const SlidingState& at, const NeutralSpan& span) {
  return {span.first_point >= 0 ? at.s(span.first_point) : 0.0,
          span.last_point >= 0 ? at.s(span.last_point) : setting.body.length(span.strand)};
}

}  // namespace

// Without moments at its ends a span of the length l is bent by h 2π/l² at most, h being the distance across.
double NeutralBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  const NeutralSpan& span = span_of(at, span_);
  const auto [from, to] = ends_of(setting, at, span);
  const double h = distance_across(setting, at, span).value, l = to - from;
  const double force = at.state.x[at.index.holding_force(span_)] / (most_force * setting.scales.force);
  double value = 1.0 - force * force;
  for (const Index k : {span.first_point, span.last_point}) {
    if (k < 0) continue;
    const double bent = curvature_gap(setting, at, static_cast<std::size_t>(k)) * l * l / (most_bent * 2.0 * pi * h);
    value -= bent * bent;
  }
  return value;
}

Row NeutralBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  const NeutralSpan& span = span_of(at, span_);
  const auto [from, to] = ends_of(setting, at, span);
  const Across h = distance_across(setting, at, span);
  const double l = to - from, scale = most_force * setting.scales.force, to_bent = l * l / (most_bent * 2.0 * pi);
  Row row = at.no_slope();
  const Index force = at.index.holding_force(span_);
  row.dx[force] = -2.0 * at.state.x[force] / (scale * scale);
  for (const Index k : {span.first_point, span.last_point}) {
    if (k < 0) continue;
    const CurvatureGap bend = curvature_gap_gradient(setting, at, static_cast<std::size_t>(k));
    const double bent = bend.value * to_bent / h.value;
    bend.add_to(row, -2.0 * bent * to_bent / h.value, at.index);
    const double by_length = -4.0 * bent * bent / l;
    if (span.first_point >= 0) row.dx[at.index.coordinate(span.first_point)] -= by_length;
    if (span.last_point >= 0) row.dx[at.index.coordinate(span.last_point)] += by_length;
    row.dlambda += 2.0 * bent * bent * h.rate / h.value;
  }
  return row;
}

BoundPlace NeutralBound::place(const SlidingSetting& setting, const SlidingState& at) const {
  const NeutralSpan& span = span_of(at, span_);
  if (span.first_point >= 0 || span.last_point >= 0) return place_of_point(at, span.end_point());
  return place_of_end(setting, at, {.strand = span.strand, .last = false});
}

std::vector<Transition> NeutralBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                                  const Arrival& arrival) const {
  const NeutralSpan span = span_of(at, span_);
  return {remeshed(setting, at, arrival.forward, [span](LayoutEdit& edit, const SlidingState&) {
    if (span.first_point >= 0)
      edit.points[static_cast<std::size_t>(span.first_point)].neutral_behind = false;
    else
      edit.points[static_cast<std::size_t>(span.last_point)].neutral_before = false;
  })};
}

}  // namespace arcwall::sliding
