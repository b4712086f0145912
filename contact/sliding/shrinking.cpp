#include "contact/sliding/shrinking.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "contact/sliding/bending.hpp"
#include "contact/sliding/bound_value.hpp"
#include "contact/sliding/bounds/curvature.hpp"
#include "contact/sliding/bounds/length.hpp"
#include "contact/sliding/bounds/pressure.hpp"
#include "contact/sliding/bounds/pulling_jump.hpp"
#include "contact/sliding/bounds/tip_presses.hpp"
#include "contact/sliding/curvature_jumps.hpp"
#include "contact/sliding/handed_friction.hpp"
#include "contact/sliding/pulling_jumps.hpp"
#include "contact/sliding/remeshing.hpp"
#include "contact/sliding/rubbing.hpp"
#include "contact/sliding/span_length.hpp"
#include "contact/sliding/tips.hpp"
#include "contact/sliding/tolerances.hpp"

namespace arcwall::sliding {

namespace {

using Points = std::vector<std::size_t>;
using Span = SlidingContactLayout::Span;

// The coordinate of what a bound watches on an edited layout.
double place_of(const CurvatureBound& bound, const SlidingContactLayout&, const Vector& s) {
  return s[static_cast<Index>(bound.point())];
}

double place_of(const PressureBound& bound, const SlidingContactLayout& on, const Vector& s) {
  const SlidingContactLayout::PressedNode& node = on.pressed_nodes()[bound.node()];
  return on.mesh().coordinate(node.strand, node.position, s);
}

double place_of(const PullingJumpBound& bound, const SlidingContactLayout&, const Vector& s) {
  return s[static_cast<Index>(bound.point())];
}

// What a transition to a bound names: the point that has formed, or the guard where parts have joined.
Index named(const CurvatureBound& bound, Index) { return static_cast<Index>(bound.point()); }
Index named(const PressureBound&, Index guard) { return guard; }
Index named(const PullingJumpBound&, Index guard) { return guard; }

// The number of the bound of a kind that is nearest a coordinate; empty if there is none.
template <class Bound>
std::optional<std::size_t> nearest(const SlidingContactLayout& on, const Vector& s, double place) {
  std::optional<std::size_t> nearest;
  double least = infinity;
  for (std::size_t i = 0; i < on.bounds().size(); ++i) {
    const auto* bound = as<Bound>(*on.bounds()[i]);
    if (bound == nullptr || std::abs(place_of(*bound, on, s) - place) >= least) continue;
    least = std::abs(place_of(*bound, on, s) - place);
    nearest = i;
  }
  return nearest;
}

// Up to the bound of the active set ahead from which the span at the first place would have grown: the nearest of its
// kind.
template <class Bound>
Transition back_to(const SlidingSetting& setting, const SlidingState& at, const LayoutEdit& edit,
                   const std::vector<double>& places, Transition::Change change) {
  const auto on = layout_of(edit);
  State guess = mapped_onto(setting, at, edit, on);
  const auto contacts = static_cast<Index>(guess.active_set.size());
  const auto first = nearest<Bound>(*on, edit.s, places.front());
  if (!first) return unsupported("spans join there in a way that is not modelled");
  Transition transition = up_to(0.0, std::make_shared<BoundValue>(setting, *first), change, std::move(guess));
  for (const double place : places) {
    const std::size_t bound = nearest<Bound>(*on, edit.s, place).value();
    const Index name = named(static_cast<const Bound&>(*on->bounds()[bound]), contacts + static_cast<Index>(bound));
    auto& named_before = transition.contacts;
    if (std::find(named_before.begin(), named_before.end(), name) == named_before.end()) named_before.push_back(name);
  }
  return transition;
}

// Friction of a tracked point [force].
double friction_at(const SlidingState& at, std::size_t point) {
  const auto T = at.index.friction(point);
  return T ? at.state.x[*T] : 0.0;
}

// The slip that the friction of both edges of a span resists, if one of them slips so and the other does not.
std::optional<ContactMode> slip_of_one_edge(const SlidingState& at, std::size_t first) {
  const ContactMode one = at.layout.rubbing(first).mode, other = at.layout.rubbing(first + 1).mode;
  const ContactMode against = friction_at(at, first) + friction_at(at, first + 1) < 0.0 ? ContactMode::slips_forward
                                                                                        : ContactMode::slips_backward;
  if (one == other || (one != against && other != against)) return std::nullopt;
  return against;
}

// How much more friction the point can bear that a span becomes [force].
double friction_left(const SlidingSetting& setting, const SlidingState& at, std::size_t first) {
  return friction_coefficient(setting, at.layout, first) * (at.force(first) + at.force(first + 1)) -
         std::abs(friction_at(at, first) + friction_at(at, first + 1));
}

// What the points may do that spans become, each for itself. If both edges of a span do the same the point goes on with
// it. Else |T₁ + T₂| < μ (p₁ + p₂) and it sticks, unless the edge that does not slip comes to its bound within the rest
// of the span: so may those that are nearest to it, mirror images together.
std::vector<std::vector<ContactMode>> modes_of_points(const SlidingSetting& setting, const SlidingState& at,
                                                      const Points& spans) {
  std::vector<ContactMode> modes;
  std::vector<std::pair<double, std::size_t>> may_slip;
  for (const std::size_t k : spans) {
    const ContactMode one = at.layout.rubbing(k).mode;
    modes.push_back(one == at.layout.rubbing(k + 1).mode ? one : ContactMode::sticks);
    if (slip_of_one_edge(at, k)) may_slip.emplace_back(friction_left(setting, at, k), modes.size() - 1);
  }
  std::sort(may_slip.begin(), may_slip.end());
  std::vector<std::vector<ContactMode>> all{modes};
  for (std::size_t i = 0; i < may_slip.size(); ++i) {
    const auto [left, span] = may_slip[i];
    modes[span] = slip_of_one_edge(at, spans[span]).value();
    const bool has_twin =
        i + 1 < may_slip.size() && may_slip[i + 1].first - left <= reached_nearly * setting.scales.force;
    if (!has_twin) all.push_back(modes);
  }
  return all;
}

// Two points at the ends of each span become one in its middle. `modes`: what friction does at each.
Transition gathered(const SlidingSetting& setting, const SlidingState& at, const Points& spans,
                    const std::vector<ContactMode>& modes) {
  LayoutEdit edit = edit_of(setting.body, at);
  const auto middle = [&](std::size_t k) { return 0.5 * (edit.place(k) + edit.place(k + 1)); };
  std::vector<double> places;
  for (const std::size_t k : spans) places.push_back(middle(k));
  for (std::size_t i = spans.size(); i-- > 0;) {
    const std::size_t k = spans[i];
    const double s = middle(k);
    const HandedFriction friction =
        merged(friction_of_point_at(setting, at, k, s), friction_of_point_at(setting, at, k + 1, s), modes[i], s);
    edit.points[k].behind = edit.points[k + 1].behind;
    edit.points[k].neutral_behind = edit.points[k + 1].neutral_behind;
    edit.forces[k] += edit.forces[k + 1];
    edit.erase(k + 1, edit.elements_behind(k + 1));
    edit.place(k) = s;
    friction.give_to_point(k, 1.0, edit);
  }
  return back_to<CurvatureBound>(setting, at, edit, places, Transition::Change::gathers);
}

// Where a part that has just joined over a gap is without pressure: between two parts, or at a point contact beside
// one.
double without_pressure_at(const SlidingState& at, std::size_t gap) {
  const auto first = static_cast<Index>(gap);
  const bool before = at.layout.span_before(gap) == Span::pressed;
  const bool behind = at.layout.points()[gap + 1].behind == Span::pressed;
  if (before != behind) return at.s(before ? first + 1 : first);
  return 0.5 * (at.s(first) + at.s(first + 1));
}

// Two pressed parts become one, or a pressed part and a point contact beside it, which is the part's edge then, moved
// along the body by `moved` [length].
Transition joined(const SlidingSetting& setting, const SlidingState& at, const Points& gaps, double moved = 0.0) {
  LayoutEdit edit = edit_of(setting.body, at);
  std::vector<double> places;
  for (const std::size_t k : gaps) places.push_back(without_pressure_at(at, k));
  for (auto k = gaps.rbegin(); k != gaps.rend(); ++k) {
    const Index strand = edit.strands[*k];
    const std::size_t obstacle = edit.points[*k].obstacle;
    const bool before = at.layout.span_before(*k) == Span::pressed;
    const bool behind = at.layout.points()[*k + 1].behind == Span::pressed;
    edit.points[*k].behind = Span::pressed;
    if (behind) edit.erase(*k + 1, edit.elements_behind(*k + 1) + (before ? 0 : 1));
    if (before) edit.erase(*k, edit.elements_before(*k) + (behind ? edit.elements_behind(*k) : 1));
    if (before != behind) edit.place(*k) += moved;
    if (std::find(edit.strands.begin(), edit.strands.end(), strand) != edit.strands.end()) continue;
    if (!setting.obstacles[obstacle].surface->knots().empty())
      return unsupported("a member comes into contact with a curved wall along its whole length");
    edit.set_lying(strand, obstacle);
  }
  const bool at_jump = gaps.size() == 1 && bridges_pulling_jump(setting, at, gaps.front());
  return at_jump ? back_to<PullingJumpBound>(setting, at, edit, places, Transition::Change::joins)
                 : back_to<PressureBound>(setting, at, edit, places, Transition::Change::joins);
}

}  // namespace

std::vector<Transition> span_vanishes(const SlidingSetting& setting, const SlidingState& at, std::size_t point,
                                      const Arrival& arrival) {
  const auto closes_a_gap = [&](std::size_t k) { return at.layout.parts_pressed(k); };
  Points spans;
  for (const LengthBound* bound : reached<LengthBound>(setting, at, arrival)) spans.push_back(bound->point());
  if (std::find(spans.begin(), spans.end(), point) == spans.end()) spans = {point};
  std::erase_if(spans, [&](std::size_t k) { return closes_a_gap(k) != closes_a_gap(point); });
  if (closes_a_gap(point)) return {joined(setting, at, spans)};
  std::vector<Transition> transitions;
  for (const std::vector<ContactMode>& modes : modes_of_points(setting, at, spans))
    transitions.push_back(gathered(setting, at, spans, modes));
  return transitions;
}

Transition zone_joins_at_plane(const SlidingSetting& setting, const SlidingState& at, std::size_t point, bool last) {
  LayoutEdit edit = edit_of(setting.body, at);
  const Index strand = edit.strands[point];
  const StrandEnd of{.strand = strand, .last = last};
  const std::size_t end = setting.number_of_end({.strand = strand, .last = last}, edit.points[point].obstacle).value();
  edit.ends_closed[end] = 1;
  edit.end_forces[end] = edit.forces[point];
  edit.press_up_to_end(point, last, edit.elements_before(point) + edit.elements_behind(point));
  if (!(presses_end(setting, at, setting.free_ends[end].seen_from(of)) < 0.0))
    return back_to<PressureBound>(setting, at, edit, {last ? setting.body.length(strand) : 0.0},
                                  Transition::Change::joins);
  const auto on = layout_of(edit);
  const std::size_t pulls = bound_number<TipPressesBound>(*on, [&](const auto& bound) { return bound.end() == of; });
  Transition transition = up_to(0.0, std::make_shared<BoundValue>(setting, pulls), Transition::Change::joins,
                                mapped_onto(setting, at, edit, on));
  transition.contacts = {static_cast<Index>(on->points().size() + end)};
  return transition;
}

namespace {

// A short stretch of a pressed part and an arch beside it, which ends at a point, both of which become shorter along
// the path; the first of the two spans. Empty where the span behind a point and none of its neighbours are such.
std::optional<std::size_t> half_pressed_stretch(const SlidingSetting& setting, const SlidingState& at,
                                                const Direction& forward, std::size_t point) {
  constexpr double longest = 0.02;  // of the strand
  const auto& points = at.layout.points();
  const auto joins_one = [&](std::size_t k) {
    return k + 1 < points.size() && points[k].obstacle == points[k + 1].obstacle &&
           at.mesh.breakpoint(static_cast<Index>(k)).first == at.mesh.breakpoint(static_cast<Index>(k + 1)).first;
  };
  const auto shrinks = [&](std::size_t k) { return apply(SpanLength(k).gradient(at.state), forward) < 0.0; };
  const auto is_half_pressed = [&](std::size_t k) {
    if (!joins_one(k) || !joins_one(k + 1)) return false;
    const Span first = points[k].behind, second = points[k + 1].behind;
    const bool halves =
        (first == Span::pressed && second == Span::free) || (first == Span::free && second == Span::pressed);
    const double L = setting.body.length(at.mesh.breakpoint(static_cast<Index>(k)).first);
    return halves && shrinks(k) && shrinks(k + 1) && at.layout.span_before(k) == Span::free &&
           points[k + 2].behind == Span::free &&
           at.s(static_cast<Index>(k + 2)) - at.s(static_cast<Index>(k)) <= longest * L;
  };
  if (is_half_pressed(point)) return point;
  if (point > 0 && is_half_pressed(point - 1)) return point - 1;
  return std::nullopt;
}

// A pressed part and a point contact beside it have joined before the pressure between them shows it, as where the mesh
// does not resolve the wall's curvature: the active set ahead holds already. It is entered at the same λ.
Transition joined_here(const SlidingSetting& setting, const SlidingState& at, std::size_t gap) {
  Transition transition = joined(setting, at, {gap});
  transition.quantity.reset();
  return transition;
}

// A part that is pressed on a line, and a point contact beside it where an arc of the wall begins. As the arch between
// them vanishes there is no moment at the arc's beginning, and behind that the part's edge goes back along the line.
std::optional<Transition> joined_at_jump(const SlidingSetting& setting, const SlidingState& at, std::size_t gap) {
  constexpr double beside = 1e-4, guessed = 1e-5, beyond = 1e-9;  // of the length scale
  const double L = setting.scales.length;
  const bool before = at.layout.span_before(gap) == Span::pressed;
  const bool behind = at.layout.points()[gap + 1].behind == Span::pressed;
  if (at.layout.points()[gap].behind != Span::free || before == behind) return std::nullopt;
  const Touch touch = touch_of_contact(setting, at.layout, before ? gap + 1 : gap);
  const double to = before ? -1.0 : 1.0;  // from the point contact to the part
  const auto jump = curvature_jump_beside(setting, touch, touch.axis(at), to, beside * L, at.now.lambda);
  if (!jump) return std::nullopt;
  Transition transition = joined(setting, at, {gap}, to * (jump->distance + guessed * L));
  transition.quantity = std::make_shared<PastKink>(setting, gap, kink_at(setting, at, touch, *jump, to));
  transition.value = beyond * L;
  transition.contacts = {static_cast<Index>(gap)};
  return transition;
}

}  // namespace

std::vector<Transition> neighbours_vanish(const SlidingSetting& setting, const SlidingState& at,
                                          const Direction& forward, std::size_t point) {
  std::vector<Transition> transitions;
  if (auto transition = joined_at_jump(setting, at, point)) transitions.push_back(std::move(*transition));
  if (const auto first = half_pressed_stretch(setting, at, forward, point))
    transitions.push_back(gathered(setting, at, {*first, *first + 1}, std::vector(2, ContactMode::open)));
  const bool before = at.layout.span_before(point) == Span::pressed;
  const bool behind = at.layout.points()[point + 1].behind == Span::pressed;
  if (at.layout.points()[point].behind == Span::free && before != behind && !obstacle_is_straight(setting, at, point))
    transitions.push_back(joined_here(setting, at, point));
  return transitions;
}

}  // namespace arcwall::sliding
