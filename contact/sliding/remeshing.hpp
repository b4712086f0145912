#pragma once

#include <functional>
#include <memory>

#include "contact/sliding/layout_edit.hpp"
#include "contact/sliding/setting.hpp"
#include "core/transition.hpp"

namespace arcwall::sliding {

/// The state on an edited layout: its shape interpolated, the forces of its points and free ends those of the edit,
/// moments and forces of pressed nodes zero. `on` is layout_of(edit).
State mapped_onto(const SlidingSetting& setting, const SlidingState& at, const LayoutEdit& edit,
                  const std::shared_ptr<const SlidingContactLayout>& on);

/// The same, with the layout of the edit, made when it is asked for: `setting` must outlive it.
Deferred<State> mapped_when_tried(const SlidingSetting& setting, const SlidingState& at, LayoutEdit edit);

/// The same point of a path on an edited layout, entered in the plane across the path's direction `forward`. The edit
/// is asked for the point itself and for a state a little way on, so that what it takes from the state moves along.
using EditLayout = std::function<void(LayoutEdit&, const SlidingState&)>;
Transition remeshed(const SlidingSetting& setting, const SlidingState& at, const Direction& forward,
                    const EditLayout& edit);

/// That with parts of about one length divided alike, and loads settled. See divide_evenly(), which the next two do as
/// well.
Transition divided_evenly(const SlidingSetting& setting, const SlidingState& at, const Direction& forward);

/// That with the parts beside points that wait for their first touch divided anew, and no others.
Transition divided_beside_waiting(const SlidingSetting& setting, const SlidingState& at, const Direction& forward);

/// That with another number of elements in one segment.
Transition with_elements(const SlidingSetting& setting, const SlidingState& at, const Direction& forward,
                         std::size_t segment, int elements);

/// That without a tracked point: where another is left beside them its elements stay.
Transition without_point(const SlidingSetting& setting, const SlidingState& at, const Direction& forward,
                         std::size_t point);

/// Without the open points, which bear nothing, but for the one that touches; empty if there are no others.
std::optional<Transition> without_open_points(const SlidingSetting& setting, const SlidingState& at,
                                              const Direction& forward, std::optional<Index> touching);

/// A transition whose first point is where the quantity has the value.
Transition up_to(double value, std::shared_ptr<const Observable> quantity, Transition::Change change,
                 Deferred<State> guess);

/// A transition to what is not modelled, or was not found.
Transition unsupported(std::string what);

/// The layout of so many elements and these points that began at these places; null if they do not belong together.
std::shared_ptr<const SlidingContactLayout> checked_layout(const SlidingSetting& setting,
                                                           const ElementsPerSegment& elements,
                                                           std::vector<SlidingContactLayout::Point> points,
                                                           const Vector& origin, SlidingContactLayout::Lying lying,
                                                           SlidingContactLayout::EndRubbings ends);

/// The active set with another layout, whose contacts have the same status.
ActiveSet with_layout(const ActiveSet& active_set, std::shared_ptr<const SlidingContactLayout> on);

/// The active set in which flat parts that the state bends are free: see System::canonical_active_set.
ActiveSet canonical_active_set(const SlidingSetting& setting, const SlidingState& at);

}  // namespace arcwall::sliding
