#include "contact/sliding/spreading.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "contact/sliding/bending.hpp"
#include "contact/sliding/bounds/clamp.hpp"
#include "contact/sliding/bounds/curvature.hpp"
#include "contact/sliding/clamps.hpp"
#include "contact/sliding/handed_friction.hpp"
#include "contact/sliding/neutral_spans.hpp"
#include "contact/sliding/pressed_part.hpp"
#include "contact/sliding/pulling_jumps.hpp"
#include "contact/sliding/remeshing.hpp"
#include "contact/sliding/span_length.hpp"
#include "contact/sliding/spans.hpp"
#include "contact/sliding/tips.hpp"
#include "contact/sliding/tolerances.hpp"
#include "core/text.hpp"

namespace arcwall::sliding {

namespace {

using Points = std::vector<std::size_t>;

// Ends on planes of symmetry: points in the middle of the whole body, of which the half before or behind the plane is
// there.
using Planes = std::vector<FreeEnd>;
using Span = SlidingContactLayout::Span;

std::string counted(Index count, const std::string& what) {
  return std::to_string(count) + " " + what + (count > 1 ? "s" : "");
}

// One that reaches the end of its member has a length of its own: no force is in it.
bool is_flat_between_points(const SlidingContactLayout::Segment& segment) {
  return segment.span == Span::flat && segment.first_point >= 0 && segment.last_point >= 0;
}

// `lines`: of contacts that lie on walls by themselves.
Continuum continuum_of(const SlidingState& at, Index lines) {
  Continuum common{.parts = lines, .energy = at.mesh.energy(at.now)};
  for (const SlidingContactLayout::Segment& segment : at.layout.segments())
    if (is_flat_between_points(segment)) common.length += at.s(segment.last_point) - at.s(segment.first_point);
  return common;
}

Transition end_before(const Continuum& common) {
  return {.change = Transition::Change::continuum,
          .detail = "at this load " + counted(common.parts, "contact") +
                    " would grow from points into zones at the same time. Equilibrium determines only the sum of their "
                    "lengths, " +
                    round_trip(common.length) + " here, not each of them; all these equilibria have the same energy, " +
                    round_trip(common.energy),
          .continuum = common};
}

// Whether a point load is so near to a point that it has no node.
bool has_load_beside(const SlidingSetting& setting, const SlidingState& at, std::size_t point) {
  const auto k = static_cast<Index>(point);
  const Index strand = at.mesh.breakpoint(k).first;
  const std::vector<double>& places = setting.body.point_loads(strand);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double from = std::min(places[i], at.s(k)), to = std::max(places[i], at.s(k));
    if (!at.layout.has_node(strand, static_cast<Index>(i)) &&
        setting.body.elements_between(strand, from, to) <= farthest_load_inside)
      return true;
  }
  return false;
}

// Whether a point load acts on a strand between two places.
bool has_load_between(const SlidingSetting& setting, Index strand, double from, double to) {
  const std::vector<double>& places = setting.body.point_loads(strand);
  return std::any_of(places.begin(), places.end(), [&](double place) { return from < place && place < to; });
}

// The axis at points and planes, the latter behind.
std::vector<HeldAxis> held_axes(const SlidingSetting& setting, const SlidingState& at, const Points& points,
                                const Planes& planes) {
  std::vector<HeldAxis> held;
  for (const std::size_t k : points) held.push_back(held_axis(setting, at, k));
  for (const FreeEnd& end : planes) held.push_back(held_axis_at_end(setting, at, end));
  return held;
}

// In words: what was looked for behind points that lose their curvature, and why it may be hard to find.
std::string why_none_spreads(const SlidingSetting& setting, const SlidingState& at, const Points& points,
                             const Planes& planes) {
  const auto straight = [&](std::size_t k) { return obstacle_curvature(setting, at, k) == 0.0; };
  const auto count = static_cast<Index>(points.size() + planes.size());
  std::string text = counted(count, "contact point") + (count > 1 ? " become zones" : " becomes a zone") +
                     ", but no equilibrium with short ones was found";
  if (std::any_of(points.begin(), points.end(), [&](std::size_t k) { return has_load_beside(setting, at, k); }))
    text += " beside the point load there";
  const bool others = points.size() < at.layout.points().size();
  if ((count > 1 || others) && std::all_of(points.begin(), points.end(), straight))
    text += "; the structure is nearly perfect, and a perfect one determines only the sum of the lengths of all zones";
  return text;
}

// The number of an end's contact among those of an active set.
std::size_t contact_of(const SlidingSetting& setting, const SlidingState& at, const FreeEnd& end) {
  return at.layout.points().size() +
         setting.number_of_end({.strand = end.strand, .last = end.last}, end.obstacle).value();
}

// Behind each of the points, and beside each of the planes, there are spans now, of which one begins with a length.
Transition with_spans(const SlidingSetting& setting, const SlidingState& at, const Points& points,
                      const LayoutEdit& edit, double length, std::shared_ptr<const Observable> of_one,
                      const Planes& planes = {}) {
  Transition transition =
      up_to(length, std::move(of_one), Transition::Change::spreads, mapped_when_tried(setting, at, edit));
  for (const std::size_t k : points) transition.contacts.push_back(static_cast<Index>(k));
  for (const FreeEnd& end : planes) {
    const auto contact = static_cast<Index>(contact_of(setting, at, end));
    if (transition.contacts.empty() || transition.contacts.back() != contact) transition.contacts.push_back(contact);
  }
  return transition;
}

// The spans of a layout that are neutral become so in an edit of it.
void make_neutral(const NeutralSides& sides, LayoutEdit& edit) {
  for (std::size_t k = 0; k < edit.points.size(); ++k) {
    edit.points[k].neutral_before = sides.before[k];
    edit.points[k].neutral_behind = sides.behind[k];
  }
}

// Flat parts beside loose spans grow by a length, as the new ones do.
void grow_with_new_parts(const NeutralSides& sides, double length, LayoutEdit& edit) {
  for (std::size_t k = 0; k + 1 < edit.points.size(); ++k) {
    const bool is_part = edit.points[k].behind == Span::flat && edit.strands[k] == edit.strands[k + 1];
    const bool is_beside =
        (k > 0 && edit.strands[k - 1] == edit.strands[k] && sides.behind[k - 1]) ||
        (k + 2 < edit.points.size() && edit.strands[k + 2] == edit.strands[k] && sides.behind[k + 1]);
    if (!is_part || !is_beside) continue;
    edit.place(k) -= 0.5 * length;
    edit.place(k + 1) += 0.5 * length;
  }
}

// Whether the body arches off one obstacle between a point and the next one.
bool arches_behind(const SlidingState& at, std::size_t point) {
  return std::any_of(at.layout.segments().begin(), at.layout.segments().end(), [&](const auto& segment) {
    return segment.span == Span::free && segment.first_point == static_cast<Index>(point) &&
           at.layout.joins_one_obstacle(segment);
  });
}

// Where a new stretch lies about its point, and the force there: how much of either is the end's.
struct Shares {
  double length = 0.5, force = 0.5;
};

// Under a point load that it would arch over the body stays on the wall: there the point stays, and the stretch begins
// on its other side. So it does at a point of a spline that pushes, which an arch would enter. A pressed part begins
// where an arch ends: that stays as it is, and the force is that of the other side.
Shares shares_of_end(const SlidingSetting& setting, const SlidingState& at, std::size_t point, Span between,
                     double length) {
  constexpr Shares behind{.length = 1.0, .force = 0.0}, before{.length = 0.0, .force = 1.0};
  if (lies_by_itself(setting, at, point)) return {};
  if (between == Span::free) {
    const double here = at.s(static_cast<Index>(point));
    const Index strand = at.mesh.breakpoint(static_cast<Index>(point)).first;
    if (has_load_between(setting, strand, here, here + 0.5 * length)) return before;
    if (has_load_between(setting, strand, here - 0.5 * length, here)) return behind;
    const auto pushes = pushing_jump_beside(setting, at, point, 0.5 * length);
    if (!pushes) return {};
    const double away = *pushes / length;  // the force of the one point, in balance
    return *pushes < 0.0 ? Shares{.length = 1.0 + away, .force = -away} : Shares{.length = away, .force = 1.0 - away};
  }
  const bool ends_arch = point > 0 && arches_behind(at, point - 1), begins_arch = arches_behind(at, point);
  if (ends_arch == begins_arch) return {};
  return ends_arch ? Shares{.length = 1.0, .force = 1.0} : Shares{.length = 0.0, .force = 0.0};
}

// The half of such a stretch that begins at a plane of symmetry; the number of the point at its edge.
std::size_t spread_from(const SlidingSetting& setting, const SlidingState& at, const FreeEnd& end, Span between,
                        double length, bool may_be_neutral, LayoutEdit& edit) {
  const HeldAxis held = held_axis_at_end(setting, at, end);
  const double s = end.last ? setting.body.length(end.strand) - length : length;
  const std::size_t contact = contact_of(setting, at, end) - at.layout.points().size();
  const double load = presses_end(setting, at, end);
  if (lies_by_itself(setting, at, held))
    between = load > zero_force * setting.scales.force ? Span::pressed : Span::flat;
  const bool stays = between == Span::pressed;
  const bool neutral = may_be_neutral && is_neutral_from_plane(setting, at, end, length);
  const double force = setting.free_ends[contact].joined.empty() ? edit.end_forces[contact] : 0.0;
  edit.ends_closed[contact] = static_cast<std::uint8_t>(stays);
  edit.end_forces[contact] = stays ? std::max(load, 0.0) : 0.0;
  const int rest = edit.elements[static_cast<std::size_t>(end.strand)][edit.part_at(end.strand, s).place].elements;
  const bool straight = obstacle_is_straight(setting, at, held.touch);
  const int fewest = between == Span::pressed ? std::max(fewest_pressed(straight) / 2, 2) : 1;
  const int part = elements_asked(setting.body, end.strand, 0.0, length, fewest);
  const std::size_t edge = edit.insert({.point = {.obstacle = end.obstacle,
                                                  .behind = end.last ? between : Span::free,
                                                  .before = end.last ? Span::free : between,
                                                  .neutral_behind = !end.last && neutral,
                                                  .neutral_before = end.last && neutral},
                                        .strand = end.strand,
                                        .s = s,
                                        .closed = true,
                                        .force = force - edit.end_forces[contact]},
                                       end.last ? rest : part, end.last ? part : rest);
  friction_of_point_at(setting, at, contact_of(setting, at, end), s).give_to_point(edge, 1.0, edit);
  return edge;
}

// Each of the points, ascending, becomes two, a short way apart, and the half that is there of each point in a plane
// one; `neutral`: spans beside them that are then. Where the body lies by itself the part is flat, but for one with a
// point load inside, which is handed on as a pressed one does.
Transition spread(const SlidingSetting& setting, const SlidingState& at, const Points& points, const Planes& planes,
                  Span between, double length, const NeutralSides* neutral = nullptr, bool without_elements = false) {
  LayoutEdit edit = edit_of(setting.body, at);
  if (neutral != nullptr) {
    make_neutral(*neutral, edit);
    grow_with_new_parts(*neutral, length, edit);
  }
  for (auto k = points.rbegin(); k != points.rend(); ++k) {
    const int behind = edit.elements_behind(*k);
    const Shares end = shares_of_end(setting, at, *k, between, length);
    const double force = edit.forces[*k];
    edit.place(*k) -= (1.0 - end.length) * length;
    const double s = edit.place(*k);
    Span span = between;
    if (lies_by_itself(setting, at, *k))
      span = has_load_between(setting, edit.strands[*k], s, s + length) ? Span::pressed : Span::flat;
    const int between_them =
        span == Span::flat
            ? 1
            : elements_asked(setting.body, edit.strands[*k], s, s + length,
                             span == Span::pressed ? fewest_pressed(obstacle_is_straight(setting, at, *k)) : 2);
    edit.forces[*k] = (1.0 - end.force) * force;
    edit.insert({.point = edit.points[*k],
                 .strand = edit.strands[*k],
                 .s = s + length,
                 .closed = true,
                 .force = end.force * force},
                between_them, behind);
    edit.points[*k].behind = span;
    if (without_elements) edit.straighten_behind(*k);
    friction_of_point_at(setting, at, *k, s).give_to_point(*k, 1.0 - end.force, edit);
    friction_of_point_at(setting, at, *k, s + length).give_to_point(*k + 1, end.force, edit);
  }
  std::shared_ptr<const Observable> of_one;
  if (!points.empty()) of_one = std::make_shared<SpanLength>(points.front());
  for (auto end = planes.rbegin(); end != planes.rend(); ++end) {
    const std::size_t edge = spread_from(setting, at, *end, between, length, neutral != nullptr, edit);
    of_one = std::make_shared<TailLength>(edge, end->last ? setting.body.length(end->strand) : 0.0);
  }
  return with_spans(setting, at, points, edit, length, std::move(of_one), planes);
}

// A stretch about a point in which the pressure that would hold the body there changes its sign:
// pressed where that is positive, it arches off where it is negative, up to an edge that stays behind as a point.
struct HalfPressed {
  double from, lift_off, to;
  bool pressed_first;
};

// Whether the pressure that would hold the body on the wall changes its sign within a stretch about a point.
bool pressure_changes_sign(const SlidingSetting& setting, const SlidingState& at, std::size_t point, double length) {
  const HeldAxis held = held_axis(setting, at, point);
  const double before = required_pressure(setting, held, -0.5 * length);
  const double behind = required_pressure(setting, held, 0.5 * length);
  return std::min(before, behind) < 0.0 && std::max(before, behind) > 0.0;
}

// With the pressure p̄′ (S − S₀) the arch has EI g⁗ = −p̄′ (S − S₀), g = g′ = 0 at both ends and g″ = 0 where the part is
// pressed: 3/5 of it lie beyond S₀ (8.7a). Empty where the pressure has one sign, or a span would be too short.
std::optional<HalfPressed> half_pressed(const SlidingSetting& setting, const SlidingState& at, std::size_t point,
                                        double length) {
  constexpr double beyond = 0.6;
  if (!pressure_changes_sign(setting, at, point, length)) return std::nullopt;
  const HeldAxis held = held_axis(setting, at, point);
  const auto pressure = [&](double ahead) { return required_pressure(setting, held, ahead); };
  double pressed = -0.5 * length, free = 0.5 * length;
  if (pressure(pressed) < pressure(free)) std::swap(pressed, free);
  double edge = free;
  for (double a = pressed, b = free; std::abs(b - a) > 1e-6 * length;)
    (pressure(edge = 0.5 * (a + b)) > 0.0 ? a : b) = edge;
  const double lift_off = free - (free - edge) / beyond;
  const double sign = free > pressed ? 1.0 : -1.0, s = at.s(static_cast<Index>(point));
  const Index strand = at.mesh.breakpoint(static_cast<Index>(point)).first;
  const bool straight = obstacle_is_straight(setting, at, point);
  const double least_pressed =
      straight ? shortest_span_on_straight(setting.body, strand) : shortest_span(setting.body, strand);
  const double least_arch =
      2.0 * (straight ? shortest_sure_arch(setting, held_axis(setting, at, point), edge) : least_pressed);
  if (sign * (lift_off - pressed) < least_pressed || sign * (free - lift_off) < least_arch) return std::nullopt;
  return HalfPressed{
      .from = s - 0.5 * length, .lift_off = s + lift_off, .to = s + 0.5 * length, .pressed_first = free > pressed};
}

// Each of the points, ascending, becomes three; empty where the pressure beside one of them has one sign.
std::optional<Transition> spread_half_pressed(const SlidingSetting& setting, const SlidingState& at,
                                              const Points& points, double length) {
  LayoutEdit edit = edit_of(setting.body, at);
  double first_span = 0.0;
  for (auto k = points.rbegin(); k != points.rend(); ++k) {
    const auto stretch = half_pressed(setting, at, *k, length);
    if (!stretch) return std::nullopt;
    const Index strand = edit.strands[*k];
    const auto elements = [&](double from, double to, bool pressed) {
      return elements_asked(setting.body, strand, from, to,
                            pressed ? fewest_pressed(obstacle_is_straight(setting, at, *k)) : 2);
    };
    const int behind = edit.elements_behind(*k);
    const int first = elements(stretch->from, stretch->lift_off, stretch->pressed_first);
    const int second = elements(stretch->lift_off, stretch->to, !stretch->pressed_first);
    LayoutEdit::Entry end{.point = edit.points[*k], .strand = strand, .s = stretch->to, .closed = true};
    LayoutEdit::Entry middle = end;
    middle.s = stretch->lift_off;
    middle.point.behind = stretch->pressed_first ? Span::free : Span::pressed;
    edit.place(*k) = stretch->from;
    edit.forces[*k] *= 0.5;
    end.force = edit.forces[*k];
    edit.points[*k].behind = stretch->pressed_first ? Span::pressed : Span::free;
    edit.insert(middle, first, behind);
    edit.insert(end, second, behind);
    first_span = stretch->lift_off - stretch->from;
  }
  Transition transition =
      with_spans(setting, at, points, edit, first_span, std::make_shared<SpanLength>(points.front()));
  transition.least = 0.5 * first_span;  // its arch is at least twice the shortest there is
  return transition;
}

// Whether a stretch about a point is pressed, or arches off, from end to end, and no point load acts inside.
bool is_of_one_kind(const SlidingSetting& setting, const SlidingState& at, std::size_t point, double length) {
  const auto k = static_cast<Index>(point);
  const double s = at.s(k), half = 0.5 * length;
  return !pressure_changes_sign(setting, at, point, length) &&
         !has_load_between(setting, at.mesh.breakpoint(k).first, s - half, s + half);
}

// Of new parts: a quarter of an element. On a straight wall they may be shorter, and are where that keeps the pressure
// of one sign, so that no part is begun which has lifted off already, and point loads outside, which come in later.
double first_length(const SlidingSetting& setting, const SlidingState& at, const Points& points,
                    const HeldAxis& first) {
  const Index strand = first.touch.strand;
  const double length = 2.0 * shortest_span(setting.body, strand);
  const double least = 2.0 * shortest_span_on_straight(setting.body, strand);
  if (!obstacle_is_straight(setting, at, first.touch)) return length;
  for (double shorter = length; shorter >= least; shorter *= 0.5)
    if (std::all_of(points.begin(), points.end(),
                    [&](std::size_t k) { return is_of_one_kind(setting, at, k, shorter); }))
      return shorter;
  return length;
}

// Where the wall is straight and the body lies on it by itself, the part between is flat; else pressure holds it, or it
// arches off the wall. Where an axis that is not straight lies on a wall, or the pressure grows with the zone, longer
// pressed ones hold, shorter ones first: far from the change a longer one may be on a part of the path that is still to
// come, so that it must hold at a quarter of its length, too. At a plane of symmetry the pressure is as great before it
// as behind it, and has one sign there.
std::vector<Transition> spreads(const SlidingSetting& setting, const SlidingState& at, const Points& points,
                                const Planes& planes, bool is_neutral) {
  constexpr double shorter = 0.6, sure = 0.25;
  constexpr std::array factors{1.0, 2.0, 4.0, 8.0, 16.0};
  const std::vector<HeldAxis> held = held_axes(setting, at, points, planes);
  const double length = first_length(setting, at, points, held.front());
  if (!is_neutral && planes.empty() &&
      std::all_of(points.begin(), points.end(), [&](std::size_t k) { return lies_without_elements(setting, at, k); }))
    return {spread(setting, at, points, planes, Span::flat, 0.0, nullptr, true),
            spread(setting, at, points, planes, Span::flat, length, nullptr, true)};
  const auto is_all = [&](const auto& holds) { return std::all_of(held.begin(), held.end(), holds); };
  const auto lifts_off_straight = [&](const HeldAxis& axis) {
    return required_pressure_above_roundoff(setting, at, axis) < 0.0 &&
           obstacle_curvature(setting, at, axis.touch) == 0.0;
  };
  std::vector<Transition> transitions;
  const auto try_half_pressed = [&](double factor) {
    if (!planes.empty()) return;
    if (auto transition = spread_half_pressed(setting, at, points, factor * length))
      transitions.push_back(std::move(*transition));
  };
  const auto spread_to = [&](Span between, double factor) {
    transitions.push_back(spread(setting, at, points, planes, between, factor * length));
  };
  const bool changes_at_once = planes.empty() && std::all_of(points.begin(), points.end(), [&](std::size_t k) {
                                 return pressure_changes_sign(setting, at, k, length);
                               });
  const bool all_flat = is_all([&](const HeldAxis& axis) { return lies_by_itself(setting, at, axis); });
  const bool all_lift_off = is_all(lifts_off_straight);
  if (changes_at_once) std::for_each(factors.begin(), factors.end(), try_half_pressed);
  for (const double factor : factors) {
    if (!changes_at_once) try_half_pressed(factor);
    if (factor == 1.0) {
      spread_to(all_flat ? Span::flat : all_lift_off ? Span::free : Span::pressed, factor);
    } else if (!all_flat && !all_lift_off) {
      spread_to(Span::pressed, factor);
      transitions.back().least = std::max(1.0, sure * factor) * length;
    }
  }
  if (all_flat || all_lift_off) return transitions;
  spread_to(Span::free, 1.0);
  spread_to(Span::pressed, shorter);
  return transitions;
}

// The closed points that lose their curvature together.
Points points_without_curvature(const SlidingSetting& setting, const SlidingState& at, const Arrival& arrival) {
  Points points;
  for (const CurvatureBound* bound : reached<CurvatureBound>(setting, at, arrival))
    if (at.is_closed(bound->point())) points.push_back(bound->point());
  return points;
}

// The ends on planes of symmetry that do so.
Planes planes_without_curvature(const SlidingSetting& setting, const SlidingState& at, const Arrival& arrival) {
  Planes planes;
  for (const ClampBound* bound : reached<ClampBound>(setting, at, arrival))
    if (setting.body.is_on_plane(bound->strand(), bound->last()))
      planes.push_back(touched_clamp(setting, at, bound->strand(), bound->last()).value());
  return planes;
}

// A structure that is symmetric but for what hardly counts, as soft springs do, has points that lose their curvature so
// soon after each other that none is found between: all of them may spread then.
std::vector<Transition> spreads_with_those_near(const SlidingSetting& setting, const SlidingState& at,
                                                const Points& points, const Planes& planes, const Arrival& arrival,
                                                bool is_neutral) {
  std::vector<Transition> transitions = spreads(setting, at, points, planes, is_neutral);
  const Points all = points_without_curvature(
      setting, at, {.forward = arrival.forward, .tolerance = reached_in_weak_asymmetry, .at_hand = arrival.at_hand});
  if (all.size() > points.size())
    for (Transition& transition : spreads(setting, at, all, planes, is_neutral))
      transitions.push_back(std::move(transition));
  transitions.push_back(unsupported(why_none_spreads(setting, at, points, planes)));
  return transitions;
}

// Whether the body is straight from a point to the next one.
bool is_straight_behind(const SlidingState& at, std::size_t point) {
  const auto [strand, first] = at.mesh.breakpoint(static_cast<Index>(point));
  const Index last = at.mesh.breakpoint(static_cast<Index>(point + 1)).second;
  const double angle = at.mesh.node(strand, first, at.now).angle;
  for (Index position = first + 1; position <= last; ++position)
    if (!(std::abs(at.mesh.node(strand, position, at.now).angle - angle) <= nearly_straight)) return false;
  return true;
}

// As what the body comes to lie on a straight wall behind a point, up to the next one, where it was free between them:
// it is pressed there as a load along it that λ drives vanishes; flat where nothing acts on it, as the buckle of a flat
// part goes back to nothing at k d = 2π. Empty where it does not.
std::optional<Span> lies_down_as(const SlidingSetting& setting, const SlidingState& at, std::size_t point) {
  const auto is_behind = [&](const SlidingContactLayout::Segment& segment) {
    return segment.span == Span::free && segment.first_point == static_cast<Index>(point) &&
           segment.last_point == static_cast<Index>(point + 1) && at.layout.joins_one_obstacle(segment) &&
           obstacle_is_straight(setting, at, point, at.s(segment.last_point) - at.s(segment.first_point));
  };
  if (std::none_of(at.layout.segments().begin(), at.layout.segments().end(), is_behind)) return std::nullopt;
  if (required_pressure_rate_above_roundoff(setting, at, point) != 0.0) return Span::pressed;
  const bool by_itself = lies_by_itself(setting, at, point) && lies_by_itself(setting, at, point + 1);
  return by_itself && is_straight_behind(at, point) ? std::optional(Span::flat) : std::nullopt;
}

// An arch between a point and a plane of symmetry, at which the body is off its obstacle.
struct HalfArch {
  std::size_t point, contact;  // at its end, and of the end on the plane
  bool last;
};

// The arches to planes that a load which λ drives lets go of all along, and which come to lie as it vanishes.
std::vector<HalfArch> half_arches_lying_down(const SlidingSetting& setting, const SlidingState& at,
                                             const Points& points) {
  std::vector<HalfArch> found;
  for (const std::size_t k : points)
    for (const bool last : {false, true}) {
      const Index strand = at.mesh.breakpoint(static_cast<Index>(k)).first;
      const StrandEnd of{.strand = strand, .last = last};
      const auto end = setting.number_of_end(of, at.layout.points()[k].obstacle);
      if (!end || at.layout.point_at_end(strand, last) != k || at.layout.span_at_end(strand, last) != Span::free)
        continue;
      const std::size_t contact = at.layout.points().size() + *end;
      const double far = (last ? setting.body.length(strand) : 0.0) - at.s(static_cast<Index>(k));
      if (is_tangent_at_plane(setting, at, setting.free_ends[*end].seen_from(of)) && !at.is_closed(contact) &&
          obstacle_is_straight(setting, at, k, far) && required_pressure_rate_above_roundoff(setting, at, k) != 0.0)
        found.push_back({.point = k, .contact = contact, .last = last});
    }
  return found;
}

// Free spans between two of the points, or from one to a plane, on which the body comes to lie from one to the other.
// Empty where there are none.
std::optional<Transition> spans_lie_down(const SlidingSetting& setting, const SlidingState& at, const Points& points,
                                         const Direction& forward) {
  constexpr int fewest_of_buckling = 8;  // elements of a flat part that may buckle
  std::vector<std::pair<std::size_t, Span>> lying;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    if (const auto span = lies_down_as(setting, at, points[i])) lying.emplace_back(points[i], *span);
  const std::vector<HalfArch> halves = half_arches_lying_down(setting, at, points);
  if (lying.empty() && halves.empty()) return std::nullopt;
  Transition transition = remeshed(setting, at, forward, [&](LayoutEdit& edit, const SlidingState&) {
    for (const auto& [k, span] : lying) {
      edit.points[k].behind = span;
      int& elements = edit.elements_behind(k);
      elements = std::max(elements, span == Span::flat ? fewest_of_buckling : fewest_pressed(true));
    }
    for (const auto& [k, contact, last] : halves) {
      (last ? edit.points[k].behind : edit.points[k].before) = Span::pressed;
      int& elements = last ? edit.elements_behind(k) : edit.elements_before(k);
      elements = std::max(elements, fewest_pressed(true));
      edit.ends_closed[contact - at.layout.points().size()] = 1;
    }
  });
  transition.change = Transition::Change::spreads;
  for (const auto& [k, span] : lying) {
    if (span == Span::flat) transition.from_singular = true;  // the part is at its buckling load
    for (const std::size_t point : {k, k + 1}) transition.contacts.push_back(static_cast<Index>(point));
  }
  for (const HalfArch& half : halves) transition.contacts.push_back(static_cast<Index>(half.point));
  return transition;
}

}  // namespace

