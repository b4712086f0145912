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
#include "contact/sliding/tolerances.hpp"
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

// Gives up open points that follow least gaps with other obstacles and beside which there is no room for a point: what
// is touched now comes first.
void give_up_beside(const MaterialPoint& place, std::size_t obstacle, LayoutEdit& edit) {
  constexpr double room = 0.75;  // in elements; a point beside another one is given up at half an element
  for (std::size_t k = edit.points.size(); k-- > 0;) {
    const SlidingContactLayout::Point& point = edit.points[k];
    if (edit.strands[k] != place.strand || edit.closed[k] != 0 || point.is_pinched() || point.obstacle == obstacle)
      continue;
    const double from = std::min(place.s, edit.place(k)), to = std::max(place.s, edit.place(k));
    if (edit.body.elements_between(place.strand, from, to) <= room) edit.erase(k, edit.elements_without(k));
  }
}

// Whether the strands of two edits of one layout are divided at the same nodes.
bool are_divided_alike(const LayoutEdit& one, const LayoutEdit& other) {
  const auto same_end = [](const MeshSegment& a, const MeshSegment& b) { return a.load == b.load; };
  const auto same_ends = [&](const std::vector<MeshSegment>& a, const std::vector<MeshSegment>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), same_end);
  };
  return std::equal(one.elements.begin(), one.elements.end(), other.elements.begin(), other.elements.end(), same_ends);
}

// Whether an inserted point would be given up at once: its least gap is shallow, or it is cramped beside the end of the
// member, a load or a contact with another wall. What has been given up near a free or hinged end must not be inserted
// there again, where another mesh has it a little farther away.
bool is_unfit(const SlidingSetting& setting, const State& state, std::size_t point) {
  const SlidingState at(state);
  return std::any_of(at.layout.bounds().begin(), at.layout.bounds().end(), [&](const auto& bound) {
    const auto* curvature = as<CurvatureBound>(*bound);
    const auto* room = as<RoomBound>(*bound);
    const auto* tail = as<TailBound>(*bound);
    const bool is_its_own = (curvature && curvature->point() == point) || (tail && tail->point() == point) ||
                            (room && room->is_beside(at.layout, static_cast<Index>(point)));
    return is_its_own && bound->value(setting, at) <= (tail ? between_meshes : 0.0);
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

// With a point at one least gap that is violated at the end of a step; empty where it cannot be one.
std::optional<Transition> with_point_at(const SlidingSetting& setting, const SlidingState& from,
                                        const Direction& forward, const LeastGap& violated) {
  const Index strand = violated.at.strand;
  const auto start = nearest_least_gap(setting, from, violated);
  const double nearby = 0.25 * setting.body.length(strand);
  if (!start || std::abs(start->at.s - violated.at.s) > nearby) return std::nullopt;
  if (is_followed(setting, from, *start)) return std::nullopt;
  if (is_at_sharp_corner(setting, from, *start)) return std::nullopt;
  std::size_t point = 0;
  Transition transition = remeshed(setting, from, forward, [&](LayoutEdit& edit, const SlidingState& at) {
    // The point follows the least gap, which may move along the member much faster than the body moves.
    const double s = nearest_least_gap(setting, at, violated).value_or(*start).at.s;
    take_nodes_beside(start->at, edit);
    give_up_beside(start->at, start->obstacle, edit);
    const int undivided = edit.undivided_at(strand, s);
    point = edit.insert({.point = {.obstacle = start->obstacle, .undivided = undivided}, .strand = strand, .s = s},
                        undivided, undivided);
    divide_beside_waiting(edit);
  });
  if (is_unfit(setting, transition.guess.get(), point)) return std::nullopt;
  return transition;
}

}  // namespace

// At the deepest least gap where a point can be: one that has none, as beside an end that touches, hides no other.
std::optional<Transition> with_inserted_contact(const SlidingSetting& setting, const SlidingState& from,
                                                const Direction& forward, const SlidingState& to, double margin) {
  for (const LeastGap& violated : unwatched_gaps(setting, to, margin))
    if (auto transition = with_point_at(setting, from, forward, violated)) return transition;
  return std::nullopt;
}

namespace {

// The points that wait for their first touch and touch together with one of them.
std::vector<std::size_t> touched_with(const SlidingSetting& setting, const SlidingState& at, std::size_t point) {
  std::vector<std::size_t> touched;
  for (std::size_t k = 0; k < at.layout.points().size(); ++k) {
    if (!at.layout.points()[k].waits()) continue;
    const double gap = face_gap(setting, touch_of_contact(setting, at.layout, k), at);
    if (k == point || gap <= touching_on_path * setting.scales.length) touched.push_back(k);
  }
  return touched;
}

}  // namespace

// The numbers are those that the touch finds, from wherever it has been foreseen.
std::optional<Transition> with_mesh_for_touch(const SlidingSetting& setting, const SlidingState& from,
                                              const Direction& forward, const SlidingState& to, Index guard) {
  const auto point = static_cast<std::size_t>(guard);
  if (guard >= from.index.points || from.is_closed(point) || !from.layout.points()[point].waits()) return std::nullopt;
  const std::vector<std::size_t> touched = touched_with(setting, to, point);
  LayoutEdit there = edit_of(setting.body, to);
  divide_beside_waiting(there);
  for (const std::size_t k : touched) there.touch(k);
  divide_evenly(there);
  const LayoutEdit here = edit_of(setting.body, from);
  if (there.elements == here.elements || !are_divided_alike(there, here)) return std::nullopt;
  return remeshed(setting, from, forward, [&](LayoutEdit& edit, const SlidingState&) {
    edit.elements = there.elements;
    edit.points = there.points;
  });
}

}  // namespace arcwall::sliding
