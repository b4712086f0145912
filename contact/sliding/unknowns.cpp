#include "contact/sliding/unknowns.hpp"

#include <algorithm>

namespace arcwall {

SlidingUnknowns::SlidingUnknowns(const ActiveSet& active_set) : active_set_(&active_set) {
  const SlidingContactLayout& layout = sliding_layout(active_set);
  nodes = layout.mesh().unknowns();
  closed = active_set.closed_count();
  pressed = static_cast<Index>(layout.pressed_nodes().size());
  neutral = static_cast<Index>(layout.neutral_spans().size());
  pinched = static_cast<Index>(layout.pinched_points().size());
  tips = static_cast<Index>(layout.pressed_tips().size());
  points = static_cast<Index>(layout.points().size());
}

std::optional<Index> SlidingUnknowns::force(std::size_t contact) const {
  if (!(*active_set_)[contact]) return std::nullopt;
  const auto before = active_set_->begin() + static_cast<std::ptrdiff_t>(contact);
  return nodes + std::count(active_set_->begin(), before, std::uint8_t{1});
}

}  // namespace arcwall