std::vector<Transition> zones_or_arches_from_points(const SlidingSetting& setting, const SlidingState& at,
                                                    const Arrival& arrival) {
  if (auto zones = zones_leave_joints(setting, at, arrival); !zones.empty()) return zones;
  const Points points = points_without_curvature(setting, at, arrival);
  const Planes planes = planes_without_curvature(setting, at, arrival);
  if (points.size() == 1 && planes.empty())
    if (auto touches = tip_touches_with(setting, at, points.front()))
      return {std::move(*touches),
              unsupported("a free end and the contact zone beside it touch at once, but no equilibrium was found")};
  const std::vector<HeldAxis> held = held_axes(setting, at, points, planes);
  Index lines =
      std::count_if(held.begin(), held.end(), [&](const HeldAxis& axis) { return lies_by_itself(setting, at, axis); });
  const bool new_lines = lines > 0;
  const auto& segments = at.layout.segments();
  lines += std::count_if(segments.begin(), segments.end(), is_flat_between_points);
  const double length = 2.0 * shortest_span(setting.body, held.front().touch.strand);
  const NeutralSides neutral = spans_made_neutral(setting, at, points, 0.5 * length);
  const bool is_neutral = neutral.any() || std::any_of(planes.begin(), planes.end(), [&](const FreeEnd& end) {
                            return is_neutral_from_plane(setting, at, end, length);
                          });
  const bool is_continuum = new_lines && neutral.between_points(at.layout) > 0;
  const Continuum common = continuum_of(at, lines);
  if (is_continuum && setting.continuum == ContinuumChoice::stop) return {end_before(common)};
  std::vector<Transition> transitions;
  if (is_continuum) {
    transitions.push_back(end_before(common));
  } else {
    transitions = spreads_with_those_near(setting, at, points, planes, arrival, is_neutral);
    if (auto lie_down = spans_lie_down(setting, at, points, arrival.forward)) {
      // A part that has just begun to buckle is straight, too: a flat one is the last that is tried.
      const bool is_flat = lie_down->from_singular;
      transitions.insert(is_flat ? transitions.end() - 1 : transitions.begin(), std::move(*lie_down));
    }
  }
  if (!is_neutral) return transitions;
  transitions.insert(transitions.begin(), spread(setting, at, points, planes, Span::flat, length, &neutral));
  if (is_continuum) transitions.front().continuum = common;
  for (Transition& transition : transitions) transition.from_singular = true;
  return transitions;
}

}  // namespace arcwall::sliding
