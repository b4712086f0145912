#include "contact/sliding/inserted_contact.hpp"

#include <algorithm>
#include <cmath>

#include "contact/sliding/bounds/curvature.hpp"
#include "contact/sliding/bounds/room.hpp"
#include "contact/sliding/bounds/tail.hpp"
#include "contact/sliding/least_gaps.hpp"
#include "contact/sliding/pinches.hpp"
#include "contact/sliding/remeshing.hpp"
#include "contact/sliding/spans.hpp"
#include "contact/sliding/touch.hpp"

namespace arcwall::sliding {

namespace {

// Whether a point of the layout follows a least gap already.
bool is_followed(const SlidingSetting& setting, const SlidingState& at, const LeastGap& gap) {
  for (std::size_t k = 0; k < at.layout.points().size(); ++k) {
    const auto point = static_cast<Index>(k);
    if (touches(setting, at.layout, k, gap.obstacle) && at.mesh.breakpoint(point).first == gap.at.strand &&
        std::abs(at.s(point) - gap.at.s) < shortest_span(setting.body, gap.at.strand))
      return true;
  }
  return false;
}

// Takes the nodes of loads beside which there is no room for a point.
void take_nodes_beside(const MaterialPoint& place, LayoutEdit& edit) {
  const std::vector<double>& loads = edit.body.point_loads(place.strand);
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const auto load = static_cast<Index>(i);
    const double from = std::min(place.s, loads[i]), to = std::max(place.s, loads[i]);
    if (edit.has_node(place.strand, load) && edit.body.elements_between(place.strand, from, to) <= nearest_node_of_load)
      edit.take_node(place.strand, load);
  }
}

// How many elements a part has before and behind a point.
struct Elements {
  int before, behind;
};

double elements_up_to(const LayoutEdit::Part& part, double place, int elements) {
  return elements * (place - part.from) / (part.to - part.from);
}

// Of a part of so many elements, as a place divides it, which is known nearly.
Elements divided(const LayoutEdit::Part& part, double place, int elements) {
  const double before = elements_up_to(part, place, elements);
  const int first = std::clamp(static_cast<int>(std::lround(before - 1e-3)), 1, elements - 1);
  return {.before = first, .behind = elements - first};
}

// Of a part in which a point is inserted, by where this will touch, roughly.
Elements elements_beside(const LayoutEdit& edit, const LeastGap& start, const LeastGap& violated) {
  const double fallen = start.gap - violated.gap;
  const double fraction = fallen > 0.0 ? std::clamp(start.gap / fallen, 0.0, 2.0) : 0.0;
  const double touch = start.at.s + fraction * (violated.at.s - start.at.s);
  const Index strand = start.at.strand;
  const LayoutEdit::Part part = edit.part_at(strand, start.at.s);
  const int elements = std::max(2, edit.elements[static_cast<std::size_t>(strand)][part.place].elements);
  const auto [before, behind] = divided(part, touch, elements);
  return {.before = std::max(before, fewest_elements(edit.body, strand, part.from, start.at.s)),
          .behind = std::max(behind, fewest_elements(edit.body, strand, start.at.s, part.to))};
}

// So that parts are alike which are so where the point touches, from wherever that is foreseen.
void take_elements_of(const LayoutEdit& ahead, LayoutEdit& edit) {
  const auto same_end = [](const MeshSegment& a, const MeshSegment& b) { return a.load == b.load; };
  for (std::size_t strand = 0; strand < edit.elements.size(); ++strand) {
    const std::vector<MeshSegment>& there = ahead.elements[strand];
    std::vector<MeshSegment>& here = edit.elements[strand];
    if (!std::equal(there.begin(), there.end(), here.begin(), here.end(), same_end)) continue;
    for (std::size_t i = 0; i < here.size(); ++i) here[i].elements = there[i].elements;
  }
}

// Whether an inserted point would be given up at once: its least gap is shallow, or it is cramped beside the end of the
// member, a load or a contact with another wall. What has been given up near a tip must not be inserted there again,
// where another mesh has it a little farther away.
bool is_unfit(const SlidingSetting& setting, const State& state, std::size_t point) {
  constexpr double between_meshes = 1e-5;  // of the length scale
  const SlidingState at(state);
  return std::any_of(at.layout.bounds().begin(), at.layout.bounds().end(), [&](const auto& bound) {
    const auto* curvature = dynamic_cast<const CurvatureBound*>(bound.get());
    const bool is_its_own = curvature != nullptr && curvature->point() == point;
    const bool is_room = dynamic_cast<const RoomBound*>(bound.get()) != nullptr;
    const bool is_tail = dynamic_cast<const TailBound*>(bound.get()) != nullptr;
    if (!is_its_own && !is_room && !is_tail) return false;
    return bound->value(setting, at) <= (is_tail ? between_meshes : 0.0);
  });
}

// Whether what is nearest to a least gap is a sharp corner, around which the body would turn at a point of its axis.
bool is_at_sharp_corner(const SlidingSetting& setting, const SlidingState& at, const LeastGap& gap) {
  const Obstacle& surface = *setting.obstacles[gap.obstacle].surface;
  const std::vector<SharpCorner> corners = surface.sharp_corners();
  const Vec2 place = face(setting.face_offset(gap.obstacle, gap.at.strand), at.mesh.place(gap.at, at.now));
  return std::any_of(corners.begin(), corners.end(), [&](const SharpCorner& corner) {
    const Vec2 arm = place - corner.place;
    return corner.before.dot(arm) >= 0.0 && corner.behind.dot(arm) <= 0.0;
  });
}

}  // namespace

