#pragma once

#include "contact/sliding/layout.hpp"

namespace arcwall::sliding {

/// Sizes of elements, relative to those asked for, at which a segment is meshed anew.
constexpr double coarsest = 1.25, finest = 0.25;

/// Elements between a point load and the nearest tracked point: nearer than the first, the load has no node, and
/// farther than the second it has one.
constexpr double nearest_node_of_load = 0.5, farthest_load_inside = 0.75;

/// How many elements the mesh of a strand asks for between two places.
int elements_asked(const SlidingBody& body, Index strand, double from, double to, int fewest);

/// Length below which a part of the body between two contacts is none [length].
double shortest_span(const SlidingBody& body, Index strand);

/// The same of a part between a contact and a tip: the contact is at the tip.
double shortest_tail(const SlidingBody& body, Index strand);

/// The same of the span behind a tracked point.
double shortest_span(const SlidingBody& body, const SlidingContactLayout& on, std::size_t point);

}  // namespace arcwall::sliding
