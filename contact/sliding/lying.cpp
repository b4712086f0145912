#include "contact/sliding/lying.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "contact/sliding/bending.hpp"
#include "contact/sliding/layout_edit.hpp"
#include "contact/sliding/pressed_part.hpp"
#include "contact/sliding/remeshing.hpp"
#include "contact/sliding/span_length.hpp"
#include "contact/sliding/spans.hpp"

namespace arcwall::sliding {

namespace {

using Span = SlidingContactLayout::Span;

constexpr std::array<bool, 2> both_ends{false, true};

TouchGap touch_at_end(const SlidingSetting& setting, const SlidingState& at, Index strand, bool last,
                      std::size_t obstacle) {
  return touch_gap(setting, touch_of_end(setting, at.layout, {.strand = strand, .last = last, .obstacle = obstacle}),
                   at);
}

// Whether λ, going from 0 towards a value, turns a clamped end of a strand against its obstacle, or moves an end and
// the obstacle into each other. An end that leaves the obstacle peels off.
bool is_driven_into(const SlidingSetting& setting, const SlidingState& at, Index strand, std::size_t obstacle,
                    double toward) {
  return std::any_of(both_ends.begin(), both_ends.end(), [&](bool last) {
    const TouchGap touch = touch_at_end(setting, at, strand, last, obstacle);
    const bool on_plane = setting.body.is_on_plane(strand, last);
    if (setting.body.is_tip(strand, last)) return false;
    return (!on_plane && touch.gap.rate * toward < 0.0) ||
           ((on_plane || setting.body.is_clamped(strand, last)) && touch.tilt.rate != 0.0);
  });
}

// Whether a strand may be held on an obstacle from end to end at all.
bool may_lie(const SlidingSetting& setting, const SlidingState& at, Index strand, std::size_t obstacle, double toward) {
  const SlidingBody& body = setting.body;
  for (const bool last : both_ends)
    if (!body.is_tip(strand, last) && !body.is_hinged(strand, last) && !body.is_clamped(strand, last) &&
        !body.is_on_plane(strand, last))
      return false;
  return setting.obstacles[obstacle].concerns(strand) && !is_driven_into(setting, at, strand, obstacle, toward);
}

// Where a strand runs straight along an obstacle, within `touching` of the length scale and of an angle.
class Alongside {
 public:
  Alongside(const SlidingSetting& setting, const SlidingState& at, Index strand, std::size_t obstacle, double touching)
      : setting_(setting),
        at_(at),
        strand_(strand),
        obstacle_(obstacle),
        touching_(touching),
        surface_(*setting.obstacles[obstacle].surface) {}

  bool at_node(Index position) const {
    const Vec2 here = face_of(position);
    return touches(here) && is_flush_at(surface_, here, at_.now.lambda) &&
           std::abs(touch_gap(setting_, touch(position), at_).tilt.value) <= touching_;
  }

  // Between a node and the next one.
  bool at_element(Index position) const {
    constexpr int parts = 8;  // in which the obstacle is looked at for notches
    if (!at_node(position) || !at_node(position + 1)) return false;
    const Vec2 from = face_of(position), to = face_of(position + 1);
    for (int i = 1; i < parts; ++i)
      if (!touches(from + (to - from) * i / parts)) return false;
    return true;
  }

 private:
  Touch touch(Index position) const {
    return {.strand = strand_,
            .position = position,
            .obstacle = obstacle_,
            .offset = setting_.face_offset(obstacle_, strand_)};
  }
  Vec2 face_of(Index position) const { return face(touch(position).offset, touch(position).axis(at_)); }
  bool touches(const Vec2& place) const {
    return std::abs(surface_.gap_slope(place, at_.now.lambda).value) <= touching_ * setting_.scales.length;
  }

