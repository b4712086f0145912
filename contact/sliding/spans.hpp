#pragma once

#include "contact/sliding/layout.hpp"

namespace arcwall::sliding {

/// Sizes of elements, relative to those asked for, at which a segment is meshed anew.
constexpr double coarsest = 1.25, finest = 0.25;

/// How many elements the mesh of a strand asks for between two places.
int elements_asked(const SlidingBody& body, Index strand, double from, double to, int fewest);

/// Length below which a part of the body between two contacts is none [length].
double shortest_span(const SlidingBody& body, Index strand);

/// The same of the span behind a tracked point.
double shortest_span(const SlidingBody& body, const SlidingContactLayout& on, std::size_t point);

}  // namespace arcwall::sliding
