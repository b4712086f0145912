#pragma once

#include "contact/sliding/bending.hpp"
#include "contact/sliding/setting.hpp"
#include "contact/sliding/unknowns.hpp"

namespace arcwall::sliding {

/// Sizes of elements, relative to those asked for, at which a segment is meshed anew.
constexpr double coarsest = 1.25, finest = 0.25;

/// Parts for which at least `shortest_alike` elements are asked for, and up to `alike` times as many in one as in the
/// other, get equally many: so the mesh of a symmetric body is symmetric.
constexpr double shortest_alike = 2.0, alike = 1.15;

/// A part of a strand with a contact at one of its ends, by how it runs and how many elements are asked for in it.
struct ComparedPart {
  SlidingContactLayout::Span span;
  double asked;

  bool may_be_like(const ComparedPart& other) const;
};

/// Elements between a point load and the nearest tracked point: nearer than the first, the load has no node, and
/// farther than the second it has one.
constexpr double nearest_node_of_load = 0.5, farthest_load_inside = 0.75;

/// Elements by which the edge of a part that hands a load on may have come back over it, so that round-off of the edge
/// does not change what the load acts on.
constexpr double edge_behind_load = 1e-3;

/// How many elements the mesh of a strand asks for between two places.
int elements_asked(const SlidingBody& body, Index strand, double from, double to, int fewest);

/// The fewest elements between two places of a strand that are not too long.
int fewest_elements(const SlidingBody& body, Index strand, double from, double to);

/// Length below which a part of the body between two contacts is none [length]. Zones and spans begin with twice this,
/// or more.
double shortest_span(const SlidingBody& body, Index strand);

/// The same of parts that are pressed on a straight obstacle and of arches between them and a point: their ends do not
/// depend on the mesh.
double shortest_span_on_straight(const SlidingBody& body, Index strand);

/// The same of a free stretch between two parts that are pressed on a straight obstacle: round-off of places hides
/// shorter ones.
double shortest_gap_on_straight(const SlidingBody& body, Index strand);

/// The length of such an arch, `ahead` of a place along the body, below which round-off hides what it does:
/// where the part ends, the pressure grows at a rate p̄′, and the force there is p̄′ d²/20.
double shortest_sure_arch(const SlidingSetting& setting, const HeldAxis& held, double ahead);

/// The same of a part between a contact and an end of the strand: the contact is at the end. A load there may press a
/// contact as near to it as it is large.
double shortest_tail(const SlidingBody& body, Index strand);

/// The same of the span behind a tracked point; 0 of one without elements.
double shortest_span(const SlidingSetting& setting, const SlidingState& at, std::size_t point);

/// The same of the half span between a tracked point and the plane of symmetry at an end of its strand.
double shortest_span_at_plane(const SlidingSetting& setting, const SlidingState& at, std::size_t point, bool last);

}  // namespace arcwall::sliding
