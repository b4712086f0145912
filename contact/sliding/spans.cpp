#include "contact/sliding/spans.hpp"

#include <algorithm>
#include <cmath>

namespace arcwall::sliding {

using Span = SlidingContactLayout::Span;

int elements_asked(const SlidingBody& body, Index strand, double from, double to, int fewest) {
  return std::max(fewest, static_cast<int>(std::lround(body.elements_between(strand, from, to))));
}

double shortest_span(const SlidingBody& body, Index strand) {
  const double L = body.length(strand);
  return std::max(0.125 * L / body.elements_between(strand, 0.0, L), 1e-3 * L);
}

double shortest_tail(const SlidingBody& body, Index strand) { return 1e-3 * body.length(strand); }

// Between two pressed parts the pressure that is left at the edges goes with the square of the span, and is lost in the
// error of the elements where these are much longer.
double shortest_span(const SlidingBody& body, const SlidingContactLayout& on, std::size_t point) {
  const bool between_parts = on.points()[point].behind == Span::free && on.span_before(point) == Span::pressed &&
                             on.points()[point + 1].behind == Span::pressed;
  const Index strand = on.mesh().breakpoint(static_cast<Index>(point)).first;
  return (between_parts ? 4.0 : 1.0) * shortest_span(body, strand);
}

}  // namespace arcwall::sliding
