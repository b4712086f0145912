#pragma once

#include "contact/sliding/setting.hpp"
#include "contact/sliding/unknowns.hpp"

namespace arcwall::sliding {

/// A point load of a strand, and a part of that which is pressed on an obstacle.
struct PartLoad {
  Index strand, load;   ///< by SlidingBody::point_loads
  std::size_t segment;  ///< the part
};

/// The obstacle that a part lies on.
std::size_t obstacle_of_part(const SlidingState& at, std::size_t segment);

/// Where it acts along its strand [length].
double place_of(const SlidingSetting& setting, const PartLoad& load);

/// With how much force it presses the part on its obstacle; < 0 where it pulls it off.
double push(const SlidingSetting& setting, const SlidingState& at, const PartLoad& load);

/// Its derivatives by all unknowns and by λ.
Row push_gradient(const SlidingSetting& setting, const SlidingState& at, const PartLoad& load);

}  // namespace arcwall::sliding
