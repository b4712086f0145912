#include "contact/sliding/tips.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "contact/sliding/bending.hpp"
#include "contact/sliding/bound_value.hpp"
#include "contact/sliding/bounds/clamp.hpp"
#include "contact/sliding/bounds/curvature.hpp"
#include "contact/sliding/bounds/free_end.hpp"
#include "contact/sliding/bounds/tail.hpp"
#include "contact/sliding/bounds/tip_presses.hpp"
#include "contact/sliding/clamps.hpp"
#include "contact/sliding/handed_friction.hpp"
#include "contact/sliding/remeshing.hpp"
#include "contact/sliding/rubbing.hpp"
#include "contact/sliding/span_length.hpp"
#include "contact/sliding/spans.hpp"
#include "contact/sliding/tolerances.hpp"

namespace arcwall::sliding {

namespace {

using Span = SlidingContactLayout::Span;
using Change = Transition::Change;

// An end of a strand with a closed contact: its number among the free ends, and what is there.
struct ClosedTip {
  std::size_t end = 0;
  Index strand = 0;
  bool last = false;
  std::size_t obstacle = 0;
  double force = 0.0;          // of the contact [force]
  double load = 0.0;           // of what acts on the tip besides, into the obstacle [force]
  double bend = 0.0;           // how much more the obstacle bends towards the body than the body there [1/length]
  bool bends_with_it = false;  // as the obstacle does, by round-off
};

ClosedTip closed_tip(const SlidingSetting& setting, const SlidingState& at, std::size_t end, const StrandEnd& of) {
  const FreeEnd there = setting.free_ends[end].seen_from(of);
  ClosedTip tip{.end = end,
                .strand = of.strand,
                .last = of.last,
                .obstacle = there.obstacle,
                .force = at.force(at.layout.points().size() + end)};
  tip.load = presses_end(setting, at, there);
  tip.bend = end_curvature_gap(setting, at, there);
  tip.bends_with_it = std::abs(tip.bend) * setting.scales.length <= nearly_straight;
  return tip;
}

// Why contact cannot move between an end and its member.
std::optional<std::string> why_friction_differs(const SlidingSetting& setting, const FreeEnd& end) {
  const SlidingObstacle& obstacle = setting.obstacles[end.obstacle];
  if (obstacle.friction(end.strand) == obstacle.friction_at_end(end.strand, end.last)) return std::nullopt;
  return "a free end has another coefficient of friction than its member: contact that moves between them is not "
         "modelled";
}

// How the body runs between a tip that has come to lie down and the contact inside.
enum class Tail {
  off,      // free, and the tip is off the obstacle
  arch,     // free, and the tip touches: the body is bent so that its middle is off
  flat,     // it lies on the obstacle by itself
  pressed,  // it is pressed on the obstacle
};

Span span_of(Tail tail) {
  if (tail == Tail::flat) return Span::flat;
  return tail == Tail::pressed ? Span::pressed : Span::free;
}

// Tips with a tail of some length between each and a new point.
Transition with_points_inside(const SlidingSetting& setting, const SlidingState& at, const std::vector<ClosedTip>& tips,
                              const std::vector<Tail>& tails, double length) {
  LayoutEdit edit = edit_of(setting.body, at);
  for (std::size_t i = 0; i < tips.size(); ++i) {
    const auto& [end, strand, last, obstacle, force, load, bend, bends_with_it] = tips[i];
    const double s = last ? setting.body.length(strand) - length : length;
    const bool is_loaded = load > zero_force * setting.scales.force;
    const bool stays = tails[i] == Tail::pressed || tails[i] == Tail::arch || (tails[i] == Tail::flat && is_loaded);
    edit.ends_closed[end] = static_cast<std::uint8_t>(stays);
    edit.end_forces[end] = stays ? std::max(tails[i] == Tail::arch ? force : load, 0.0) : 0.0;
    const Span span = span_of(tails[i]);
    const std::size_t point = edit.insert_near_end({strand, last}, s, obstacle, span, Span::free,
                                                   span == Span::pressed ? 2 : 1, force - edit.end_forces[end]);
    const double kept = force > 0.0 ? edit.end_forces[end] / force : 0.0;
    friction_of_point_at(setting, at, at.layout.points().size() + end, s).give_to_point(point, 1.0 - kept, edit);
    edit.end_frictions[end] *= kept;
    if (!stays) edit.end_rubbings[end] = {};
  }
  const auto on = layout_of(edit);
  const ClosedTip& first = tips.front();
  const std::size_t point = on->point_at_end(first.strand, first.last).value();
  const double coordinate = first.last ? setting.body.length(first.strand) : 0.0;
  Transition transition =
      up_to(length, std::make_shared<TailLength>(point, coordinate),
            tails.front() == Tail::off ? Change::passes : Change::spreads, mapped_onto(setting, at, edit, on));
  for (const ClosedTip& tip : tips)
    transition.contacts.push_back(static_cast<Index>(at.layout.points().size() + tip.end));
  return transition;
}

// How the body may run behind a tip that bends as its obstacle does, by what would hold it there. Where the obstacle
// would have to pull it off its own shape, the shape lifts the tip off or, as that bends towards the obstacle, arches.
std::vector<Tail> tails_behind(const SlidingSetting& setting, const Transition& free, const ClosedTip& tip) {
  const SlidingState guess(free.guess.get());
  const std::size_t point = guess.layout.point_at_end(tip.strand, tip.last).value();
  if (lies_by_itself(setting, guess, point)) return {Tail::flat};
  const bool lifts_off = required_pressure_above_roundoff(setting, guess, point) < 0.0;
  return lifts_off ? std::vector{Tail::off, Tail::arch, Tail::pressed} : std::vector{Tail::pressed, Tail::off};
}

// The tips and joints that become tangent to their obstacles together. A joint may do so with both of its strands,
// where they continue each other smoothly: contact moves into the one whose angle with the obstacle shrinks.
std::vector<ClosedTip> tangent_tips(const SlidingSetting& setting, const SlidingState& at, const Arrival& arrival) {
  struct Reached {
    StrandEnd end;
    double rate;
  };
  std::map<std::size_t, Reached> by_contact;
  for (const LiesDownBound* bound : reached<LiesDownBound>(setting, at, arrival)) {
    const double rate = apply(bound->gradient(setting, at), arrival.forward);
    const auto end = end_nearest_to_lying_down(setting, at, bound->end());
    if (!end) continue;
    const auto [known, is_new] = by_contact.try_emplace(*end, Reached{.end = bound->end(), .rate = rate});
    if (!is_new && rate < known->second.rate) known->second = {.end = bound->end(), .rate = rate};
  }
  std::vector<ClosedTip> tips;
  for (const auto& [end, there] : by_contact) tips.push_back(closed_tip(setting, at, end, there.end));
  return tips;
}

// Whether an end on a roller comes to lie on a straight obstacle with what is beside it, as any hinged end does.
bool lies_down_from_hinge(const SlidingSetting& setting, const SlidingState& at, const ClosedTip& tip) {
  if (!setting.body.is_hinged(tip.strand, tip.last)) return false;
  const auto clamp = touched_clamp(setting, at, tip.strand, tip.last);
  return clamp && clamp->obstacle == tip.obstacle;
}

// What the face of a strand that touches comes to at an end.
enum class Beyond {
  nothing,     // it ends there: at a tip, or at a joint behind which the next face is set back or turns away
  same_face,   // that of the next strand goes on, flush and in line
  step,        // that stands out
  hollow_bend  // that turns towards the obstacle
};

Beyond beyond_end(const SlidingSetting& setting, const SlidingState& at, const FreeEnd& end) {
  const auto other = setting.body.joined_end(end.strand, end.last);
  if (!other) return Beyond::nothing;
  const bool same_obstacle = setting.obstacles[end.obstacle].concerns(other->strand);
  for (std::size_t w = 0; w < setting.obstacles.size(); ++w) {
    const bool is_of_wall =
        same_obstacle ? w == end.obstacle : setting.obstacles[w].name == setting.obstacles[end.obstacle].name;
    if (!is_of_wall || !setting.obstacles[w].concerns(other->strand)) continue;
    const double step =
        setting.half_height_touched(w, other->strand) - setting.half_height_touched(end.obstacle, end.strand);
    const FreeEnd next{.strand = other->strand, .last = other->last, .obstacle = w};
    const double turn = sine_from_end(setting, at, end) + sine_from_end(setting, at, next);
    if (step != 0.0) return step > 0.0 ? Beyond::step : Beyond::nothing;
    return turn > exactly_parallel    ? Beyond::nothing
           : turn < -exactly_parallel ? Beyond::hollow_bend
                                      : Beyond::same_face;
  }
  return Beyond::nothing;
}

// Why contact that comes to an end cannot be one of the end; `inner`: how the body runs up to it from inside. Empty
// where it can.
std::optional<std::string> what_hinders(const SlidingSetting& setting, const SlidingState& at, const FreeEnd& end,
                                        Span inner) {
  const Beyond beyond = beyond_end(setting, at, end);
  if (beyond == Beyond::step)
    return "the contact point reached a joint beyond which the section is deeper: its step would touch";
  if (beyond == Beyond::hollow_bend)
    return "the contact point reached a re-entrant joint, where the next member would also touch the wall";
  if (inner == Span::free) return std::nullopt;
  if (setting.body.is_tip(end.strand, end.last) && inner == Span::pressed) return std::nullopt;
  if (setting.body.is_tip(end.strand, end.last)) return "a contact zone reached the free end of its member";
  if (beyond == Beyond::same_face) return "a contact zone reached a joint beyond which the face continues";
  if (inner == Span::pressed) return "a contact zone reached a corner of the structure";
  return std::nullopt;
}

// Takes the point out that has come to an end. A flat part of which it was the edge lifts off between its other edge,
// which becomes a point contact, and the end: nothing holds a moment at the end but that of an arch.
void erase_before_end(const SlidingSetting& setting, const StrandEnd& end, bool flat, std::size_t point,
                      LayoutEdit& edit) {
  const std::size_t inner = end.last ? point - 1 : point + 1;
  int elements = end.last ? edit.elements_before(point) : edit.elements_behind(point);
  if (flat) {
    const double from = end.last ? edit.place(inner) : 0.0;
    const double to = end.last ? setting.body.length(end.strand) : edit.place(inner);
    elements = elements_asked(setting.body, end.strand, from, to, 2);
    edit.points[end.last ? inner : point].behind = Span::free;
  }
  edit.erase(point, elements);
}

}  // namespace

bool face_goes_on(const SlidingSetting& setting, const SlidingState& at, const FreeEnd& end) {
  const auto other = setting.body.joined_end(end.strand, end.last);
  if (!other || beyond_end(setting, at, end) != Beyond::same_face) return false;
  const auto rotation = [&](const FreeEnd& seen) {
    return at.mesh.node_unknowns(seen.strand, seen.position(at.mesh))[2];
  };
  return rotation(end) == rotation(end.seen_from(*other));
}

double presses_end(const SlidingSetting& setting, const SlidingState& at, const FreeEnd& end) {
  const Touch touch = touch_of_end(setting, at.layout, end);
  const Obstacle& surface = *setting.obstacles[end.obstacle].surface;
  const double put = -at.mesh.load_on_end(end.strand, end.last, at.now)
                          .force.dot(surface.normal(face(touch.offset, touch.axis(at)), at.now.lambda));
  return put + bent_onto_end(setting, held_axis_at_end(setting, at, end), end.last);
}

// The normal at the end changes with the end's place and direction: that by differences.
Row presses_end_gradient(const SlidingSetting& setting, const SlidingState& at, const FreeEnd& end) {
  const Touch touch = touch_of_end(setting, at.layout, end);
  const Obstacle& surface = *setting.obstacles[end.obstacle].surface;
  const SlidingMesh::EndLoad load = at.mesh.load_on_end(end.strand, end.last, at.now);
  const auto normal = [&](const State& there) {
    const SlidingState moved(there);
    return surface.normal(face(touch.offset, touch.axis(moved)), moved.now.lambda);
  };
  const auto rate = [&](const auto& change, double by) {
    State less = at.state, more = at.state;
    change(less, -by);
    change(more, by);
    return load.force.dot(normal(more) - normal(less)) / (2.0 * by);
  };
  const Vec2 here = normal(at.state);
  Row row = bent_onto_end_gradient(setting, at, held_axis_at_end(setting, at, end), end.last);
  row.dx.head(load.dx[0].size()) += -here.x() * load.dx[0] - here.y() * load.dx[1];
  row.dlambda -= here.dot(load.dlambda);
  if (load.force.isZero(0.0)) return row;
  const NodeUnknowns unknowns = at.mesh.node_unknowns(end.strand, touch.position);
  for (std::size_t i = 0; i < 3; ++i)
    if (const Index unknown = unknowns[i]; unknown >= 0)
      row.dx[unknown] -=
          rate([unknown](State& there, double by) { there.x[unknown] += by; },
               i < 2 ? difference_step_at_place * setting.body.length(end.strand) : difference_step_at_place);
  row.dlambda -= rate([](State& there, double by) { there.lambda += by; }, difference_step_at_place);
  return row;
}

std::optional<std::size_t> pressed_contact(const SlidingSetting& setting, const SlidingState& at, const StrandEnd& of) {
  const auto obstacle = at.layout.pressed_up_to(of);
  const auto contact = obstacle ? setting.number_of_end(of, *obstacle) : std::nullopt;
  return contact && at.is_closed(at.layout.points().size() + *contact) ? contact : std::nullopt;
}

std::vector<Transition> tips_lie_down(const SlidingSetting& setting, const SlidingState& at, const Arrival& arrival) {
  if (auto zones = zones_leave_joints(setting, at, arrival); !zones.empty()) return zones;
  const std::vector<ClosedTip> tips = tangent_tips(setting, at, arrival);
  const auto has_joint = std::any_of(tips.begin(), tips.end(), [&](const ClosedTip& tip) {
    return setting.body.joined_end(tip.strand, tip.last).has_value();
  });
  const Transition none = unsupported(
      has_joint ? "a joint comes into full contact with a wall, but no equilibrium was found there"
                : "the end of a member comes into full contact with a wall, but no equilibrium was found there");
  if (tips.empty()) return {none};
  for (const ClosedTip& tip : tips)
    if (auto why = why_friction_differs(setting, {.strand = tip.strand, .last = tip.last, .obstacle = tip.obstacle}))
      return {unsupported(std::move(*why))};
  const double length = 2.0 * shortest_tail(setting.body, tips.front().strand);
  const Transition free = with_points_inside(setting, at, tips, std::vector(tips.size(), Tail::off), length);
  std::vector<std::vector<Tail>> ways;
  std::size_t most_ways = 0;
  for (const ClosedTip& tip : tips) {
    if (!tip.bends_with_it && tip.bend < 0.0) return {none};
    if (tip.bends_with_it && lies_down_from_hinge(setting, at, tip))
      return clamps_are_left(setting, at, at_bound_of_end<ClampBound>(at, arrival, {tip.strand, tip.last}));
    if (tip.bends_with_it && !setting.body.is_tip(tip.strand, tip.last)) return {none};
    ways.push_back(tip.bends_with_it ? tails_behind(setting, free, tip) : std::vector{Tail::off});
    most_ways = std::max(most_ways, ways.back().size());
  }
  std::vector<Transition> transitions;
  for (std::size_t way = 0; way < most_ways; ++way) {
    std::vector<Tail> tails;
    for (const std::vector<Tail>& of_tip : ways) tails.push_back(of_tip[std::min(way, of_tip.size() - 1)]);
    // The gap below an arch grows with the fifth power of its length, and the angle at its ends with the fourth.
    const bool arches = std::find(tails.begin(), tails.end(), Tail::arch) != tails.end();
    transitions.push_back(with_points_inside(setting, at, tips, tails, arches ? 8.0 * length : length));
  }
  transitions.push_back(none);
  return transitions;
}

std::vector<Transition> contacts_come_to_tips(const SlidingSetting& setting, const SlidingState& at,
                                              const Arrival& arrival) {
  std::vector<const TailBound*> tails;
  for (const TailBound* bound : reached<TailBound>(setting, at, arrival))
    if (at.is_closed(bound->point()) && !bound->gathers_at_support(setting, at)) tails.push_back(bound);
  LayoutEdit edit = edit_of(setting.body, at);
  std::vector<std::size_t> ends;
  bool lay = false, is_pressed = false;
  for (auto tail = tails.rbegin(); tail != tails.rend(); ++tail) {
    const std::size_t point = (*tail)->point();
    const auto [strand, last] = std::pair((*tail)->strand(), (*tail)->last());
    const Span inner = last ? at.layout.span_before(point) : at.layout.points()[point].behind;
    if (ends.empty()) is_pressed = inner == Span::pressed;
    lay = lay || at.layout.span_at_end(strand, last) != Span::free;
    const StrandEnd of{.strand = strand, .last = last};
    const auto found = std::find_if(setting.free_ends.begin(), setting.free_ends.end(), [&](const FreeEnd& contact) {
      return contact.is_of(of) && contact.obstacle == at.layout.points()[point].obstacle;
    });
    if (found == setting.free_ends.end())
      return {unsupported("a contact point reached a pinned end of its member, where the support carries the force")};
    const auto end = static_cast<std::size_t>(found - setting.free_ends.begin());
    const FreeEnd there = found->seen_from(of);
    if (auto why = what_hinders(setting, at, there, inner)) return {unsupported(std::move(*why))};
    if (auto why = why_friction_differs(setting, there)) return {unsupported(std::move(*why))};
    ends.push_back(end);
    HandedFriction friction = friction_of_end(setting, at, point, there);
    if (at.rubs(at.layout.points().size() + end)) {
      const HandedFriction before{.rubbing = anchored_anew(setting, at, at.layout.points().size() + end),
                                  .force = edit.end_frictions[end],
                                  .held = edit.ends_held[end]};
      const bool do_the_same = friction.rubbing.mode == before.rubbing.mode;
      friction = merged(before, friction, do_the_same ? before.rubbing.mode : ContactMode::sticks, 0.0);
    }
    friction.give_to_end(end, 1.0, edit);
    edit.end_forces[end] += edit.forces[point];
    edit.ends_closed[end] = 1;
    if (inner == Span::pressed) {
      edit.press_up_to_end(point, last, last ? edit.elements_before(point) : edit.elements_behind(point));
    } else {
      erase_before_end(setting, of, inner == Span::flat, point, edit);
    }
  }
  const auto on = layout_of(edit);
  State guess = mapped_onto(setting, at, edit, on);
  const auto is_of_tail = [&](const auto& bound) {
    return bound.end() == StrandEnd{.strand = tails.back()->strand(), .last = tails.back()->last()};
  };
  const std::size_t behind =
      is_pressed ? bound_number<TipPressesBound>(*on, is_of_tail) : bound_number<LiesDownBound>(*on, is_of_tail);
  Transition transition = up_to(0.0, std::make_shared<BoundValue>(setting, behind),
                                is_pressed ? Change::joins
                                : lay      ? Change::gathers
                                           : Change::passes,
                                std::move(guess));
  for (const std::size_t end : ends) transition.contacts.push_back(static_cast<Index>(on->points().size() + end));
  return {transition, unsupported("a contact point reached the end of a member, but no equilibrium was found there")};
}

std::vector<Transition> peel_off_from_tips(const SlidingSetting& setting, const SlidingState& at,
                                           const std::vector<StrandEnd>& tips, bool lifted) {
  const Transition none = unsupported(
      "a contact zone up to the free end of its member peels off from there, but no such equilibrium was found");
  std::vector<Transition> transitions;
  for (const double factor : {2.0, 8.0, 32.0}) {
    const double length = factor * shortest_tail(setting.body, tips.front().strand);
    const auto has_room = [&](const StrandEnd& tip) {
      const auto [from, to] = at.layout.ends(setting.body, at.layout.segment_at_end(tip.strand, tip.last), at.now.s);
      return length <= 0.5 * (to - from) / double(tips.size());
    };
    if (!std::all_of(tips.begin(), tips.end(), has_room)) break;
    LayoutEdit edit = edit_of(setting.body, at);
    std::vector<Index> contacts;
    for (const auto& [strand, last] : tips) {
      const double L = setting.body.length(strand), s = last ? L - length : length;
      const auto end = pressed_contact(setting, at, {.strand = strand, .last = last});
      if (!end) return {none};
      edit.set_lying(strand, std::nullopt);
      edit.insert_near_end({strand, last}, s, setting.free_ends[*end].obstacle, Span::free, Span::pressed,
                           elements_asked(setting.body, strand, 0.0, length, 2));
      edit.ends_closed[*end] = static_cast<std::uint8_t>(!lifted);
      contacts.push_back(static_cast<Index>(at.layout.points().size() + *end));
    }
    const auto on = layout_of(edit);
    const auto [strand, last] = tips.front();
    const std::size_t point = on->point_at_end(strand, last).value();
    transitions.push_back(up_to(length, std::make_shared<TailLength>(point, last ? setting.body.length(strand) : 0.0),
                                Change::splits, mapped_onto(setting, at, edit, on)));
    transitions.back().contacts = contacts;
  }
  transitions.push_back(none);
  return transitions;
}

namespace {

// An arch between a joint that touches and the next contact point, on one straight wall, that has no height left.
struct VanishedArch {
  ClosedTip joint;
  std::size_t point;
};

// In the order of their places. Without load between, an axis with neither slope nor curvature at one end is straight.
std::vector<VanishedArch> vanished_arches_at_joints(const SlidingSetting& setting, const SlidingState& at,
                                                    const Arrival& arrival) {
  std::vector<VanishedArch> arches;
  for (const ClosedTip& joint : tangent_tips(setting, at, arrival)) {
    const auto point = at.layout.point_at_end(joint.strand, joint.last);
    const bool is_arch = point && at.is_closed(*point) && at.layout.points()[*point].obstacle == joint.obstacle &&
                         at.layout.segment_at_end(joint.strand, joint.last).has_point();
    if (is_arch && joint.bends_with_it && setting.body.joined_end(joint.strand, joint.last) &&
        !at.layout.lies_beside(*point) && lies_by_itself(setting, at, *point))
      arches.push_back({.joint = joint, .point = *point});
  }
  std::sort(arches.begin(), arches.end(), [](const VanishedArch& a, const VanishedArch& b) {
    return std::pair(a.point, a.joint.last) < std::pair(b.point, b.joint.last);
  });
  return arches;
}

}  // namespace

std::vector<Transition> zones_leave_joints(const SlidingSetting& setting, const SlidingState& at,
                                           const Arrival& arrival) {
  const std::vector<VanishedArch> arches = vanished_arches_at_joints(setting, at, arrival);
  if (arches.empty()) return {};
  const ClosedTip& first = arches.front().joint;
  const double length = 2.0 * shortest_tail(setting.body, first.strand);
  LayoutEdit edit = edit_of(setting.body, at);
  std::vector<Index> contacts;
  for (const VanishedArch& arch : arches) contacts.push_back(static_cast<Index>(arch.point));
  for (auto arch = arches.rbegin(); arch != arches.rend(); ++arch) {
    const auto& [joint, point] = *arch;
    const double s = joint.last ? setting.body.length(joint.strand) - length : length;
    edit.insert_near_end({joint.strand, joint.last}, s, joint.obstacle, Span::free, Span::flat, 1, joint.force);
    if (joint.last) edit.points[point].behind = Span::flat;
    edit.elements_behind(point) = 1;  // of the zone: between the point, or the new one, and the next
    edit.ends_closed[joint.end] = 0;
    edit.end_forces[joint.end] = 0.0;
    contacts.push_back(static_cast<Index>(at.layout.points().size() + joint.end));
  }
  const auto on = layout_of(edit);
  auto tail = std::make_shared<TailLength>(on->point_at_end(first.strand, first.last).value(),
                                           first.last ? setting.body.length(first.strand) : 0.0);
  Transition transition = up_to(length, std::move(tail), Change::spreads, mapped_onto(setting, at, edit, on));
  transition.contacts = std::move(contacts);
  return {std::move(transition),
          unsupported("a contact zone begins at a joint, but no equilibrium with the joint off the wall was found")};
}

std::optional<Transition> tip_touches_with(const SlidingSetting& setting, const SlidingState& at, std::size_t point) {
  const std::size_t points = at.layout.points().size(), obstacle = at.layout.points()[point].obstacle;
  for (std::size_t end = 0; end < setting.free_ends.size(); ++end) {
    const FreeEnd& tip = setting.free_ends[end];
    if (tip.obstacle != obstacle || at.is_closed(points + end) || !setting.body.is_tip(tip.strand, tip.last)) continue;
    if (at.layout.point_at_end(tip.strand, tip.last) != point) continue;
    if (at.layout.span_at_end(tip.strand, tip.last) != Span::free) continue;
    const double gap = face_gap(setting, touch_of_contact(setting, at.layout, points + end), at);
    if (!(std::abs(gap) <= touching_with_point * setting.scales.length)) continue;
    LayoutEdit edit = edit_of(setting.body, at);
    edit.ends_closed[end] = 1;
    const auto on = layout_of(edit);
    const std::size_t loses_curvature =
        bound_number<CurvatureBound>(*on, [&](const CurvatureBound& bound) { return bound.point() == point; });
    Transition transition = up_to(0.0, std::make_shared<BoundValue>(setting, loses_curvature), Change::joins,
                                  mapped_onto(setting, at, edit, on));
    transition.contacts = {static_cast<Index>(points + end)};
    return transition;
  }
  return std::nullopt;
}

}  // namespace arcwall::sliding
