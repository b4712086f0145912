#pragma once

#include <vector>

#include "contact/sliding/setting.hpp"
#include "contact/sliding/unknowns.hpp"

namespace arcwall::sliding {

/// An element of the body, by its first node, beside a surface that is curved or has ends.
struct ElementBesideSurface {
  const SlidingSetting& setting;
  const SlidingState& at;
  Index strand, node;
  std::size_t obstacle;
  double from, to;  ///< Obstacle::along() at its ends, the second of a closed surface where it follows the first
};

/// Such an element between the places of its face.
ElementBesideSurface beside_surface(const SlidingSetting& setting, const SlidingState& at, Index strand, Index node,
                                    std::size_t obstacle, const Vec2& first_face, const Vec2& last_face);

/// A place inside an element, and the gap there.
struct PlaceInElement {
  double fraction = 0.0;
  double gap = 0.0;  ///< [length]
};

/// Whether the surface has knots, faced by the inside of the element, because of which its nodes do not show where it
/// is: an end, a place where it is not smooth, or several.
bool faces_knots(const ElementBesideSurface& element);

/// Which parts of an element are left out: up to the first knot from an end that touches the surface.
struct TouchingEnds {
  bool first = false, last = false;
};

/// Where the element's face is parallel to the surface and nearer to it than beside. The element is cut where it faces
/// the surface's knots, so that no more than one such place lies between two cuts, however small the surface is.
std::vector<PlaceInElement> parallel_places(const ElementBesideSurface& element, TouchingEnds leave_out = {});

/// Where the face is inside the obstacle at an end of the surface, and deeper than beside: no tangency says so.
std::vector<PlaceInElement> places_entered_at_ends(const ElementBesideSurface& element);

/// The least gap at the knots that the element faces; infinite where there is none [length].
double least_gap_at_knots(const ElementBesideSurface& element);

}  // namespace arcwall::sliding
