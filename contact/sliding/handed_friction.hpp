#pragma once

#include "contact/sliding/layout_edit.hpp"
#include "contact/sliding/setting.hpp"

namespace arcwall::sliding {

/// What friction does at a contact that a change of the layout moves along its strand, divides or merges.
struct HandedFriction {
  SlidingContactLayout::Rubbing rubbing{};
  double force = 0.0;  ///< T, all of it [force]
  double held = 0.0;   ///< the place on the obstacle that holds it [length]

  /// To a point, or to an end, which takes a part of the force.
  void give_to_point(std::size_t point, double part, LayoutEdit& edit) const;
  void give_to_end(std::size_t end, double part, LayoutEdit& edit) const;
};

/// That of a contact of a state, as a point near by that has rolled there without slip: its anchor is where it was.
/// Without friction where the coefficients of an end and of its member differ.
HandedFriction friction_of_point_at(const SlidingSetting& setting, const SlidingState& at, std::size_t contact,
                                    double s);

/// That of a point that has rolled to an end.
HandedFriction friction_of_end(const SlidingSetting& setting, const SlidingState& at, std::size_t point,
                               const FreeEnd& end);

/// That of two contacts which have become one at a place, where it does this.
HandedFriction merged(const HandedFriction& one, const HandedFriction& other, ContactMode mode, double s);

}  // namespace arcwall::sliding
