#include "contact/sliding/lifting.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "contact/sliding/bending.hpp"
#include "contact/sliding/bounds/clamp.hpp"
#include "contact/sliding/bounds/load.hpp"
#include "contact/sliding/bounds/pressure.hpp"
#include "contact/sliding/bounds/pulling_jump.hpp"
#include "contact/sliding/bounds/tip_presses.hpp"
#include "contact/sliding/pressed_part.hpp"
#include "contact/sliding/pulling_jumps.hpp"
#include "contact/sliding/remeshing.hpp"
#include "contact/sliding/span_length.hpp"
#include "contact/sliding/spans.hpp"
#include "contact/sliding/tips.hpp"

namespace arcwall::sliding {

namespace {

using Nodes = std::vector<std::size_t>;
using Span = SlidingContactLayout::Span;

// Where a part lifts off.
struct LiftOff {
  std::size_t segment, obstacle;
  double place;
  bool on_straight;  // obstacle
  std::optional<PullingJump> jump{};
};
using LiftOffs = std::vector<LiftOff>;

LiftOff lift_off_at(const SlidingSetting& setting, const SlidingState& at, std::size_t node) {
  const SlidingContactLayout::PressedNode& pressed = at.layout.pressed_nodes()[node];
  return {.segment = pressed.segment,
          .obstacle = pressed.obstacle,
          .place = least_pressure(setting, at, node).s,
          .on_straight = lies_on_straight(setting, at, node)};
}

// Pressed nodes where parts lift off: of neighbours the one with the least pressure.
Nodes lifting_nodes(const SlidingSetting& setting, const SlidingState& at, const Arrival& arrival) {
  const auto& pressed = at.layout.pressed_nodes();
  Nodes nodes;
  std::size_t last_reached = 0;
  for (const PressureBound* bound : reached<PressureBound>(setting, at, arrival)) {
    const std::size_t node = bound->node();
    const bool neighbour =
        !nodes.empty() && pressed[node].segment == pressed[nodes.back()].segment && node - last_reached == 1;
    last_reached = node;
    if (!neighbour) {
      nodes.push_back(node);
    } else if (least_pressure(setting, at, node).value < least_pressure(setting, at, nodes.back()).value) {
      nodes.back() = node;
    }
  }
  return nodes;
}

// How far the point at the end of an arch over a jump is beyond that: (8.11a) for a short arch.
double beyond_jump(const PullingJump& jump, double length) {
  return std::sqrt(length * length * length / (12.0 * jump.held));
}

enum class Where { first_end, inside, last_end };

// On a curved obstacle the pressure is known between nodes no better than by them.
Where lifts_off_at(const SlidingSetting& setting, const SlidingState& at, const LiftOff& lift, double length) {
  const SlidingContactLayout::Segment& part = at.layout.segments()[lift.segment];
  const auto [begin, end] = at.layout.ends(setting.body, part, at.now.s);
  const double near = 0.5 * (lift.on_straight ? length : (end - begin) / part.elements);
  return lift.place - begin < near ? Where::first_end : end - lift.place < near ? Where::last_end : Where::inside;
}

// Whether a part reaches an end of its strand, and there a plane of symmetry: beyond it is the other half of the zone.
bool reaches_plane(const SlidingBody& body, const SlidingContactLayout::Segment& part, Where where) {
  const bool last = where == Where::last_end;
  return where != Where::inside && (last ? part.last_point : part.first_point) < 0 &&
         body.is_on_plane(part.strand, last);
}

// From where a part is free that begins here and has been split before, or its end.
double next_edge(const LayoutEdit& edit, Index strand, double begin, double end) {
  double next = end;
  for (std::size_t k = 0; k < edit.points.size(); ++k)
    if (const double s = edit.s[static_cast<Index>(k)]; edit.strands[k] == strand && s > begin)
      next = std::min(next, s);
  return next;
}

// Whether a part has a tracked point or a plane of symmetry at each of its ends.
bool reaches_points_or_planes(const SlidingBody& body, const SlidingContactLayout::Segment& part) {
  return (part.first_point >= 0 || body.is_on_plane(part.strand, false)) &&
         (part.last_point >= 0 || body.is_on_plane(part.strand, true));
}

// Lifts the part that reaches a plane of symmetry off there: half a free span up to a new edge, whose point it tells.
std::optional<std::size_t> split_at_plane(const SlidingSetting& setting, const SlidingState& at, const LiftOff& lift,
                                          double length, bool last, LayoutEdit& edit) {
  const SlidingContactLayout::Segment& part = at.layout.segments()[lift.segment];
  const auto [begin, end] = at.layout.ends(setting.body, part, at.now.s);
  if (length > 0.5 * (end - begin)) return std::nullopt;
  const double s = last ? end - length : begin + length;
  const auto contact = setting.number_of_end({.strand = part.strand, .last = last}, lift.obstacle).value();
  edit.ends_closed[contact] = 0;
  edit.set_lying(part.strand, std::nullopt);
  const auto elements = [&](double from, double to, int fewest) {
    return std::max(fewest, static_cast<int>(std::ceil(setting.body.elements_between(part.strand, from, to))));
  };
  const int free = elements(0.0, length, 1),
            rest = elements(0.0, end - begin - length, fewest_pressed(lift.on_straight));
  return edit.insert({.point = {.obstacle = lift.obstacle,
                                .behind = last ? Span::free : Span::pressed,
                                .before = last ? Span::pressed : Span::free},
                      .strand = part.strand,
                      .s = s,
                      .closed = true},
                     last ? rest : free, last ? free : rest);
}

// Splits a part by a free span where it lifts off; tells the point behind which the span begins. Empty where the part
// is too short for that. Parts are split from the last to the first.
std::optional<std::size_t> split(const SlidingSetting& setting, const SlidingState& at, const LiftOff& lift,
                                 double length, LayoutEdit& edit) {
  const SlidingContactLayout::Segment& part = at.layout.segments()[lift.segment];
  const Index strand = part.strand;
  const bool lies = !part.has_point();  // from end to end
  const auto [begin, end] = at.layout.ends(setting.body, part, at.now.s);
  const Where where = lifts_off_at(setting, at, lift, length);
  if (reaches_plane(setting.body, part, where))
    return split_at_plane(setting, at, lift, length, where == Where::last_end, edit);
  if (!lies && !reaches_points_or_planes(setting.body, part)) return std::nullopt;  // it reaches the end of its member
  const bool at_first = where == Where::first_end, at_last = where == Where::last_end;
  const double left = at_first ? begin : at_last ? end - length : lift.place - 0.5 * length;
  const double next = next_edge(edit, strand, begin, end);
  if (lies && where != Where::inside) return std::nullopt;
  const double least = where == Where::inside ? 8.0 * shortest_span(setting.body, strand) : 0.0;
  if (left < begin || left + length > next || length < least) return std::nullopt;
  const double over = lift.jump ? beyond_jump(*lift.jump, length) + lift.jump->distance.value : 0.0;

  const auto elements = [&](double from, double to, int fewest) {  // with room to grow before the part is meshed anew
    return std::max(fewest, static_cast<int>(std::ceil(setting.body.elements_between(strand, from, to))));
  };
  const int fewest = fewest_pressed(lift.on_straight);
  const int across = elements(left, left + length, 2), behind = elements(left + length, next, fewest);
  LayoutEdit::Entry edge{.point = {.obstacle = lift.obstacle}, .strand = strand, .s = left, .closed = true};
  if (part.first_point < 0) edge.point.before = Span::pressed;
  if (lies) {
    edit.set_lying(strand, std::nullopt);
  }
  const std::size_t first = at_first ? static_cast<std::size_t>(part.first_point)
                                     : edit.insert(edge, elements(begin, left, fewest), at_last ? across : behind);
  edit.points[first].behind = Span::free;
  if (at_last) {
    edit.place(first) += over;
    edit.place(first + 1) += over;
    return first;
  }
  edit.place(first) -= over;
  edge.point.behind = Span::pressed;
  edge.s = left + length - over;
  edit.insert(edge, across, behind);
  return first;
}

// The bounds of a kind that are wanted, by their numbers among the guards.
template <class Bound, class Wanted>
std::vector<Index> bounds_of(const SlidingState& at, const Wanted& wanted) {
  std::vector<Index> numbers;
  for (std::size_t i = 0; i < at.layout.bounds().size(); ++i) {
    const auto* bound = as<Bound>(*at.layout.bounds()[i]);
    if (bound != nullptr && wanted(*bound)) numbers.push_back(static_cast<Index>(at.contacts() + i));
  }
  return numbers;
}

// Parts with free spans of one length; empty where one of them is too short for its span.
std::optional<Transition> lifted(const SlidingSetting& setting, const SlidingState& at, const LiftOffs& lifts,
                                 double length) {
  LayoutEdit edit = edit_of(setting.body, at);
  std::size_t first = 0;  // the first of the new free spans begins behind this point
  for (auto lift = lifts.rbegin(); lift != lifts.rend(); ++lift) {
    const auto begins_behind = split(setting, at, *lift, length, edit);
    if (!begins_behind) return std::nullopt;
    first = *begins_behind;
  }
  const LiftOff& of_first = lifts.front();
  const SlidingContactLayout::Segment& part = at.layout.segments()[of_first.segment];
  const Where where = lifts_off_at(setting, at, of_first, length);
  std::shared_ptr<const Observable> of_one = std::make_shared<SpanLength>(first);
  if (reaches_plane(setting.body, part, where))
    of_one = std::make_shared<TailLength>(first, where == Where::last_end ? setting.body.length(part.strand) : 0.0);
  return up_to(length, std::move(of_one), Transition::Change::splits, mapped_when_tried(setting, at, edit));
}

// The lengths in which a free span inside a part is tried, from the shortest.
std::vector<double> lengths_inside(const SlidingBody& body, Index strand, bool on_straight) {
  const double shortest = shortest_span(body, strand);
  if (!on_straight) return {2.0 * shortest, 8.0 * shortest};
  return {std::max(1.25 * shortest_gap_on_straight(body, strand), 8.0 * shortest)};
}

Transition nothing_lifted() {
  return unsupported(
      "a contact zone separates from the wall in its interior, but no equilibrium with one free span was found");
}

// Parts with free spans in each of these lengths; `bounds`: what is told to open.
std::vector<Transition> lifted_inside(const SlidingSetting& setting, const SlidingState& at, const LiftOffs& lifts,
                                      const std::vector<Index>& bounds) {
  const Index strand = at.layout.segments()[lifts.front().segment].strand;
  std::vector<Transition> transitions;
  for (const double length : lengths_inside(setting.body, strand, lifts.front().on_straight))
    if (auto transition = lifted(setting, at, lifts, length)) {
      transition->contacts = bounds;
      transitions.push_back(std::move(*transition));
    }
  transitions.push_back(nothing_lifted());
  return transitions;
}

// Whether nothing presses on a strand that lies on its obstacle from end to end.
bool is_left(const SlidingSetting& setting, const SlidingState& at, Index strand, const Arrival& arrival) {
  if (!at.layout.lies_on(strand)) return false;
  const auto of_strand = [&](std::size_t node) { return at.layout.pressed_nodes()[node].strand == strand; };
  const auto all = reached<PressureBound>(setting, at, arrival);
  const auto& pressed = at.layout.pressed_nodes();
  return std::count_if(all.begin(), all.end(), [&](const PressureBound* bound) { return of_strand(bound->node()); }) ==
         std::count_if(pressed.begin(), pressed.end(), [&](const auto& node) { return node.strand == strand; });
}

// What is told of a strand that has left its obstacle: its ends.
void name_ends(const SlidingSetting& setting, const ActiveSet& ahead, Index strand, std::size_t obstacle,
               std::vector<Index>& contacts) {
  const SlidingContactLayout& on = sliding_layout(ahead);
  for (const bool last : {false, true}) {
    for (std::size_t j = 0; j < setting.free_ends.size(); ++j) {
      const FreeEnd& end = setting.free_ends[j];
      if (end.strand == strand && end.last == last && end.obstacle == obstacle)
        contacts.push_back(static_cast<Index>(on.points().size() + j));
    }
    for (std::size_t i = 0; i < on.bounds().size(); ++i) {
      const auto* held = as<ClampBound>(*on.bounds()[i]);
      if (held != nullptr && held->strand() == strand && held->last() == last)
        contacts.push_back(static_cast<Index>(ahead.size() + i));
    }
  }
}

}  // namespace

std::optional<Transition> strands_leave(const SlidingSetting& setting, const SlidingState& at, const Arrival& arrival) {
  std::vector<std::pair<Index, std::size_t>> leaving;
  for (Index strand = 0; strand < setting.body.strands(); ++strand)
    if (is_left(setting, at, strand, arrival)) leaving.emplace_back(strand, at.layout.lies_on(strand).value());
  if (leaving.empty()) return std::nullopt;
  LayoutEdit edit = edit_of(setting.body, at);
  for (const auto& [strand, obstacle] : leaving) {
    edit.set_lying(strand, std::nullopt);
    for (std::size_t j = 0; j < setting.free_ends.size(); ++j)
      if (setting.free_ends[j].strand == strand && setting.free_ends[j].obstacle == obstacle) edit.ends_closed[j] = 0;
  }
  Transition transition =
      up_to(0.0, nullptr, Transition::Change::splits, mapped_onto(setting, at, edit, layout_of(edit)));
  transition.forward = {.dx = Vector::Zero(transition.guess.get().x.size()), .dlambda = arrival.forward.dlambda};
  transition.forward.dx.head(at.index.nodes) = arrival.forward.dx.head(at.index.nodes);
  for (const auto& [strand, obstacle] : leaving)
    name_ends(setting, transition.guess.get().active_set, strand, obstacle, transition.contacts);
  return transition;
}

namespace {

// Parts between two points from which a load that λ drives lets go, from end to end, are free spans behind that: they
// arch off their walls as soon as these would have to pull. Empty where there are none.
std::optional<Transition> parts_leave(const SlidingSetting& setting, const SlidingState& at, const Arrival& arrival) {
  const auto all = reached<PressureBound>(setting, at, arrival);
  const auto& pressed = at.layout.pressed_nodes();
  std::vector<std::size_t> leaving;
  for (std::size_t i = 0; i < at.layout.segments().size(); ++i) {
    const SlidingContactLayout::Segment& part = at.layout.segments()[i];
    if (part.span != Span::pressed || part.first_point < 0 || part.last_point < 0) continue;
    if (required_pressure_rate_above_roundoff(setting, at, part.end_point()) == 0.0) continue;
    const auto of_part = [&](std::size_t node) { return pressed[node].segment == i; };
    if (std::count_if(all.begin(), all.end(), [&](const auto* bound) { return of_part(bound->node()); }) ==
        part.elements - 1)
      leaving.push_back(i);
  }
  if (leaving.empty()) return std::nullopt;
  Transition transition = remeshed(setting, at, arrival.forward, [&](LayoutEdit& edit, const SlidingState&) {
    for (const std::size_t i : leaving)
      edit.points[static_cast<std::size_t>(at.layout.segments()[i].first_point)].behind = Span::free;
  });
  transition.change = Transition::Change::splits;
  for (const std::size_t i : leaving)
    for (const Index point : {at.layout.segments()[i].first_point, at.layout.segments()[i].last_point})
      transition.contacts.push_back(point);
  return transition;
}

}  // namespace

std::vector<Transition> parts_lift_off(const SlidingSetting& setting, const SlidingState& at, const Arrival& arrival) {
  const Nodes nodes = lifting_nodes(setting, at, arrival);
  if (auto leave = strands_leave(setting, at, arrival))
    return {std::move(*leave),
            unsupported("a member separates from its wall along its whole length, but no equilibrium was found")};
  std::vector<Transition> transitions;
  if (auto leave = parts_leave(setting, at, arrival)) transitions.push_back(std::move(*leave));
  LiftOffs lifts;
  for (const std::size_t node : nodes) lifts.push_back(lift_off_at(setting, at, node));
  const auto is_one_of_them = [&](const PressureBound& bound) {
    return std::find(nodes.begin(), nodes.end(), bound.node()) != nodes.end();
  };
  const std::vector<Index> bounds = bounds_of<PressureBound>(at, is_one_of_them);
  const SlidingContactLayout::Segment& part = at.layout.segments()[lifts.front().segment];
  const double shortest = shortest_span_on_straight(setting.body, part.strand);
  const bool at_ends_on_straight = std::all_of(lifts.begin(), lifts.end(), [&](const LiftOff& lift) {
    const Where where = lifts_off_at(setting, at, lift, shortest);
    const bool at_plane = reaches_plane(setting.body, at.layout.segments()[lift.segment], where);
    return lift.on_straight && where != Where::inside && !at_plane;
  });
  const auto try_length = [&](double length, double least) {
    auto transition = lifted(setting, at, lifts, length);
    if (!transition) return;
    transition->least = least;
    transition->contacts = bounds;
    transitions.push_back(std::move(*transition));
  };
  if (at_ends_on_straight) {
    const HeldAxis held = held_axis(setting, at, part);
    const double sure = shortest_sure_arch(setting, held, lifts.front().place - held.s);
    for (const double factor : {2.0, 4.0, 1.0, 0.5})
      if (factor * sure > shortest) try_length(factor * sure, sure);
  } else {
    for (const double length : lengths_inside(setting.body, part.strand, lifts.front().on_straight))
      try_length(length, 0.0);
  }
  transitions.push_back(nothing_lifted());
  return transitions;
}

namespace {

// The bound of the pressed node that is nearest to a place of a part, by CurvePressure.
const PressureBound& pressure_bound_at(const SlidingState& at, std::size_t segment, double place) {
  const auto& pressed = at.layout.pressed_nodes();
  const PressureBound* nearest = nullptr;
  double least = infinity;
  Index node = 0;  // of the part
  for (const auto& bound : at.layout.bounds()) {
    const auto* of_pressure = as<PressureBound>(*bound);
    if (of_pressure == nullptr || pressed[of_pressure->node()].segment != segment) continue;
    if (const double far = std::abs(double(++node) - place); far < least) {
      least = far;
      nearest = of_pressure;
    }
  }
  assert(nearest != nullptr);
  return *nearest;
}

}  // namespace

std::vector<Transition> edge_lifts_off(const SlidingSetting& setting, const SlidingState& at, std::size_t edge,
                                       const Arrival& arrival) {
  const auto jump = pulling_jump_beside(setting, at, edge);
  if (!jump) return {nothing_lifted()};
  if (-jump->distance.value > 0.9 * jump->held)  // half the arch and more: the part lifts off inside
    return parts_lift_off(setting, at,
                          {.forward = arrival.forward,
                           .tolerance = arrival.tolerance,
                           .at_hand = &pressure_bound_at(at, jump->segment, jump->place)});
  const LiftOffs lifts{{.segment = jump->segment,
                        .obstacle = at.layout.points()[edge].obstacle,
                        .place = at.s(static_cast<Index>(edge)),
                        .on_straight = false,
                        .jump = jump}};
  const std::vector<Index> bounds =
      bounds_of<PullingJumpBound>(at, [&](const PullingJumpBound& bound) { return bound.point() == edge; });
  return lifted_inside(setting, at, lifts, bounds);
}

std::vector<Transition> load_lifts_off(const SlidingSetting& setting, const SlidingState& at, const PartLoad& load,
                                       const Arrival& arrival) {
  auto pulling = reached<LoadPressesBound>(setting, at, arrival);
  std::erase_if(pulling, [&](const LoadPressesBound* bound) { return bound->load().segment != load.segment; });
  const std::size_t obstacle = obstacle_of_part(at, load.segment);
  const bool on_straight = setting.obstacles[obstacle].surface->knots().empty();
  LiftOffs lifts;
  for (const LoadPressesBound* bound : pulling)
    lifts.push_back({.segment = load.segment,
                     .obstacle = obstacle,
                     .place = place_of(setting, bound->load()),
                     .on_straight = on_straight});
  const std::vector<Index> bounds = bounds_of<LoadPressesBound>(at, [&](const LoadPressesBound& bound) {
    return std::find(pulling.begin(), pulling.end(), &bound) != pulling.end();
  });
  return lifted_inside(setting, at, lifts, bounds);
}

std::vector<Transition> load_at_plane_lifts_off(const SlidingSetting& setting, const SlidingState& at,
                                                const StrandEnd& end, const Arrival& arrival) {
  const auto contact = pressed_contact(setting, at, end);
  LiftOffs lifts;
  std::vector<const TipPressesBound*> pulled;
  for (const TipPressesBound* bound : reached<TipPressesBound>(setting, at, arrival)) {
    if (pressed_contact(setting, at, bound->end()) != contact) continue;
    pulled.push_back(bound);
    const std::size_t obstacle = setting.free_ends[*contact].obstacle;
    const auto& segments = at.layout.segments();
    const auto segment =
        static_cast<std::size_t>(&at.layout.segment_at_end(bound->strand(), bound->last()) - segments.data());
    lifts.push_back({.segment = segment,
                     .obstacle = obstacle,
                     .place = bound->last() ? setting.body.length(bound->strand()) : 0.0,
                     .on_straight = setting.obstacles[obstacle].surface->knots().empty()});
  }
  return lifted_inside(setting, at, lifts, bounds_of<TipPressesBound>(at, [&](const TipPressesBound& bound) {
                         return std::find(pulled.begin(), pulled.end(), &bound) != pulled.end();
                       }));
}

}  // namespace arcwall::sliding
