#pragma once

#include <vector>

#include "contact/contact_point.hpp"
#include "contact/sliding/setting.hpp"
#include "contact/sliding/unknowns.hpp"

namespace arcwall::sliding {

/// See ContactQuery.
ContactPoint contact_point(const SlidingSetting& setting, const SlidingState& at, std::size_t j);
std::vector<ContactPoint> closed_contacts(const SlidingSetting& setting, const SlidingState& at);

/// The tributary of a pressed node is half the way to the nodes beside it.
std::vector<ContactPoint> pressed_nodes(const SlidingSetting& setting, const SlidingState& at);

}  // namespace arcwall::sliding