std::optional<Transition> with_inserted_contact(const SlidingSetting& setting, const SlidingState& from,
                                                const Direction& forward, const SlidingState& to, double margin) {
  const auto violated = deepest_unwatched(setting, to, margin);
  if (!violated) return std::nullopt;
  const Index strand = violated->at.strand;
  const auto start = nearest_least_gap(setting, from, *violated);
  const double nearby = 0.25 * setting.body.length(strand);
  if (!start || std::abs(start->at.s - violated->at.s) > nearby) return std::nullopt;
  if (is_followed(setting, from, *start)) return std::nullopt;
  if (is_at_sharp_corner(setting, from, *start)) return std::nullopt;
  LayoutEdit before = edit_of(setting.body, from);
  take_nodes_beside(start->at, before);
  const auto elements = elements_beside(before, *start, *violated);
  LayoutEdit ahead = edit_of(setting.body, to);  // nearly where the point touches
  take_nodes_beside(violated->at, ahead);
  ahead.insert({.point = {.obstacle = start->obstacle}, .strand = strand, .s = violated->at.s}, elements.before,
               elements.behind);
  divide_evenly(ahead);
  std::size_t point = 0;
  Transition transition = remeshed(setting, from, forward, [&](LayoutEdit& edit, const SlidingState& at) {
    // The point follows the least gap, which may move along the member much faster than the body moves.
    const double s = nearest_least_gap(setting, at, *violated).value_or(*start).at.s;
    take_nodes_beside(start->at, edit);
    point = edit.insert({.point = {.obstacle = start->obstacle}, .strand = strand, .s = s}, elements.before,
                        elements.behind);
    take_elements_of(ahead, edit);
  });
  if (is_unfit(setting, transition.guess, point)) return std::nullopt;
  return transition;
}

namespace {

// The two segments beside a point as one.
struct DividedPart {
  Index strand;
  LayoutEdit::Part all;
  double point;          ///< its place
  int elements, before;  ///< of both, and before the point
};

DividedPart part_with(LayoutEdit edit, std::size_t point) {
  const Index strand = edit.strands[point];
  const double place = edit.place(point);
  const int before = edit.elements_before(point), elements = before + edit.elements_behind(point);
  edit.erase(point, elements);
  return {.strand = strand, .all = edit.part_at(strand, place), .point = place, .elements = elements, .before = before};
}

}  // namespace

// Points that have slid farther keep the elements that they came with.
std::optional<Transition> with_mesh_for_touch(const SlidingSetting& setting, const SlidingState& from,
                                              const Direction& forward, const SlidingState& to, Index guard) {
  constexpr double rounding = 0.52, most = 1.5;  // elements between what a point has before it and what it should
  const auto point = static_cast<std::size_t>(guard);
  if (guard >= from.index.points || from.is_closed(point)) return std::nullopt;
  const SlidingContactLayout& on = from.layout;
  if (on.span_before(point) != SlidingContactLayout::Span::free ||
      on.points()[point].behind != SlidingContactLayout::Span::free)
    return std::nullopt;
  const DividedPart here = part_with(edit_of(setting.body, from), point),
                    there = part_with(edit_of(setting.body, to), point);
  const double off = std::abs(elements_up_to(there.all, there.point, there.elements) - there.before);
  if (off <= rounding || off >= most) return std::nullopt;
  const Elements divided_there = divided(there.all, there.point, there.elements);
  if (divided_there.before == here.before ||
      divided_there.before < fewest_elements(setting.body, here.strand, here.all.from, here.point) ||
      divided_there.behind < fewest_elements(setting.body, here.strand, here.point, here.all.to))
    return std::nullopt;
  LayoutEdit at_touch = edit_of(setting.body, to);
  at_touch.elements_before(point) = divided_there.before;
  at_touch.elements_behind(point) = divided_there.behind;
  divide_evenly(at_touch);
  if (at_touch.elements_before(point) != divided_there.before ||
      at_touch.elements_behind(point) != divided_there.behind)
    return std::nullopt;  // one of them is like another part there
  return remeshed(setting, from, forward, [&](LayoutEdit& changed, const SlidingState&) {
    changed.elements_before(point) = divided_there.before;
    changed.elements_behind(point) = divided_there.behind;
  });
}

}  // namespace arcwall::sliding
