#include "contact/sliding/unknowns.hpp"

#include <algorithm>

namespace arcwall {

SlidingUnknowns::SlidingUnknowns(const Piece& piece) : piece_(&piece) {
  const SlidingContactLayout& layout = sliding_layout(piece);
  nodes = layout.mesh().unknowns();
  closed = piece.closed_count();
  pressed = static_cast<Index>(layout.pressed_nodes().size());
  neutral = static_cast<Index>(layout.neutral_spans().size());
  pinched = static_cast<Index>(layout.pinched_points().size());
  tips = static_cast<Index>(layout.pressed_tips().size());
  points = static_cast<Index>(layout.points().size());
}

std::optional<Index> SlidingUnknowns::force(std::size_t contact) const {
  if (!(*piece_)[contact]) return std::nullopt;
  const auto before = piece_->begin() + static_cast<std::ptrdiff_t>(contact);
  return nodes + std::count(piece_->begin(), before, std::uint8_t{1});
}

}  // namespace arcwall
