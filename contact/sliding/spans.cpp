#include "contact/sliding/spans.hpp"

#include <algorithm>
#include <cmath>

#include "contact/sliding/bending.hpp"

namespace arcwall::sliding {

using Span = SlidingContactLayout::Span;

int elements_asked(const SlidingBody& body, Index strand, double from, double to, int fewest) {
  return std::max(fewest, static_cast<int>(std::lround(body.elements_between(strand, from, to))));
}

int fewest_elements(const SlidingBody& body, Index strand, double from, double to) {
  return static_cast<int>(std::ceil(body.elements_between(strand, from, to) / coarsest));
}

// Flat parts have elements of their own, and in short parts the error of the mesh is small.
bool ComparedPart::may_be_like(const ComparedPart& other) const {
  return span == other.span && span != Span::flat && std::min(asked, other.asked) >= shortest_alike;
}

// EI g = p̄″ (¼ d² − S²)³/720 is 10⁻¹⁴ of L at this length where a hump of 10⁻³ L is pressed flat.
double shortest_gap_on_straight(const SlidingBody& body, Index strand) { return 0.04 * body.length(strand); }

double shortest_span_on_straight(const SlidingBody& body, Index strand) { return 1e-3 * body.length(strand); }

// The nodes of the arch's two elements are known to some ε L, their forces to EI/(d/2)³ times that; a tenth of p̄′
// d²/20.
double shortest_sure_arch(const SlidingSetting& setting, const HeldAxis& held, double ahead) {
  constexpr double roundoff = 1e-12, longest = 0.02;
  const Index strand = held.touch.strand;
  const double L = setting.body.length(strand);
  const double slope = std::abs(required_pressure_slope_on_straight_wall(setting, held, ahead));
  const double lost = std::pow(roundoff * setting.body.bending_stiffness({strand, held.s}) * L / slope, 0.2);
  return std::clamp(lost, shortest_span_on_straight(setting.body, strand), longest * L);
}

double shortest_span(const SlidingBody& body, Index strand) {
  const double L = body.length(strand);
  return std::max(0.125 * L / body.elements_between(strand, 0.0, L), shortest_span_on_straight(body, strand));
}

double shortest_tail(const SlidingBody& body, Index strand) { return 1e-3 * body.length(strand); }

namespace {

// Between a pressed part and a touch the touch's force vanishes with the pressure at the edge, and the equations tell
// the span by the product of that and its cube; but an arch over a point of a spline may be shorter.
//
// Between two pressed parts the force that is left at the edges goes with the cube of the span, and is lost in the
// error of the elements where these are much longer.
double shortest_of_kind(const SlidingSetting& setting, const SlidingState& at, std::size_t point, Span span,
                        bool before, bool behind) {
  const SlidingContactLayout& on = at.layout;
  const Index strand = on.mesh().breakpoint(static_cast<Index>(point)).first;
  if (span == Span::free && before && behind)
    return obstacle_is_straight(setting, at, point)
               ? std::max(shortest_gap_on_straight(setting.body, strand), 4.0 * shortest_span(setting.body, strand))
               : 4.0 * shortest_span(setting.body, strand);
  const bool is_pressed = span == Span::pressed || (span == Span::free && (before || behind));
  if (is_pressed && obstacle_is_straight(setting, at, point)) return shortest_span_on_straight(setting.body, strand);
  if (span == Span::free && is_pressed) {
    const bool has_jumps = !setting.obstacles[on.points()[point].obstacle].surface->curvature_rate_jumps().empty();
    return std::max(shortest_span(setting.body, strand),
                    (has_jumps ? 3.0 : 12.0) * shortest_span_on_straight(setting.body, strand));
  }
  return shortest_span(setting.body, strand);
}

}  // namespace

double shortest_span(const SlidingSetting& setting, const SlidingState& at, std::size_t point) {
  const SlidingContactLayout& on = at.layout;
  const auto [strand, position] = at.mesh.breakpoint(static_cast<Index>(point));
  if (at.mesh.axial_force(strand, position)) return 0.0;
  const bool before = on.span_before(point) == Span::pressed, behind = on.points()[point + 1].behind == Span::pressed;
  return shortest_of_kind(setting, at, point, on.points()[point].behind, before, behind);
}

double shortest_span_at_plane(const SlidingSetting& setting, const SlidingState& at, std::size_t point, bool last) {
  const Span inner = last ? at.layout.span_before(point) : at.layout.points()[point].behind;
  const Span span = last ? at.layout.points()[point].behind : at.layout.span_before(point);
  return shortest_of_kind(setting, at, point, span, inner == Span::pressed, inner == Span::pressed);
}

}  // namespace arcwall::sliding
