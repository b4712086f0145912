#include "contact/sliding/lifting.hpp"

#include <algorithm>
#include <optional>

#include "contact/sliding/bounds/pressure.hpp"
#include "contact/sliding/pressed_part.hpp"
#include "contact/sliding/remeshing.hpp"
#include "contact/sliding/span_length.hpp"
#include "contact/sliding/spans.hpp"

namespace arcwall::sliding {

namespace {

using Nodes = std::vector<std::size_t>;
using Span = SlidingContactLayout::Span;

constexpr int fewest_pressed = 6;  // elements of a pressed part that lifts off inside

// Pressed nodes where a part lifts off: of neighbours the one with the least pressure.
Nodes lifting_nodes(const SlidingSetting& setting, const SlidingState& at, double tolerance) {
  const auto& pressed = at.layout.pressed_nodes();
  Nodes nodes;
  std::size_t last_reached = 0;
  for (const PressureBound* bound : reached<PressureBound>(setting, at, tolerance)) {
    const std::size_t node = bound->node();
    const bool neighbour =
        !nodes.empty() && pressed[node].segment == pressed[nodes.back()].segment && node - last_reached == 1;
    last_reached = node;
    if (!neighbour) {
      nodes.push_back(node);
    } else if (least_pressure(at, node).value < least_pressure(at, nodes.back()).value) {
      nodes.back() = node;
    }
  }
  return nodes;
}

// Splits the part of a pressed node by a free span where its pressure is least; tells the point behind which the span
// begins. Empty where the part is too short for that. Nodes are split from the last to the first.
std::optional<std::size_t> split(const SlidingSetting& setting, const SlidingState& at, std::size_t node, double length,
                                 LayoutEdit& edit) {
  const SlidingContactLayout::PressedNode& pressed = at.layout.pressed_nodes()[node];
  const SlidingContactLayout::Segment& part = at.layout.segments()[pressed.segment];
  if (part.first_point < 0 || part.last_point < 0) return std::nullopt;  // it reaches the end of its member
  const double place = least_pressure(at, node).s;
  const double begin = at.s(part.first_point), end = at.s(part.last_point), h = (end - begin) / part.elements;
  const bool at_first = place - begin < 0.5 * h, at_last = end - place < 0.5 * h;
  const double left = at_first ? begin : at_last ? end - length : place - 0.5 * length;
  const double next = edit.s[part.first_point + 1];  // up to where it has lifted before
  const double least_between = 8.0 * shortest_span(setting.body, pressed.strand);
  const bool fits = left >= begin && left + length <= next;
  if (!fits || (!at_first && !at_last && length < least_between)) return std::nullopt;

  const auto elements = [&](double from, double to, int fewest) {
    return elements_asked(setting.body, pressed.strand, from, to, fewest);
  };
  const int across = elements(left, left + length, 2), behind = elements(left + length, next, fewest_pressed);
  LayoutEdit::Entry edge{.point = {.obstacle = pressed.obstacle}, .strand = pressed.strand, .s = left, .closed = true};
  const std::size_t first = at_first
                                ? static_cast<std::size_t>(part.first_point)
                                : edit.insert(edge, elements(begin, left, fewest_pressed), at_last ? across : behind);
  edit.points[first].behind = Span::free;
  if (at_last) return first;
  edge.point.behind = Span::pressed;
  edge.s = left + length;
  edit.insert(edge, across, behind);
  return first;
}

// Parts with free spans of one length; empty where one of them is too short for its span.
std::optional<Transition> lifted(const SlidingSetting& setting, const SlidingState& at, const Nodes& nodes,
                                 double length) {
  LayoutEdit edit = edit_of(setting.body, at);
  std::size_t first = 0;  // the first of the new free spans begins behind this point
  for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) {
    const auto begins_behind = split(setting, at, *node, length, edit);
    if (!begins_behind) return std::nullopt;
    first = *begins_behind;
  }
  Transition transition = up_to(length, std::make_shared<SpanLength>(first), Transition::Change::splits,
                                mapped_onto(setting, at, edit, layout_of(edit)));
  for (std::size_t i = 0; i < at.layout.bounds().size(); ++i) {
    const auto* bound = dynamic_cast<const PressureBound*>(at.layout.bounds()[i].get());
    if (bound != nullptr && std::find(nodes.begin(), nodes.end(), bound->node()) != nodes.end())
      transition.contacts.push_back(static_cast<Index>(at.contacts() + i));
  }
  return transition;
}

}  // namespace

std::vector<Transition> parts_lift_off(const SlidingSetting& setting, const SlidingState& at, double tolerance) {
  const Nodes nodes = lifting_nodes(setting, at, tolerance);
  const double length = 2.0 * shortest_span(setting.body, at.layout.pressed_nodes()[nodes.front()].strand);
  std::vector<Transition> transitions;
  for (const double factor : {1.0, 2.0, 4.0, 8.0, 16.0})
    if (auto transition = lifted(setting, at, nodes, factor * length)) transitions.push_back(std::move(*transition));
  transitions.push_back(unsupported(
      "a part that is pressed on a wall lifts off inside, and no equilibrium with one free stretch was found"));
  return transitions;
}

}  // namespace arcwall::sliding
