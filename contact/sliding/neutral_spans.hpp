#pragma once

#include <vector>

#include "contact/sliding/touch.hpp"

/// Neutral spans: see SlidingContactLayout::NeutralSpan.
namespace arcwall::sliding {

/// By how much the axis in the middle of a neutral span is off halfway between its ends, across the wall, as a function
/// of the node there [length].
NodeFunction off_halfway(const SlidingSetting& setting, const SlidingState& at,
                         const SlidingContactLayout::NeutralSpan& span);

/// The distance across the wall between the ends of a neutral span, and its rate by λ [length].
struct Across {
  double value = 0.0, rate = 0.0;
};
Across distance_across(const SlidingSetting& setting, const SlidingState& at,
                       const SlidingContactLayout::NeutralSpan& span);

/// By how much more than the flat part before a loose span the one behind it has grown since the layout began, as a
/// function of the coordinates of the points at their ends [length].
Row grown_apart_gradient(const SlidingState& at, const SlidingContactLayout::NeutralSpan& span);
double grown_apart(const SlidingState& at, const SlidingContactLayout::NeutralSpan& span);

/// The same points of contact with the spans beside some of them neutral, one entry a point.
struct NeutralSides {
  std::vector<bool> before, behind;

  bool any() const;

  /// How many of the spans lie between two points.
  Index between_points(const SlidingContactLayout& on) const;
};

/// Which spans are neutral once all the points in `lines` are ends of parts that nothing but point loads inside them
/// presses, as the flat ones that the layout has are; loads up to `beside` away from them act on the parts. A clamped
/// end counts if it is parallel to the wall beside it and the body loses its curvature there with the points: by the
/// first integral of the elastica |M| is the same at all places without slope.
NeutralSides spans_made_neutral(const SlidingSetting& setting, const SlidingState& at,
                                const std::vector<std::size_t>& lines, double beside);

/// Whether the span between such a part that begins at a plane of symmetry and the other end of the strand, clamped, is
/// neutral, where the strand has no tracked point.
bool is_neutral_from_plane(const SlidingSetting& setting, const SlidingState& at, const FreeEnd& end, double beside);

}  // namespace arcwall::sliding
