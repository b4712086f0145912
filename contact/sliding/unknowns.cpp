#include "contact/sliding/unknowns.hpp"

#include <algorithm>

namespace arcwall {

SlidingUnknowns::SlidingUnknowns(const ActiveSet& active_set) : active_set_(&active_set) {
  const SlidingContactLayout& layout = sliding_layout(active_set);
  nodes = layout.mesh().unknowns();
  straights = layout.mesh().axial_forces();
  closed = active_set.closed_count();
  pressed = static_cast<Index>(layout.pressed_nodes().size());
  neutral = static_cast<Index>(layout.neutral_spans().size());
  pinched = static_cast<Index>(layout.pinched_points().size());
  tips = static_cast<Index>(layout.pressed_tips().size());
  points = static_cast<Index>(layout.points().size());
  for (std::size_t j = 0; j < active_set.contacts(); ++j) rubbing += rubs(active_set, j) ? 1 : 0;
}

std::optional<Index> SlidingUnknowns::rank(std::size_t contact) const {
  if (rubbing == 0 || !rubs(*active_set_, contact)) return std::nullopt;
  Index before = 0;
  for (std::size_t k = 0; k < contact; ++k) before += rubs(*active_set_, k) ? 1 : 0;
  return before;
}

std::optional<Index> SlidingUnknowns::friction(std::size_t contact) const {
  const auto k = rank(contact);
  return k ? std::optional(tip_moment(0) + tips + *k) : std::nullopt;
}

std::optional<Index> SlidingUnknowns::place(std::size_t contact) const {
  const auto k = rank(contact);
  return k ? std::optional(of_K() + *k) : std::nullopt;
}

Vector moved_unknowns(const Vector& x, const ActiveSet& from, const ActiveSet& to) {
  const SlidingUnknowns source(from), target(to);
  const Index between = source.pressed + source.neutral + source.pinched + source.tips;
  Vector moved = Vector::Zero(target.size());
  moved.head(target.nodes) = x.head(source.nodes);
  moved.segment(target.pressed_force(0), between) = x.segment(source.pressed_force(0), between);
  moved.segment(target.moment(0), target.points) = x.segment(source.moment(0), source.points);
  moved.tail(target.points) = x.tail(source.points);
  for (std::size_t j = 0; j < to.contacts(); ++j)
    if (from[j] && to[j]) moved[*target.force(j)] = x[*source.force(j)];
  if (source.rubbing == 0 || target.rubbing == 0) return moved;
  for (std::size_t k = 0; k < to.contacts(); ++k) {
    const auto T = target.friction(k), before = source.friction(k);
    if (!T || !before) continue;
    moved[*T] = x[*before];
    moved[*target.place(k)] = x[*source.place(k)];
  }
  return moved;
}

std::optional<Index> SlidingUnknowns::force(std::size_t contact) const {
  if (!(*active_set_)[contact]) return std::nullopt;
  const auto before = active_set_->begin() + static_cast<std::ptrdiff_t>(contact);
  return nodes + std::count(active_set_->begin(), before, std::uint8_t{1});
}

}  // namespace arcwall