  const SlidingSetting& setting_;
  const SlidingState& at_;
  Index strand_;
  std::size_t obstacle_;
  double touching_;
  const Obstacle& surface_;
};

bool lies_along(const SlidingSetting& setting, const SlidingState& at, Index strand, std::size_t obstacle,
                double touching) {
  const Alongside alongside(setting, at, strand, obstacle, touching);
  for (Index position = 0; position + 1 < at.mesh.nodes(strand); ++position)
    if (!alongside.at_element(position)) return false;
  return true;
}

// Whether some elements of a strand do, and others do not.
bool lies_along_in_part(const SlidingSetting& setting, const SlidingState& at, Index strand, std::size_t obstacle,
                        double touching) {
  const Alongside alongside(setting, at, strand, obstacle, touching);
  const bool first = alongside.at_element(0);
  for (Index position = 1; position + 1 < at.mesh.nodes(strand); ++position)
    if (alongside.at_element(position) != first) return true;
  return false;
}

// Whether what acts along a strand presses it on an obstacle everywhere at this λ, but at an end where nothing ever
// acts.
bool is_pressed_at(const SlidingSetting& setting, const SlidingState& at, Index strand, std::size_t obstacle,
                   double lambda) {
  constexpr int places = 64;
  HeldAxis held = held_axis_at_end(setting, at, {.strand = strand, .obstacle = obstacle});
  held.lambda = lambda;
  for (int i = 0; i <= places; ++i) {
    const double s = setting.body.length(strand) * i / places;
    const bool at_end = i == 0 || i == places;
    if (required_pressure_on_straight_wall(setting, held, s) > 0.0) continue;
    if (!at_end || !pressure_vanishes_for_all_lambda(setting, held, s)) return false;
  }
  return true;
}

bool has_pinched_point(const SlidingState& at, Index strand) {
  const auto& pinched = at.layout.pinched_points();
  return std::any_of(pinched.begin(), pinched.end(),
                     [&](std::size_t point) { return at.mesh.breakpoint(static_cast<Index>(point)).first == strand; });
}

std::optional<std::size_t> pressed_along(const SlidingSetting& setting, const SlidingState& at, Index strand,
                                         double toward, double touching) {
  for (std::size_t w = 0; w < setting.obstacles.size(); ++w)
    if (may_lie(setting, at, strand, w, toward) && lies_along(setting, at, strand, w, touching) &&
        is_pressed_at(setting, at, strand, w, toward))
      return w;
  return std::nullopt;
}

constexpr double rounded_off = 1e-9;  // round-off of coordinates [length scale; rad]

}  // namespace

bool rests_on_part(const SlidingSetting& setting, const SlidingState& rest) {
  for (Index strand = 0; strand < setting.body.strands(); ++strand)
    for (std::size_t w = 0; w < setting.obstacles.size(); ++w)
      if (setting.obstacles[w].concerns(strand) && lies_along_in_part(setting, rest, strand, w, rounded_off))
        return true;
  return false;
}

bool is_flush_at(const Obstacle& surface, const Vec2& place, double lambda) {
  return surface.faces(place, lambda) && surface.curvature(place, lambda).value == 0.0 &&
         surface.curvature_second(place, lambda) == 0.0;
}

void lay_down(const SlidingSetting& setting, Index strand, std::size_t obstacle, LayoutEdit& edit) {
  edit.set_lying(strand, obstacle);
  for (std::size_t j = 0; j < setting.free_ends.size(); ++j)
    if (setting.free_ends[j].strand == strand && setting.free_ends[j].obstacle == obstacle) edit.ends_closed[j] = 1;
}

State with_strands_lying(const SlidingSetting& setting, const SlidingState& rest, double toward) {
  LayoutEdit edit = edit_of(setting.body, rest);
  for (Index strand = 0; strand < setting.body.strands(); ++strand) {
    if (rest.layout.point_at_end(strand, false)) continue;  // it is pinched
    const auto obstacle = pressed_along(setting, rest, strand, toward, rounded_off);
    if (obstacle) lay_down(setting, strand, *obstacle, edit);
  }
  return edit.lying.empty() ? rest.state : mapped_onto(setting, rest, edit, layout_of(edit));
}

std::optional<State> with_strands_come_to_lie(const SlidingSetting& setting, const SlidingState& at, double toward) {
  constexpr double touching = 1e-6;  // what hardly any load bends away, or still holds up
  LayoutEdit edit = edit_of(setting.body, at);
  bool changed = false;
  for (Index strand = 0; strand < setting.body.strands(); ++strand) {
    if (at.layout.lies_on(strand) || has_pinched_point(at, strand)) continue;
    const auto obstacle = pressed_along(setting, at, strand, toward, touching);
    if (!obstacle) continue;
    const int elements = elements_asked(setting.body, strand, 0.0, setting.body.length(strand), fewest_pressed(true));
    for (std::size_t k = edit.points.size(); k-- > 0;)
      if (edit.strands[k] == strand) edit.erase(k, elements);
    lay_down(setting, strand, *obstacle, edit);
    changed = true;
  }
  if (!changed) return std::nullopt;
  return mapped_onto(setting, at, edit, layout_of(edit));
}

State with_flat_parts_loaded(const SlidingSetting& setting, const SlidingState& at, double toward) {
  LayoutEdit edit = edit_of(setting.body, at);
  bool changed = false;
  const auto load = [&](std::size_t point, Span& span, int& elements, double from, double to) {
    if (span != Span::flat) return;
    const double grows = toward * required_pressure_rate_above_roundoff(setting, at, point);
    if (grows == 0.0) return;
    span = grows > 0.0 ? Span::pressed : Span::free;
    elements = elements_asked(setting.body, edit.strands[point], from, to, fewest_pressed(true));
    changed = true;
  };
  for (std::size_t k = 0; k < edit.points.size(); ++k) {
    const Index strand = edit.strands[k];
    const bool is_first = k == 0 || edit.strands[k - 1] != strand;
    const bool is_last = k + 1 == edit.points.size() || edit.strands[k + 1] != strand;
    if (is_first) load(k, edit.points[k].before, edit.elements_before(k), 0.0, edit.place(k));
    load(k, edit.points[k].behind, edit.elements_behind(k), edit.place(k),
         is_last ? setting.body.length(strand) : edit.place(k + 1));
  }
  return changed ? mapped_onto(setting, at, edit, layout_of(edit)) : at.state;
}

std::string why_not_lying(const SlidingSetting& setting, const SlidingState& at, double toward) {
  for (Index strand = 0; strand < setting.body.strands(); ++strand) {
    const auto obstacle = at.layout.lies_on(strand);
    if (!obstacle || !is_driven_into(setting, at, strand, *obstacle, toward)) continue;
    return "member \"" + setting.body.label({.strand = strand, .s = 0.0}).first + "\" rests on wall \"" +
           setting.obstacles[*obstacle].name +
           "\" along its whole length, and λ rotates a fixed end of the member or moves an end and the wall into each "
           "other: that is not modelled; use contact.points = \"nodes\"";
  }
  return {};
}

std::vector<Transition> peels_off(const SlidingSetting& setting, const SlidingState& at, Index strand,
                                  const std::vector<bool>& ends) {
  const Transition none = unsupported(
      "the end of a member lifts off the wall that it rests on, but no equilibrium in which it peels off was found");
  const auto obstacle = at.layout.lies_on(strand);
  if (!obstacle) return {none};
  const double L = setting.body.length(strand);
  std::vector<Transition> transitions;
  for (const double factor : {2.0, 8.0}) {
    const double length = factor * shortest_span(setting.body, strand);
    if (length > 0.5 * L / double(ends.size())) break;
    LayoutEdit edit = edit_of(setting.body, at);
    edit.set_lying(strand, std::nullopt);
    const int free = elements_asked(setting.body, strand, 0.0, length, 2);
    for (const bool last : ends)
      edit.insert_near_end({strand, last}, last ? L - length : length, *obstacle, Span::free, Span::pressed, free);
    const auto on = layout_of(edit);
    const bool last = ends.front();
    const std::size_t point = on->point_at_end(strand, last).value();
    transitions.push_back(up_to(length, std::make_shared<TailLength>(point, last ? L : 0.0), Transition::Change::splits,
                                mapped_onto(setting, at, edit, on)));
  }
  transitions.push_back(none);
  return transitions;
}

HoldingMoment holding_moment(const SlidingSetting& setting, const SlidingState& at, std::size_t tip, double halves) {
  const SlidingContactLayout::PressedTip& end = at.layout.pressed_tips()[tip];
  const bool last = end.position > 0;
  const SlidingContactLayout::Segment& part = at.layout.segment_at_end(end.strand, last);
  const HeldAxis held = held_axis(setting, at, part);
  const double s = last ? setting.body.length(end.strand) : 0.0;
  const Index element = last ? end.position - 1 : 0;
  const double h =
      at.mesh.coordinate(end.strand, element + 1, at.now.s) - at.mesh.coordinate(end.strand, element, at.now.s);
  const double half = halves * h * h / 24.0,
               sign = outward(setting.obstacles[end.obstacle].surface->side(), last) * held.travel;
  const double by_change = pressure_of_end_element(part.elements).moment_by_change;
  const double at_end = s - held.s, at_next = at_end + (last ? -h : h);
  const double pressure = (1.0 - by_change) * required_pressure_on_straight_wall(setting, held, at_end) +
                          by_change * required_pressure_on_straight_wall(setting, held, at_next);
  HoldingMoment moment{.value = sign * at.state.x[at.index.tip_moment(tip)] - half * pressure,
                       .row = straight_pressure_gradient(setting, at, held, at_end)};
  const Row next = straight_pressure_gradient(setting, at, held, at_next);
  moment.row.dx = -half * ((1.0 - by_change) * moment.row.dx + by_change * next.dx);
  moment.row.dlambda = -half * ((1.0 - by_change) * moment.row.dlambda + by_change * next.dlambda);
  if (part.has_point()) {  // the elements become longer or shorter with the part
    const double by_length = -2.0 * half / h * pressure,
                 by_place = -half * by_change * required_pressure_slope_on_straight_wall(setting, held, at_next);
    const auto edge = static_cast<Index>(part.end_point());
    moment.row.dx[at.index.coordinate(edge)] += ((last ? -by_length : by_length) + by_place) / part.elements;
  }
  moment.row.dx[at.index.tip_moment(tip)] += sign;
  return moment;
}

}  // namespace arcwall::sliding
