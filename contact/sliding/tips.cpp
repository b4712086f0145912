#include "contact/sliding/tips.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "contact/sliding/bending.hpp"
#include "contact/sliding/bound_value.hpp"
#include "contact/sliding/bounds/curvature.hpp"
#include "contact/sliding/bounds/free_end.hpp"
#include "contact/sliding/bounds/tail.hpp"
#include "contact/sliding/remeshing.hpp"
#include "contact/sliding/span_length.hpp"
#include "contact/sliding/spans.hpp"

namespace arcwall::sliding {

namespace {

using Span = SlidingContactLayout::Span;
using Change = Transition::Change;

// A free end with a closed contact: its number among the free ends, and what is there.
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

// By what the last element carries: its end force is that of the contact and of all that is put on the tip.
ClosedTip closed_tip(const SlidingSetting& setting, const SlidingState& at, std::size_t end) {
  constexpr double round_off = 1e-6;  // of curvatures, times the length scale
  const std::size_t contact = at.layout.points().size() + end;
  const auto [strand, last, obstacle, along_rest] = setting.free_ends[end];
  const Touch touch = touch_of_contact(setting, at.layout, contact);
  const AxisPlace axis = touch.axis(at);
  const Obstacle& surface = *setting.obstacles[obstacle].surface;
  const Vec2 place = face(touch.offset, axis), t(std::cos(axis.angle), std::sin(axis.angle));
  const Eigen::Vector3d carried = at.mesh.end_forces(strand, last ? touch.position - 1 : 0, at.now)[last ? 1 : 0];
  const double sign = last ? 1.0 : -1.0, lambda = at.now.lambda, s = last ? setting.body.length(strand) : 0.0;
  const double curvature = setting.body.natural_curvature({.strand = strand, .s = s}, lambda) +
                           sign * carried[2] / setting.body.bending_stiffness(strand);
  const double stretch = 1.0 + setting.body.free_strain(strand, lambda).value +
                         sign * carried.head<2>().dot(t) / setting.body.axial_stiffness(strand);
  const double wall = surface.curvature(place, lambda).value;
  ClosedTip tip{.end = end, .strand = strand, .last = last, .obstacle = obstacle, .force = at.force(contact)};
  tip.load = tip.force - carried.head<2>().dot(surface.normal(place, lambda));
  tip.bend = sign_of(surface.side()) *
             (travel(surface, place, axis.angle, lambda) * curvature - stretch * wall / (1.0 + touch.offset * wall));
  tip.bends_with_it = std::abs(tip.bend) * setting.scales.length <= round_off;
  return tip;
}

// Tips with a stretch of some length between each and a new point, which runs as `spans` says.
Transition with_points_inside(const SlidingSetting& setting, const SlidingState& at, const std::vector<ClosedTip>& tips,
                              const std::vector<Span>& spans, double length) {
  constexpr double round_off = 1e-9;  // of forces
  LayoutEdit edit = edit_of(setting.body, at);
  for (std::size_t i = 0; i < tips.size(); ++i) {
    const auto& [end, strand, last, obstacle, force, load, bend, bends_with_it] = tips[i];
    const double s = last ? setting.body.length(strand) - length : length;
    const bool stays = spans[i] == Span::pressed || (spans[i] == Span::flat && load > round_off * setting.scales.force);
    edit.ends_closed[end] = static_cast<std::uint8_t>(stays);
    edit.end_forces[end] = stays ? std::max(load, 0.0) : 0.0;
    const int rest = edit.elements[static_cast<std::size_t>(strand)][edit.part_at(strand, s).place].elements;
    const int tail = spans[i] == Span::pressed ? 2 : 1;
    edit.insert({.point = {.obstacle = obstacle,
                           .behind = last ? spans[i] : Span::free,
                           .before = last ? Span::free : spans[i]},
                 .strand = strand,
                 .s = s,
                 .closed = true,
                 .force = force - edit.end_forces[end]},
                last ? rest : tail, last ? tail : rest);
  }
  const auto on = layout_of(edit);
  const ClosedTip& first = tips.front();
  const std::size_t point = on->point_at_end(first.strand, first.last).value();
  const double coordinate = first.last ? setting.body.length(first.strand) : 0.0;
  Transition transition =
      up_to(length, std::make_shared<TailLength>(point, coordinate),
            spans.front() == Span::free ? Change::passes : Change::spreads, mapped_onto(setting, at, edit, on));
  for (const ClosedTip& tip : tips)
    transition.contacts.push_back(static_cast<Index>(at.layout.points().size() + tip.end));
  return transition;
}

// How the body may run behind a tip that bends as its obstacle does, by what would hold it there.
std::vector<Span> lying_spans(const SlidingSetting& setting, const Transition& free, const ClosedTip& tip) {
  const SlidingState guess(free.guess);
  const std::size_t point = guess.layout.point_at_end(tip.strand, tip.last).value();
  if (lies_by_itself(setting, guess, point)) return {Span::flat};
  const bool lifts_off = holding_pressure(setting, guess, point) < 0.0;
  return lifts_off ? std::vector{Span::free, Span::pressed} : std::vector{Span::pressed, Span::free};
}

}  // namespace

std::vector<Transition> tips_lie_down(const SlidingSetting& setting, const SlidingState& at, double tolerance) {
  const Transition none =
      unsupported("the free end of a member lies down on a wall, and no equilibrium was found there");
  std::vector<ClosedTip> tips;
  for (const LiesDownBound* bound : reached<LiesDownBound>(setting, at, tolerance))
    for (std::size_t end = 0; end < setting.free_ends.size(); ++end) {
      const FreeEnd& there = setting.free_ends[end];
      if (there.strand != bound->strand() || there.last != bound->last()) continue;
      if (!at.is_closed(at.layout.points().size() + end)) continue;
      if (!setting.body.is_tip(there.strand, there.last))
        return {unsupported("a joint of members lies down on a wall")};
      tips.push_back(closed_tip(setting, at, end));
    }
  if (tips.empty()) return {none};
  const double length = 2.0 * shortest_tail(setting.body, tips.front().strand);
  const Transition free = with_points_inside(setting, at, tips, std::vector(tips.size(), Span::free), length);
  std::vector<std::vector<Span>> ways;
  for (const ClosedTip& tip : tips) {
    if (!tip.bends_with_it && tip.bend < 0.0) return {none};
    ways.push_back(tip.bends_with_it ? lying_spans(setting, free, tip) : std::vector{Span::free});
  }
  std::vector<Transition> transitions;
  for (std::size_t way = 0; way < 2; ++way) {
    std::vector<Span> spans;
    for (const std::vector<Span>& of_tip : ways) spans.push_back(of_tip[std::min(way, of_tip.size() - 1)]);
    for (const double factor : {1.0, 4.0})
      transitions.push_back(with_points_inside(setting, at, tips, spans, factor * length));
  }
  transitions.push_back(none);
  return transitions;
}

std::vector<Transition> contacts_come_to_tips(const SlidingSetting& setting, const SlidingState& at, double tolerance) {
  std::vector<const TailBound*> tails;
  for (const TailBound* bound : reached<TailBound>(setting, at, tolerance))
    if (at.is_closed(bound->point())) tails.push_back(bound);
  LayoutEdit edit = edit_of(setting.body, at);
  std::vector<std::size_t> ends;
  bool lay = false;
  for (auto tail = tails.rbegin(); tail != tails.rend(); ++tail) {
    const std::size_t point = (*tail)->point();
    const auto [strand, last] = std::pair((*tail)->strand(), (*tail)->last());
    const Span inner = last ? at.layout.span_before(point) : at.layout.points()[point].behind;
    if (inner != Span::free) return {unsupported("a part that lies on a wall reached the free end of its member")};
    lay = lay || at.layout.span_at_end(strand, last) != Span::free;
    std::size_t end = 0;
    while (setting.free_ends[end].strand != strand || setting.free_ends[end].last != last ||
           setting.free_ends[end].obstacle != at.layout.points()[point].obstacle)
      ++end;
    ends.push_back(end);
    edit.end_forces[end] += edit.forces[point];
    edit.ends_closed[end] = 1;
    edit.erase(point, last ? edit.elements_before(point) : edit.elements_behind(point));
  }
  const auto on = layout_of(edit);
  State guess = mapped_onto(setting, at, edit, on);
  const std::size_t lies_down = bound_number<LiesDownBound>(*on, [&](const LiesDownBound& bound) {
    return bound.strand() == tails.back()->strand() && bound.last() == tails.back()->last();
  });
  Transition transition = up_to(0.0, std::make_shared<BoundValue>(setting, lies_down),
                                lay ? Change::gathers : Change::passes, std::move(guess));
  for (const std::size_t end : ends) transition.contacts.push_back(static_cast<Index>(on->points().size() + end));
  return {transition, unsupported("contact came to the free end of a member, and no equilibrium was found there")};
}

std::optional<Transition> tip_touches_with(const SlidingSetting& setting, const SlidingState& at, std::size_t point) {
  constexpr double touching = 1e-8;  // gap at the tip, scaled
  const std::size_t points = at.layout.points().size(), obstacle = at.layout.points()[point].obstacle;
  for (std::size_t end = 0; end < setting.free_ends.size(); ++end) {
    const FreeEnd& tip = setting.free_ends[end];
    if (tip.obstacle != obstacle || at.is_closed(points + end) || !setting.body.is_tip(tip.strand, tip.last)) continue;
    if (at.layout.point_at_end(tip.strand, tip.last) != point) continue;
    if (at.layout.span_at_end(tip.strand, tip.last) != Span::free) continue;
    const double gap = face_gap(setting, touch_of_contact(setting, at.layout, points + end), at);
    if (!(std::abs(gap) <= touching * setting.scales.length)) continue;
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
